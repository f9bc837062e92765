#include "io/files/scratch_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <utility>

namespace folprom::io {
namespace {

constexpr uint64_t kPiece = uint64_t{1} << 28;

}  // namespace

std::string TemporaryFolder() {
  const char* folder = std::getenv("TMPDIR");
  return folder != nullptr && *folder != '\0' ? folder : "/tmp";
}

ScratchFile::ScratchFile(const std::string& folder, std::string path) : path_(std::move(path)) {
  std::string name;
  file_ = CreateHiddenFile(folder, path_, &name);
  ::unlink(name.c_str());
}

void ScratchFile::Append(std::span<const uint8_t> bytes) {
  WriteAllAt(file_.get(), size_, bytes, path_);
  size_ += bytes.size();
}

MappedFile ScratchFile::Map() const {
  Result<MappedFile> mapped = MappedFile::OfDescriptor(file_.get(), path_);
  if (!mapped) throw Failure(ErrorKind::kOutput, mapped.error().message);
  return std::move(mapped).value();
}

void ScratchFile::CopyTo(int file, uint64_t offset, const std::string& path) const {
  auto from = off_t{0};
  auto to = static_cast<off_t>(offset);
  while (static_cast<uint64_t>(from) < size_) {
    const uint64_t piece = std::min(kPiece, size_ - static_cast<uint64_t>(from));
    const ssize_t copied = ::copy_file_range(file_.get(), &from, file, &to, piece, 0);
    if (copied > 0 || (copied < 0 && errno == EINTR)) continue;
    if (copied < 0 && errno != EINVAL && errno != EXDEV && errno != ENOSYS && errno != EOPNOTSUPP) {
      ThrowSystemError(ErrorKind::kOutput, path, "cannot write");
    }
    break;
  }
  // A file system without it, or a kernel that stops early.
  const MappedFile mapped = Map();
  while (static_cast<uint64_t>(from) < size_) {
    const auto begin = static_cast<uint64_t>(from);
    const uint64_t piece = std::min(kPiece, size_ - begin);
    WriteAllAt(file, static_cast<uint64_t>(to), mapped.bytes().subspan(begin, piece), path);
    mapped.DropResident(begin, begin + piece);
    from += static_cast<off_t>(piece);
    to += static_cast<off_t>(piece);
  }
}

}  // namespace folprom::io
