// What a file holds, told by a hash of its content; and when the hash of an earlier look still
// holds.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "parallel/progress.h"

namespace folprom::batch {

/// Changes with every write to the file, and with its replacement.
struct FileStamp {
  uint64_t size = 0;
  int64_t modified_ns = 0;  ///< time of the last change of the content
  int64_t changed_ns = 0;   ///< time of the last change of content, name or rights
  uint64_t inode = 0;
  bool operator==(const FileStamp&) const = default;
};

/// None where there is no regular file.
std::optional<FileStamp> StampOf(const std::string& path);

struct KnownFile {
  std::string path;
  FileStamp stamp;
  std::string hash;  ///< XXH3, 128 bits, hexadecimal
};

/// Reads the file and gives its hash and stamp. Throws Failure kInput where it cannot be read or
/// changes meanwhile; Cancelled.
KnownFile HashFile(const std::string& path, parallel::Progress& progress);

/// Hashes by path, each good for as long as the stamp is the same.
class HashCache {
 public:
  void Remember(const KnownFile& file) { files_[file.path] = file; }
  /// None where the file is missing or has another stamp.
  std::optional<KnownFile> Find(const std::string& path) const;
  /// From the cache, or by reading the file.
  KnownFile Get(const std::string& path, parallel::Progress& progress);

 private:
  std::map<std::string, KnownFile> files_;
};

}  // namespace folprom::batch
