#include "io/container/header.h"

#include <algorithm>
#include <string>

#include "folprom/result.h"
#include "io/container/byte_code.h"
#include "io/container/checksum.h"
#include "io/container/file_table.h"

namespace folprom::io {
namespace {

[[noreturn]] void Fail(ErrorKind kind, std::string_view file, const std::string& reason) {
  throw Failure(kind, std::string(file) + ": " + reason);
}

[[noreturn]] void FailCut(std::string_view file, uint64_t present, const std::string& needed) {
  Fail(ErrorKind::kCorrupt, file,
       "cut inside the header: " + std::to_string(present) + " of " + needed +
           " bytes of magic, table and checksum are there");
}

void CheckVersion(std::span<const uint8_t> bytes, std::string_view file) {
  const auto version = LoadLittleEndian<uint16_t>(bytes.data() + kMagic.size());
  if (version == kFormatVersion) return;
  Fail(ErrorKind::kInput, file,
       "format version " + std::to_string(version) + ", this program reads up to " +
           std::to_string(kFormatVersion));
}

}  // namespace

std::vector<uint8_t> EncodeHeader(std::span<const uint8_t> table_bytes) {
  if (table_bytes.size() > UINT32_MAX) {
    throw Failure(ErrorKind::kLimit, "the table of the file takes 4 GiB or more");
  }
  std::vector<uint8_t> bytes(kMagic.begin(), kMagic.end());
  AppendLittleEndian(static_cast<uint16_t>(kFormatVersion), &bytes);
  AppendLittleEndian(static_cast<uint32_t>(table_bytes.size()), &bytes);
  bytes.insert(bytes.end(), table_bytes.begin(), table_bytes.end());
  AppendLittleEndian(XxHash64(bytes), &bytes);
  return bytes;
}

std::span<const uint8_t> TableBytes(std::span<const uint8_t> file_bytes, std::string_view file) {
  const size_t present = file_bytes.size();
  if (!std::equal(file_bytes.begin(),
                  file_bytes.begin() + static_cast<ptrdiff_t>(std::min(present, kMagic.size())),
                  kMagic.begin())) {
    Fail(ErrorKind::kInput, file, "not a .folp file: it does not begin with the magic bytes");
  }
  if (present >= kMagic.size() + kVersionBytes) CheckVersion(file_bytes, file);
  if (present < kTableBegin) {
    FailCut(file, present, "at least " + std::to_string(kTableBegin + kHeaderChecksumBytes));
  }
  const size_t length = LoadLittleEndian<uint32_t>(file_bytes.data() + kTableBegin - kLengthBytes);
  const uint64_t needed = uint64_t{kTableBegin} + length + kHeaderChecksumBytes;
  if (present < needed) FailCut(file, present, std::to_string(needed));
  const auto guarded = file_bytes.first(kTableBegin + length);
  if (XxHash64(guarded) != LoadLittleEndian<uint64_t>(file_bytes.data() + guarded.size())) {
    Fail(ErrorKind::kCorrupt, file,
         "checksum of the table (bytes 0 to " + std::to_string(guarded.size()) + ") differs");
  }
  return guarded.subspan(kTableBegin);
}

}  // namespace folprom::io
