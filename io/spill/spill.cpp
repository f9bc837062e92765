#include "io/spill/spill.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "io/files/posix.h"
#include "io/files/scratch_file.h"

namespace folprom::io {
namespace {

namespace fs = std::filesystem;

constexpr size_t kSmallestBuffer = 4096;
constexpr size_t kLargestBuffer = size_t{1} << 20;

std::string ParentOr(const std::string& parent) {
  return parent.empty() ? TemporaryFolder() : parent;
}

// The folder, locked; none where another process has it or it is not this user's alone.
Descriptor LockFolder(const std::string& path) {
  Descriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  struct stat status {};
  if (!folder.open() || ::fstat(folder.get(), &status) != 0 || status.st_uid != ::geteuid() ||
      (status.st_mode & 077) != 0 || ::flock(folder.get(), LOCK_EX | LOCK_NB) != 0) {
    return Descriptor();
  }
  return folder;
}

// Between opening a folder and locking it another process may have removed it.
bool IsStillThere(const Descriptor& folder, const std::string& path) {
  struct stat opened {
  }, named{};
  return ::fstat(folder.get(), &opened) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

Descriptor OpenForWriting(const std::string& path, int flags) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, 0600));
  if (!file.open()) ThrowSystemError(ErrorKind::kOutput, path, "cannot open temporary file");
  return file;
}

void AppendToFile(const std::string& path, std::span<const uint8_t> bytes) {
  Descriptor file = OpenForWriting(path, O_APPEND);
  WriteAll(file.get(), bytes, path);
  file.CloseChecked(path);
}

}  // namespace

SpillDirectory::SpillDirectory(const std::string& parent) {
  path_ = (fs::path(ParentOr(parent)) / "folprom-XXXXXX").string();
  if (::mkdtemp(path_.data()) == nullptr) {
    ThrowSystemError(ErrorKind::kOutput, ParentOr(parent), "cannot create a temporary folder");
  }
}

std::unique_ptr<SpillDirectory> SpillDirectory::OpenNamed(const std::string& parent,
                                                          const std::string& name) {
  const std::string path = (fs::path(ParentOr(parent)) / ("folprom-" + name)).string();
  constexpr int kAttempts = 100;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (::mkdir(path.c_str(), 0700) != 0 && errno != EEXIST) {
      ThrowSystemError(ErrorKind::kOutput, ParentOr(parent), "cannot create a temporary folder");
    }
    Descriptor lock = LockFolder(path);
    if (!lock.open()) {
      if (errno == ENOENT) continue;
      return nullptr;
    }
    if (!IsStillThere(lock, path)) continue;
    return std::unique_ptr<SpillDirectory>(new SpillDirectory(path, std::move(lock)));
  }
  return nullptr;
}

SpillDirectory::~SpillDirectory() {
  if (kept_) return;
  std::error_code ignored;  // nothing is left to do about it
  fs::remove_all(path_, ignored);
}

void SpillDirectory::Clear() const {
  std::error_code error;
  fs::directory_iterator entry(path_, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    fs::remove_all(entry->path(), error);
    if (error) break;
  }
  if (error) throw Failure(ErrorKind::kOutput, path_ + ": cannot be emptied: " + error.message());
}

std::string SpillDirectory::File(const std::string& name) const {
  return (fs::path(path_) / name).string();
}

uint64_t SpillDirectory::FileBytes(const std::string& name) const {
  std::error_code error;
  const uint64_t bytes = fs::file_size(File(name), error);
  if (error) throw Failure(ErrorKind::kOutput, File(name) + ": " + error.message());
  return bytes;
}

uint64_t SpillDirectory::SizeBytes() const {
  uint64_t bytes = 0;
  std::error_code error;
  fs::directory_iterator entry(path_, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const uint64_t size = entry->file_size(error);
    if (error) break;
    bytes += size;
  }
  if (error) {
    throw Failure(ErrorKind::kOutput, path_ + ": cannot read its size: " + error.message());
  }
  return bytes;
}

// A buffer belongs to a stream only while it holds bytes of it: with more streams than the memory
// has buffers for, the ones that are in use are written out and given away.
struct SpillStreams::Impl {
  struct Stream {
    uint64_t written = 0;  // bytes in the file
    size_t used = 0;       // bytes in the buffer
    std::unique_ptr<uint8_t[]> buffer;
  };

  std::string prefix;
  std::vector<Stream> streams;
  size_t buffer_size = kSmallestBuffer;
  size_t buffers_left = 1;  // how many more may be allocated
  std::vector<std::unique_ptr<uint8_t[]>> free_buffers;
  std::vector<size_t> owners;  // streams that hold a buffer

  std::string Path(size_t stream) const { return prefix + std::to_string(stream); }

  void Write(size_t stream, std::span<const uint8_t> bytes) {
    if (bytes.empty()) return;
    AppendToFile(Path(stream), bytes);
    streams[stream].written += bytes.size();
  }

  void Flush(size_t stream) {
    Stream& s = streams[stream];
    Write(stream, {s.buffer.get(), s.used});
    s.used = 0;
  }

  void TakeAllBuffers() {
    for (const size_t owner : owners) {
      Flush(owner);
      free_buffers.push_back(std::move(streams[owner].buffer));
    }
    owners.clear();
  }

  void GiveBuffer(size_t stream) {
    if (free_buffers.empty() && buffers_left == 0) TakeAllBuffers();
    if (free_buffers.empty()) {
      free_buffers.push_back(std::make_unique<uint8_t[]>(buffer_size));
      --buffers_left;
    }
    streams[stream].buffer = std::move(free_buffers.back());
    free_buffers.pop_back();
    owners.push_back(stream);
  }
};

SpillStreams::SpillStreams(const SpillDirectory& directory, std::string name, size_t stream_count,
                           uint64_t buffer_bytes)
    : impl_(std::make_unique<Impl>()) {
  impl_->prefix = directory.File(name + ".");
  impl_->streams.resize(stream_count);
  const uint64_t share = buffer_bytes / std::max<size_t>(stream_count, 1);
  impl_->buffer_size = static_cast<size_t>(std::clamp<uint64_t>(
      share / kSmallestBuffer * kSmallestBuffer, kSmallestBuffer, kLargestBuffer));
  impl_->buffers_left = static_cast<size_t>(std::clamp<uint64_t>(
      buffer_bytes / impl_->buffer_size, 1, std::max<size_t>(stream_count, 1)));
}

SpillStreams::SpillStreams(const SpillDirectory& directory, std::string name,
                           std::span<const uint64_t> stream_bytes)
    : impl_(std::make_unique<Impl>()) {
  impl_->prefix = directory.File(name + ".");
  impl_->streams.resize(stream_bytes.size());
  for (size_t i = 0; i < stream_bytes.size(); ++i) impl_->streams[i].written = stream_bytes[i];
}

SpillStreams::~SpillStreams() = default;

void SpillStreams::Append(size_t stream, const void* bytes, size_t size) {
  Impl::Stream& s = impl_->streams[stream];
  if (s.buffer == nullptr) impl_->GiveBuffer(stream);
  if (size > impl_->buffer_size - s.used) {
    impl_->Flush(stream);
    if (size >= impl_->buffer_size) {
      impl_->Write(stream, {static_cast<const uint8_t*>(bytes), size});
      return;
    }
  }
  if (size > 0) std::memcpy(s.buffer.get() + s.used, bytes, size);
  s.used += size;
}

void SpillStreams::Finish() {
  impl_->TakeAllBuffers();
  impl_->free_buffers.clear();
}

MappedFile SpillStreams::Map(size_t stream) const {
  if (impl_->streams[stream].written == 0) return {};
  MappedFile file = MapSpillFile(impl_->Path(stream));
  if (file.bytes().size() != impl_->streams[stream].written) {
    throw Failure(ErrorKind::kOutput,
                  "temporary file " + impl_->Path(stream) + ": changed by someone else");
  }
  return file;
}

void WriteSpillFile(const SpillDirectory& directory, const std::string& name,
                    std::span<const uint8_t> bytes) {
  const std::string path = directory.File(name);
  Descriptor file = OpenForWriting(path, O_TRUNC);
  WriteAll(file.get(), bytes, path);
  file.CloseChecked(path);
}

MappedFile MapSpillFile(const std::string& path) {
  Result<MappedFile> file = MappedFile::Open(path);
  if (!file) throw Failure(ErrorKind::kOutput, "temporary file " + file.error().message);
  return std::move(file).value();
}

}  // namespace folprom::io
