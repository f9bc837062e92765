#include "io/container/byte_code.h"

#include "folprom/result.h"

namespace folprom::io {

void ByteWriter::Varint(uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes_.push_back(static_cast<uint8_t>(value | 0x80));
  bytes_.push_back(static_cast<uint8_t>(value));
}

void ByteWriter::Bytes(std::span<const uint8_t> bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

void ByteReader::Fail(const std::string& reason) const {
  throw Failure(ErrorKind::kCorrupt, std::string(file_) + ": byte " +
                                         std::to_string(offset_ + last_) +
                                         " (in the table): " + reason);
}

const uint8_t* ByteReader::Next(size_t count) {
  last_ = at_;
  if (count > left()) Fail("the table ends too early");
  at_ += count;
  return bytes_.data() + last_;
}

std::span<const uint8_t> ByteReader::Bytes(size_t count) { return {Next(count), count}; }

uint64_t ByteReader::Varint() {
  const size_t begin = at_;
  uint64_t value = 0;
  for (int shift = 0;; shift += 7) {
    const uint64_t byte = *Next(1);
    last_ = begin;
    if (shift == 63 && byte > 1) Fail("varint above 64 bits");
    value |= (byte & 0x7f) << shift;
    if (byte >= 0x80) continue;
    if (byte == 0 && shift > 0) Fail("varint with needless bytes");
    return value;
  }
}

uint64_t ByteReader::VarintUpTo(uint64_t largest, std::string_view what) {
  const uint64_t value = Varint();
  if (value > largest) {
    Fail(std::string(what) + " is " + std::to_string(value) + ", at most " +
         std::to_string(largest) + " is possible");
  }
  return value;
}

void BitWriter::Bits(uint64_t value, int count) {
  while (count-- > 0) {
    byte_ = byte_ << 1 | static_cast<uint32_t>(value >> count & 1);
    if (++filled_ < 8) continue;
    out_->U8(static_cast<uint8_t>(byte_));
    byte_ = 0;
    filled_ = 0;
  }
}

void BitWriter::Finish() {
  if (filled_ > 0) Bits(0, 8 - filled_);
}

uint32_t BitReader::Bit() {
  if (left_ == 0) {
    byte_ = in_->U8();
    left_ = 8;
  }
  return byte_ >> --left_ & 1;
}

uint64_t BitReader::Bits(int count) {
  uint64_t value = 0;
  while (count-- > 0) value = value << 1 | Bit();
  return value;
}

int BitReader::Zeros(int largest) {
  int zeros = 0;
  while (Bit() == 0) {
    if (++zeros > largest) in_->Fail("segment size beyond 32 bits");
  }
  return zeros;
}

void BitReader::Finish() const {
  if ((byte_ & ((1u << left_) - 1)) != 0) in_->Fail("fill bits that are not zero");
}

}  // namespace folprom::io
