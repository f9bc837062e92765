#include "io/files/mapped_memory.h"

#include <fcntl.h>
#include <sys/mman.h>

#include <cerrno>

#include "folprom/result.h"
#include "io/files/posix.h"

namespace folprom::io {

MappedMemory::MappedMemory(const std::string& path, size_t bytes) : size_(bytes) {
  const Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (!file.open()) ThrowSystemError(ErrorKind::kOutput, path, "cannot create temporary file");
  if (bytes == 0) return;
  // Without it a full disk would end the program at the first write to a page.
  errno = ::posix_fallocate(file.get(), 0, static_cast<off_t>(bytes));
  if (errno != 0) ThrowSystemError(ErrorKind::kOutput, path, "cannot enlarge temporary file");
  void* data = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
  if (data == MAP_FAILED) {
    ThrowSystemError(ErrorKind::kOutput, path, "cannot map temporary file into memory");
  }
  data_ = static_cast<uint8_t*>(data);
}

MappedMemory::~MappedMemory() {
  if (data_ != nullptr) ::munmap(data_, size_);
}

void MappedMemory::DropResident() const {
  // A hint, as for read-only mappings: dirty pages stay in the cache of the kernel.
  if (data_ != nullptr) ::madvise(data_, size_, MADV_DONTNEED);
}

}  // namespace folprom::io
