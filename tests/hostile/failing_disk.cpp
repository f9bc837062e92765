#include "tests/hostile/failing_disk.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>

namespace folprom::hostile {
namespace {

std::atomic<bool> is_failing{false}, failed{false};
std::atomic<DiskFault> fault{DiskFault::kFull};
std::atomic<uint64_t> left{0}, bytes_written{0};

/// How many of `size` bytes may be written; -1 with errno where none.
ssize_t Room(size_t size) {
  if (!is_failing || size == 0) return static_cast<ssize_t>(size);
  size_t room = size;
  if (fault == DiskFault::kFull || fault == DiskFault::kShort) {
    room = std::min<uint64_t>(size, left);
  }
  failed = failed || room < size;
  if (room > 0) return static_cast<ssize_t>(room);
  errno = ENOSPC;
  return -1;
}

ssize_t Count(ssize_t done) {
  if (!is_failing || done <= 0) return done;
  bytes_written += static_cast<uint64_t>(done);
  if (fault == DiskFault::kFull) left -= static_cast<uint64_t>(done);
  return done;
}

/// Is this the call that fails.
bool Fails(DiskFault kind) {
  if (!is_failing || fault != kind || left-- > 0) return false;
  failed = true;
  errno = EIO;
  return true;
}

}  // namespace

FailingDisk::FailingDisk(DiskFault kind, uint64_t after) {
  fault = kind;
  left = after;
  bytes_written = 0;
  failed = false;
  is_failing = true;
}
FailingDisk::~FailingDisk() { is_failing = false; }
uint64_t FailingDisk::written() const { return bytes_written; }
bool FailingDisk::has_failed() const { return failed; }

}  // namespace folprom::hostile

namespace disk = folprom::hostile;

extern "C" {

ssize_t write(int file, const void* bytes, size_t size) {
  const ssize_t room = disk::Room(size);
  return room < 0 ? -1 : disk::Count(::syscall(SYS_write, file, bytes, room));
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t offset) {
  const ssize_t room = disk::Room(size);
  return room < 0 ? -1 : disk::Count(::syscall(SYS_pwrite64, file, bytes, room, offset));
}

ssize_t copy_file_range(int from, off_t* from_offset, int to, off_t* to_offset, size_t size,
                        unsigned flags) {
  const ssize_t room = disk::Room(size);
  if (room < 0) return -1;
  return disk::Count(::syscall(SYS_copy_file_range, from, from_offset, to, to_offset, room, flags));
}

int fsync(int file) {
  if (disk::Fails(disk::DiskFault::kSync)) return -1;
  return static_cast<int>(::syscall(SYS_fsync, file));
}

int rename(const char* from, const char* to) noexcept {
  if (disk::Fails(disk::DiskFault::kRename)) return -1;
  return static_cast<int>(::syscall(SYS_rename, from, to));
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
  if (disk::Fails(disk::DiskFault::kRename)) return -1;
  return static_cast<int>(::syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}

}  // extern "C"
