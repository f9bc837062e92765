// What mapped files, atomic files and spill files share of the operating system.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "folprom/result.h"

namespace folprom::io {

/// Closes a file descriptor when it goes out of scope. -1 is none.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Descriptor();
  bool open() const { return fd_ >= 0; }
  int get() const { return fd_; }
  /// Closes now; kOutput with `path` where the system reports a late write error.
  void CloseChecked(const std::string& path);

 private:
  int fd_;
};

/// Throws Failure "path: what: reason of errno". Reads errno first.
[[noreturn]] void ThrowSystemError(ErrorKind kind, const std::string& path, const char* what);

/// A new hidden file in the folder, open to read and write, and its path in *name. kOutput with
/// `path`, for which it is made.
Descriptor CreateHiddenFile(const std::string& folder, const std::string& path, std::string* name);

/// A new file without a name, which is gone with its descriptor however the program ends; not open
/// where the file system has none, or could not give it a name later.
Descriptor CreateUnnamedFile(const std::string& folder);
/// Gives such a file a hidden name in its folder, and returns its path. kOutput with `path`.
std::string NameHidden(const Descriptor& file, const std::string& folder, const std::string& path);

/// Writes all bytes at the descriptor's position; kOutput with `path` on any shortfall.
void WriteAll(int fd, std::span<const uint8_t> bytes, const std::string& path);

/// Writes all bytes at `offset`; kOutput with `path` on any shortfall.
void WriteAllAt(int fd, uint64_t offset, std::span<const uint8_t> bytes, const std::string& path);

}  // namespace folprom::io
