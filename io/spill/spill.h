// Temporary files of one job: many append-only streams, written in bounded memory, read mapped.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "folprom/result.h"
#include "io/files/mapped_file.h"

namespace folprom::io {

/// A fresh private folder below `parent` (empty: $TMPDIR or /tmp). Removed, with all in it, by the
/// destructor. All errors are thrown as Failure kOutput (disk full, not writable), with the path.
class SpillDirectory {
 public:
  explicit SpillDirectory(const std::string& parent);
  ~SpillDirectory();
  SpillDirectory(const SpillDirectory&) = delete;
  SpillDirectory& operator=(const SpillDirectory&) = delete;

  const std::string& path() const { return path_; }
  /// Path of a file `name` inside.
  std::string File(const std::string& name) const;
  /// Bytes of all files inside at this moment.
  uint64_t SizeBytes() const;

 private:
  std::string path_;
};

/// `stream_count` append-only files "<name>.<index>" with one buffer each; buffers together take at
/// most `buffer_bytes`. Append is not thread-safe. Streams that stay empty have no file.
class SpillStreams {
 public:
  SpillStreams(const SpillDirectory& directory, std::string name, size_t stream_count,
               uint64_t buffer_bytes);
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
