#include "apps/batch/glob.h"

#include <fnmatch.h>

#include <algorithm>

#include "folprom/result.h"

namespace folprom::batch {
namespace {

namespace fs = std::filesystem;

bool HasWildcard(const std::string& name) { return name.find_first_of("*?[") != std::string::npos; }

bool NameMatches(const std::string& pattern, const std::string& name) {
  return ::fnmatch(pattern.c_str(), name.c_str(), FNM_PERIOD) == 0;
}

}  // namespace

Glob::Glob(const fs::path& pattern) {
  const fs::path normal = pattern.lexically_normal();
  for (const fs::path& name : normal) {
    wildcard_ = wildcard_ || HasWildcard(name.string());
    if (name == "**") any_depth_ = true;
    if (wildcard_) {
      parts_.push_back(name.string());
    } else {
      root_ /= name;
    }
  }
  if (!wildcard_) {
    parts_.push_back(root_.filename().string());
    root_ = root_.parent_path();
  }
  // One folder has one name, whatever links lead to it.
  std::error_code unknown;
  const fs::path canonical = fs::weakly_canonical(root_, unknown);
  if (!unknown) root_ = canonical;
}

bool Glob::MatchesFrom(const std::vector<std::string>& names, size_t name, size_t part) const {
  if (part == parts_.size()) return name == names.size();
  if (parts_[part] == "**") {
    for (size_t skipped = name; skipped <= names.size(); ++skipped) {
      if (MatchesFrom(names, skipped, part + 1)) return true;
      if (skipped < names.size() && names[skipped].starts_with('.')) return false;
    }
    return false;
  }
  if (name == names.size()) return false;
  const bool same =
      wildcard_ ? NameMatches(parts_[part], names[name]) : parts_[part] == names[name];
  return same && MatchesFrom(names, name + 1, part + 1);
}

bool Glob::Matches(const fs::path& path) const {
  std::vector<std::string> names;
  auto at = path.begin();
  for (const fs::path& fixed : root_) {
    if (at == path.end() || *at != fixed) return false;
    ++at;
  }
  for (; at != path.end(); ++at) names.push_back(at->string());
  return MatchesFrom(names, 0, 0);
}

std::vector<std::string> Glob::Files() const {
  std::vector<std::string> files;
  std::error_code error;
  if (!wildcard_) {
    const fs::path file = root_ / parts_.front();
    if (fs::is_regular_file(file, error)) files.push_back(file.string());
    return files;
  }
  if (!fs::is_directory(root_, error)) return files;
  // Through links only where the pattern bounds the depth: they may lead round in a circle.
  const auto links =
      any_depth_ ? fs::directory_options::none : fs::directory_options::follow_directory_symlink;
  fs::recursive_directory_iterator entry(root_, links, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    const bool too_deep = !any_depth_ && static_cast<size_t>(entry.depth()) + 1 >= parts_.size();
    const bool hidden = entry->path().filename().string().starts_with('.');
    if (too_deep || hidden) entry.disable_recursion_pending();
    std::error_code unreadable;
    if (Matches(entry->path()) && entry->is_regular_file(unreadable)) {
      files.push_back(entry->path().string());
    }
  }
  if (error) throw Failure(ErrorKind::kInput, root_.string() + ": " + error.message());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace folprom::batch
