// Temporary files of one job: many append-only streams, written in bounded memory, read mapped.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "folprom/result.h"
#include "io/files/mapped_file.h"
#include "io/files/posix.h"

namespace folprom::io {

/// A private folder below `parent` (empty: $TMPDIR or /tmp). Removed, with all in it, by the
/// destructor unless it is kept. All errors are thrown as Failure kOutput (disk full, not
/// writable), with the path.
class SpillDirectory {
 public:
  /// A fresh one.
  explicit SpillDirectory(const std::string& parent);
  /// The folder "folprom-<name>", with what an earlier process left in it; made where it is not
  /// there. Nobody else opens it so while the object lives. Null where another process has it, or
  /// where it cannot be told to be this user's alone.
  static std::unique_ptr<SpillDirectory> OpenNamed(const std::string& parent,
                                                   const std::string& name);
  ~SpillDirectory();
  SpillDirectory(const SpillDirectory&) = delete;
  SpillDirectory& operator=(const SpillDirectory&) = delete;

  const std::string& path() const { return path_; }
  /// Removes all in it.
  void Clear() const;
  /// The destructor leaves the folder for a later OpenNamed.
  void Keep() { kept_ = true; }
  /// Path of a file `name` inside.
  std::string File(const std::string& name) const;
  /// Bytes of one file inside.
  uint64_t FileBytes(const std::string& name) const;
  /// Bytes of all files inside at this moment.
  uint64_t SizeBytes() const;

 private:
  SpillDirectory(std::string path, Descriptor lock)
      : path_(std::move(path)), lock_(std::move(lock)) {}

  std::string path_;
  Descriptor lock_;  ///< the folder itself, where it has a name that others could open
  bool kept_ = false;
};

/// `stream_count` append-only files "<name>.<index>" with one buffer each; buffers together take at
/// most `buffer_bytes`. Append is not thread-safe. Streams that stay empty have no file.
class SpillStreams {
 public:
  SpillStreams(const SpillDirectory& directory, std::string name, size_t stream_count,
               uint64_t buffer_bytes);
  /// Finished ones that were left in a kept folder, each of so many bytes.
  SpillStreams(const SpillDirectory& directory, std::string name,
               std::span<const uint64_t> stream_bytes);
  ~SpillStreams();
  void Append(size_t stream, const void* bytes, size_t size);
  template <class T>
  void AppendValue(size_t stream, const T& value) {
    Append(stream, &value, sizeof value);
  }
  /// Writes all buffers out. No Append after it.
  void Finish();
  /// After Finish: the stream mapped; an empty MappedFile where nothing was appended. Thread-safe.
  MappedFile Map(size_t stream) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes one whole file in the spill folder. Thread-safe for different names.
void WriteSpillFile(const SpillDirectory& directory, const std::string& name,
                    std::span<const uint8_t> bytes);

/// Maps a temporary file. A fault is one of the temporary disk: Failure kOutput with the path.
MappedFile MapSpillFile(const std::string& path);

/// A mapped file's bytes as an array of T. The size must be a multiple of sizeof(T).
template <class T>
std::span<const T> MappedArray(const MappedFile& file) {
  return {reinterpret_cast<const T*>(file.bytes().data()), file.bytes().size() / sizeof(T)};
}

}  // namespace folprom::io
