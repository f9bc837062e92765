// Blocks of a section: each with its length and its checksum.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "folprom/result.h"
#include "io/container/byte_code.h"
#include "io/container/checksum.h"

namespace folprom::io {

/// A block as it stands in a section. At most 2^32 - 1 bytes.
inline std::vector<uint8_t> FramedBlock(std::span<const uint8_t> bytes) {
  std::vector<uint8_t> framed;
  AppendLittleEndian(static_cast<uint32_t>(bytes.size()), &framed);
  framed.insert(framed.end(), bytes.begin(), bytes.end());
  AppendLittleEndian(static_cast<uint32_t>(XxHash64(framed)), &framed);
  return framed;
}

/// Gives the blocks of a section one after another.
class BlockReader {
 public:
  /// `place`: "scan.folp: order: ", for messages. Borrows the bytes.
  BlockReader(std::span<const uint8_t> section, std::string place)
      : left_(section), place_(std::move(place)) {}

  bool AtEnd() const { return left_.empty(); }
  /// Failure kCorrupt where the section ends early or the checksum differs.
  std::span<const uint8_t> Next() {
    constexpr size_t kLength = sizeof(uint32_t), kFrame = 2 * sizeof(uint32_t);
    if (left_.size() < kFrame) Fail("ends early");
    const size_t size = LoadLittleEndian<uint32_t>(left_.data());
    if (size > left_.size() - kFrame) Fail("ends early");
    const auto framed = left_.first(kLength + size);
    if (static_cast<uint32_t>(XxHash64(framed)) !=
        LoadLittleEndian<uint32_t>(left_.data() + framed.size())) {
      Fail("checksum of a block differs");
    }
    left_ = left_.subspan(kFrame + size);
    return framed.subspan(kLength);
  }
  [[noreturn]] void Fail(const std::string& reason) const {
    throw Failure(ErrorKind::kCorrupt, place_ + reason);
  }

 private:
  std::span<const uint8_t> left_;
  std::string place_;
};

}  // namespace folprom::io
