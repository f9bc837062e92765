// Temporary folders, whole files, and the shared scans.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace folprom::support {

/// A fresh folder that goes, with all in it, at the end of the scope.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }
  std::string File(const std::string& name) const { return path_ + "/" + name; }
  /// Names of all files and folders inside, sorted.
  std::vector<std::string> Names() const;

 private:
  std::string path_;
};

std::vector<uint8_t> FileBytes(const std::string& path);

/// A file of the shared scans, such as "scans/igea.ply"; empty where it is missing.
std::string SharedFile(const std::string& name);
/// Every PLY of scans/ and hard/, as names for SharedFile, sorted; empty where there are none.
std::vector<std::string> SharedScans();
inline constexpr const char* kNoSharedData =
    "the shared scans are missing; FOLPROM_SHARED names their folder";

/// Do the sanitizers slow this build down so much that only small scans are worth it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace folprom::support
