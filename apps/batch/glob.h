// Patterns of file names: which files they name, and whether a file that is not there yet would be.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace folprom::batch {

/// An absolute path in which a name may hold *, ? and [a-z], and a whole name may be **: any
/// folders, also none. Hidden names are matched by no wildcard; ** follows no link to a folder.
class Glob {
 public:
  explicit Glob(const std::filesystem::path& pattern);

  /// The folders before the first name with a wildcard; of a plain path its folder.
  const std::filesystem::path& root() const { return root_; }
  bool has_wildcard() const { return wildcard_; }
  /// `path` is absolute and normal.
  bool Matches(const std::filesystem::path& path) const;
  /// The regular files that match, sorted. Throws Failure kInput where a folder cannot be read.
  std::vector<std::string> Files() const;

 private:
  bool MatchesFrom(const std::vector<std::string>& names, size_t name, size_t part) const;

  std::filesystem::path root_;
  std::vector<std::string> parts_;  ///< names below root_
  bool wildcard_ = false;
  bool any_depth_ = false;
};

}  // namespace folprom::batch
