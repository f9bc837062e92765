#include "io/files/posix.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <limits>
#include <system_error>

namespace folprom::io {
namespace {

// One system call takes at most 2 GiB; smaller pieces keep a cancelled job responsive.
constexpr size_t kPiece = size_t{1} << 28;

template <class Write>
void WritePieces(std::span<const uint8_t> bytes, const std::string& path, Write write) {
  while (!bytes.empty()) {
    const ssize_t written = write(bytes.data(), std::min(bytes.size(), kPiece));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) ThrowSystemError(ErrorKind::kOutput, path, "cannot write");
    if (written == 0) {
      throw Failure(ErrorKind::kOutput, path + ": cannot write: the system took no bytes");
    }
    bytes = bytes.subspan(static_cast<size_t>(written));
  }
}

}  // namespace

Descriptor::~Descriptor() {
  if (fd_ >= 0) ::close(fd_);
}

void Descriptor::CloseChecked(const std::string& path) {
  // After EINTR the descriptor is closed on Linux: closing again could hit another thread's file.
  if (::close(std::exchange(fd_, -1)) != 0 && errno != EINTR) {
    ThrowSystemError(ErrorKind::kOutput, path, "cannot close");
  }
}

namespace {

// Calls make(name) with hidden names until one is not taken; false leaves errno of the last.
template <class Make>
bool TryHiddenNames(const std::string& folder, std::string* name, Make make) {
  static std::atomic<uint64_t> serial{0};
  for (int attempt = 0; attempt < 1000; ++attempt) {
    *name = (std::filesystem::path(folder) /
             (".folprom-" + std::to_string(::getpid()) + "-" + std::to_string(serial++) + ".tmp"))
                .string();
    if (make(*name)) return true;
    if (errno != EEXIST) break;
  }
  name->clear();
  return false;
}

std::string PathOf(const Descriptor& file) {
  return "/proc/self/fd/" + std::to_string(file.get());
}

}  // namespace

// Not mkstemp: the mode shall be that of any new file under the caller's umask.
Descriptor CreateHiddenFile(const std::string& folder, const std::string& path, std::string* name) {
  Descriptor file;
  const auto create = [&](const std::string& hidden) {
    file = Descriptor(::open(hidden.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    return file.open();
  };
  if (TryHiddenNames(folder, name, create)) return file;
  ThrowSystemError(ErrorKind::kOutput, path, ("cannot create a file in " + folder).c_str());
}

Descriptor CreateUnnamedFile(const std::string& folder) {
  Descriptor file(::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666));
  if (file.open() && ::access(PathOf(file).c_str(), F_OK) != 0) return Descriptor();
  return file;
}

std::string NameHidden(const Descriptor& file, const std::string& folder, const std::string& path) {
  std::string name;
  const auto link = [&](const std::string& hidden) {
    return ::linkat(AT_FDCWD, PathOf(file).c_str(), AT_FDCWD, hidden.c_str(), AT_SYMLINK_FOLLOW) ==
           0;
  };
  if (TryHiddenNames(folder, &name, link)) return name;
  ThrowSystemError(ErrorKind::kOutput, path, ("cannot create a file in " + folder).c_str());
}

void ThrowSystemError(ErrorKind kind, const std::string& path, const char* what) {
  const int code = errno;
  throw Failure(kind, path + ": " + what + ": " + std::generic_category().message(code));
}

void WriteAll(int fd, std::span<const uint8_t> bytes, const std::string& path) {
  WritePieces(bytes, path,
              [fd](const uint8_t* data, size_t size) { return ::write(fd, data, size); });
}

void WriteAllAt(int fd, uint64_t offset, std::span<const uint8_t> bytes, const std::string& path) {
  constexpr uint64_t kLast = static_cast<uint64_t>(std::numeric_limits<off_t>::max());
  if (offset > kLast || bytes.size() > kLast - offset) {
    throw Failure(ErrorKind::kOutput, path + ": cannot write: beyond the largest file size");
  }
  WritePieces(bytes, path, [fd, &offset](const uint8_t* data, size_t size) {
    const ssize_t written = ::pwrite(fd, data, size, static_cast<off_t>(offset));
    if (written > 0) offset += static_cast<uint64_t>(written);
    return written;
  });
}

}  // namespace folprom::io
