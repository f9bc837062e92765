#include "apps/batch/file_stamp.h"

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <sys/stat.h>
#include <unistd.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cerrno>
#include <vector>

#include "folprom/result.h"
#include "io/files/posix.h"

namespace folprom::batch {
namespace {

constexpr size_t kPiece = size_t{1} << 20;

int64_t Nanoseconds(const struct timespec& time) {
  return int64_t{time.tv_sec} * 1000000000 + time.tv_nsec;
}

FileStamp StampOf(const struct stat& status) {
  return {static_cast<uint64_t>(status.st_size), Nanoseconds(status.st_mtim),
          Nanoseconds(status.st_ctim), status.st_ino};
}

std::string HashOf(int fd, const std::string& path, parallel::Progress& progress) {
  std::vector<uint8_t> piece(kPiece);
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  while (true) {
    const ssize_t size = ::read(fd, piece.data(), piece.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) io::ThrowSystemError(ErrorKind::kInput, path, "cannot read");
    if (size == 0) break;
    XXH3_128bits_update(&state, piece.data(), static_cast<size_t>(size));
    progress.Advance(static_cast<uint64_t>(size));
  }
  const XXH128_hash_t hash = XXH3_128bits_digest(&state);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

std::optional<FileStamp> StampOf(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return StampOf(status);
}

KnownFile HashFile(const std::string& path, parallel::Progress& progress) {
  const io::Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.open()) io::ThrowSystemError(ErrorKind::kInput, path, "cannot open");
  struct stat before = {}, after = {};
  if (::fstat(file.get(), &before) != 0) {
    io::ThrowSystemError(ErrorKind::kInput, path, "cannot read its status");
  }
  if (!S_ISREG(before.st_mode)) throw Failure(ErrorKind::kInput, path + ": is not a regular file");
  progress.StartStage("check", static_cast<uint64_t>(before.st_size));
  const KnownFile known{path, StampOf(before), HashOf(file.get(), path, progress)};
  if (::fstat(file.get(), &after) != 0 || StampOf(after) != known.stamp) {
    throw Failure(ErrorKind::kInput, path + ": changed while it was read");
  }
  return known;
}

std::optional<KnownFile> HashCache::Find(const std::string& path) const {
  const auto known = files_.find(path);
  if (known == files_.end() || StampOf(path) != known->second.stamp) return std::nullopt;
  return known->second;
}

KnownFile HashCache::Get(const std::string& path, parallel::Progress& progress) {
  if (const auto known = Find(path)) return *known;
  const KnownFile read = HashFile(path, progress);
  Remember(read);
  return read;
}

}  // namespace folprom::batch
