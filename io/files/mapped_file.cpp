#include "io/files/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>

#include "io/files/cut_pages.h"
#include "io/files/posix.h"
#include "io/result_of.h"

namespace folprom::io {

Result<MappedFile> MappedFile::Open(const std::string& path) {
  return ResultOf([&] {
    // Without O_NONBLOCK a named pipe with no writer would block here for ever.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!file.open()) ThrowSystemError(ErrorKind::kInput, path, "cannot open");
    return OfDescriptor(file.get(), path).value();
  });
}

Result<MappedFile> MappedFile::OfDescriptor(int file, const std::string& path) {
  return ResultOf([&] {
    struct stat status {};
    if (::fstat(file, &status) != 0) {
      ThrowSystemError(ErrorKind::kInput, path, "cannot read its status");
    }
    if (!S_ISREG(status.st_mode)) {
      const char* reason = S_ISDIR(status.st_mode) ? "is a directory" : "is not a regular file";
      throw Failure(ErrorKind::kInput, path + ": " + reason);
    }

    MappedFile mapped;
    mapped.path_ = path;
    mapped.status_ = status;
    if (status.st_size == 0) return mapped;
    const auto size = static_cast<size_t>(status.st_size);
    void* data = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
    if (data == MAP_FAILED) ThrowSystemError(ErrorKind::kInput, path, "cannot map into memory");
    mapped.data_ = static_cast<const uint8_t*>(data);
    mapped.size_ = size;
    AddMapping(data, size);
    return mapped;
  });
}

MappedFile::~MappedFile() {
  if (data_ == nullptr) return;
  RemoveMapping(data_);
  ::munmap(const_cast<uint8_t*>(data_), size_);
}

void MappedFile::CheckUnchanged() const {
  struct stat now {};
  if (::stat(path_.c_str(), &now) != 0) return;
  if (now.st_dev != status_.st_dev || now.st_ino != status_.st_ino) return;
  if (now.st_size == status_.st_size && now.st_mtim.tv_sec == status_.st_mtim.tv_sec &&
      now.st_mtim.tv_nsec == status_.st_mtim.tv_nsec) {
    return;
  }
  throw Failure(ErrorKind::kInput, path_ + ": changed while it was read");
}

void MappedFile::DropResident(size_t begin, size_t end) const {
  static const size_t page = static_cast<size_t>(::sysconf(_SC_PAGESIZE));
  end = std::min(end, size_);
  begin = begin / page * page;
  if (begin >= end) return;
  // A hint: where the kernel declines, only the resident size differs.
  ::madvise(const_cast<uint8_t*>(data_) + begin, end - begin, MADV_DONTNEED);
}

}  // namespace folprom::io
