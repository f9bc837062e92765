// Little-endian numbers, varints and single bits in a run of bytes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace folprom::io {

/// Little-endian number of sizeof(T) bytes. T is unsigned.
template <class T>
T LoadLittleEndian(const uint8_t* bytes) {
  T value = 0;
  for (size_t i = 0; i < sizeof(T); ++i) value = static_cast<T>(value | T{bytes[i]} << (8 * i));
  return value;
}

/// Appends `value` to *bytes, lowest byte first. T is unsigned.
template <class T>
void AppendLittleEndian(T value, std::vector<uint8_t>* bytes) {
  for (size_t i = 0; i < sizeof(T); ++i) bytes->push_back(static_cast<uint8_t>(value >> (8 * i)));
}

/// Maps small numbers of both signs, modulo 2^64, to small numbers: 0 -1 1 -2 2 -> 0 1 2 3 4.
inline uint64_t ZigZag(uint64_t difference) { return (difference << 1) ^ (0 - (difference >> 63)); }
inline uint64_t UnZigZag(uint64_t code) { return (code >> 1) ^ (0 - (code & 1)); }

/// Appends numbers to a growing run of bytes.
class ByteWriter {
 public:
  void U8(uint8_t value) { bytes_.push_back(value); }
  void F32(float value) { AppendLittleEndian(std::bit_cast<uint32_t>(value), &bytes_); }
  void U64(uint64_t value) { AppendLittleEndian(value, &bytes_); }
  void F64(double value) { AppendLittleEndian(std::bit_cast<uint64_t>(value), &bytes_); }
  /// Seven bits a byte, lowest first, high bit set on all but the last; 1 .. 10 bytes.
  void Varint(uint64_t value);
  void Bytes(std::span<const uint8_t> bytes);
  std::vector<uint8_t> Take() && { return std::move(bytes_); }

 private:
  std::vector<uint8_t> bytes_;
};

/// Reads what ByteWriter wrote, never beyond its bytes: every fault is a Failure kCorrupt that
/// names the file, the byte of the file and the reason.
class ByteReader {
 public:
  /// `offset`: position of the first byte in the file, for messages. Borrows `bytes` and `file`.
  ByteReader(std::span<const uint8_t> bytes, std::string_view file, uint64_t offset)
      : bytes_(bytes), file_(file), offset_(offset) {}

  size_t left() const { return bytes_.size() - at_; }
  uint8_t U8() { return *Next(1); }
  float F32() { return std::bit_cast<float>(LoadLittleEndian<uint32_t>(Next(4))); }
  uint64_t U64() { return LoadLittleEndian<uint64_t>(Next(8)); }
  double F64() { return std::bit_cast<double>(LoadLittleEndian<uint64_t>(Next(8))); }
  /// Refuses more than 64 bits and needless bytes.
  uint64_t Varint();
  /// A varint that may not be above `largest`; `what` names it in the message.
  uint64_t VarintUpTo(uint64_t largest, std::string_view what);
  std::span<const uint8_t> Bytes(size_t count);
  /// Throws Failure kCorrupt for the byte read last.
  [[noreturn]] void Fail(const std::string& reason) const;

 private:
  const uint8_t* Next(size_t count);

  std::span<const uint8_t> bytes_;
  std::string_view file_;
  uint64_t offset_;
  size_t at_ = 0;
  size_t last_ = 0;  ///< begin of what was read last
};

/// Appends bits to a ByteWriter, highest bit of a byte first.
class BitWriter {
 public:
  explicit BitWriter(ByteWriter* out) : out_(out) {}
  /// The lowest `count` bits of `value`, highest of them first; count 0 .. 64.
  void Bits(uint64_t value, int count);
  /// Fills the last byte with zero bits. Call once, at the end.
  void Finish();

 private:
  ByteWriter* out_;
  uint32_t byte_ = 0;
  int filled_ = 0;
};

/// Reads what BitWriter wrote, taking bytes from a ByteReader as it needs them.
class BitReader {
 public:
  explicit BitReader(ByteReader* in) : in_(in) {}
  uint64_t Bits(int count);
  /// Zero bits before the next one bit, which is taken too. Refuses more than `largest`.
  int Zeros(int largest);
  /// Refuses fill bits that are not zero. Call once, at the end.
  void Finish() const;

 private:
  uint32_t Bit();

  ByteReader* in_;
  uint32_t byte_ = 0;
  int left_ = 0;
};

}  // namespace folprom::io
