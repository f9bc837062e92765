#include "engine/partition/offset_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace folprom::partition {

OffsetFile::OffsetFile(const io::SpillDirectory& directory, const std::string& name)
    : path_(directory.File(name)),
      file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600)) {
  if (!file_.open()) {
    io::ThrowSystemError(ErrorKind::kOutput, path_, "cannot create temporary file");
  }
}

void OffsetFile::WriteAt(uint64_t offset, const void* bytes, size_t size) {
  io::WriteAllAt(file_.get(), offset, {static_cast<const uint8_t*>(bytes), size}, path_);
}

void OffsetFile::ReadAt(uint64_t offset, void* bytes, size_t size) const {
  auto* to = static_cast<uint8_t*>(bytes);
  while (size > 0) {
    const ssize_t done = ::pread(file_.get(), to, size, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) io::ThrowSystemError(ErrorKind::kOutput, path_, "cannot read temporary file");
    if (done == 0) throw Failure(ErrorKind::kOutput, path_ + ": temporary file is cut short");
    to += done;
    offset += static_cast<uint64_t>(done);
    size -= static_cast<size_t>(done);
  }
}

io::MappedFile OffsetFile::Map() const { return io::MapSpillFile(path_); }

void OffsetFile::Remove() {
  if (::unlink(path_.c_str()) == 0) return;
  io::ThrowSystemError(ErrorKind::kOutput, path_, "cannot remove temporary file");
}

}  // namespace folprom::partition
