#include "io/files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "io/files/posix.h"
#include "io/result_of.h"

namespace folprom::io {
namespace {

namespace fs = std::filesystem;

Failure OutputFailure(const std::string& path, const std::string& reason) {
  return {ErrorKind::kOutput, path + ": " + reason};
}

/// Permission bits of the file that will be replaced; none where there is none.
std::optional<mode_t> CheckTarget(const std::string& path, bool force) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    const int reason = errno;
    // Renaming would put the file in the place of the link, not of what it names.
    if (reason == ENOENT && ::lstat(path.c_str(), &status) == 0 && S_ISLNK(status.st_mode)) {
      throw OutputFailure(path, "is a symbolic link to a file that does not exist");
    }
    if (reason == ENOENT) return std::nullopt;
    errno = reason;
    ThrowSystemError(ErrorKind::kOutput, path, "cannot be written");
  }
  if (S_ISDIR(status.st_mode)) throw OutputFailure(path, "is a directory");
  // Renaming over a device or a pipe would destroy it.
  if (!S_ISREG(status.st_mode)) throw OutputFailure(path, "is not a regular file");
  if (!force) throw OutputFailure(path, "exists already (not overwritten unless forced)");
  return status.st_mode & 07777;
}

class AtomicFileOnDisk final : public AtomicFile {
 public:
  AtomicFileOnDisk(const std::string& path, bool force) : path_(path), force_(force) {
    if (path.empty() || path.back() == '/') throw OutputFailure(path, "is not a file name");
    const std::optional<mode_t> old_mode = CheckTarget(path, force);
    target_ = path;
    // Through a symbolic link the file it names is replaced, not the link.
    if (old_mode && fs::is_symlink(path)) target_ = fs::canonical(path).string();
    const fs::path parent = fs::path(target_).parent_path();
    folder_ = parent.empty() ? std::string(1, '.') : parent.string();
    if (!fs::is_directory(folder_)) {
      throw OutputFailure(path, "the folder " + folder_ + " does not exist");
    }
    file_ = CreateUnnamedFile(folder_);
    if (!file_.open()) file_ = CreateHiddenFile(folder_, path_, &temporary_);
    if (old_mode) ::fchmod(file_.get(), *old_mode);
  }

  ~AtomicFileOnDisk() override {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }

  Result<void> Append(std::span<const uint8_t> bytes) override {
    Result<void> result = WriteAt(end_, bytes);
    if (result) end_ += bytes.size();
    return result;
  }

  Result<void> WriteAt(uint64_t offset, std::span<const uint8_t> bytes) override {
    return ResultOf([&] { WriteAllAt(OpenFile(), offset, bytes, path_); });
  }

  Result<void> AppendFrom(const ScratchFile& scratch) override {
    return ResultOf([&] {
      scratch.CopyTo(OpenFile(), end_, path_);
      end_ += scratch.size();
    });
  }

  const std::string& folder() const override { return folder_; }

  Result<void> Commit() override {
    return ResultOf([&] {
      if (::fsync(OpenFile()) != 0) ThrowSystemError(ErrorKind::kOutput, path_, "cannot sync");
      if (temporary_.empty()) temporary_ = NameHidden(file_, folder_, path_);
      file_.CloseChecked(path_);
      Rename();
      temporary_.clear();
      SyncFolder();
    });
  }

 private:
  int OpenFile() const {
    if (!file_.open()) {
      throw Failure(ErrorKind::kInternal, path_ + ": written to after it was committed");
    }
    return file_.get();
  }

  void Rename() {
    if (force_) {
      if (::rename(temporary_.c_str(), target_.c_str()) == 0) return;
    } else {
      // The target may have appeared since Create.
      if (::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) ==
          0) {
        return;
      }
      if (errno == EINVAL || errno == ENOSYS) {  // a file system without it
        CheckTarget(path_, force_);
        if (::rename(temporary_.c_str(), target_.c_str()) == 0) return;
      }
    }
    ThrowSystemError(ErrorKind::kOutput, path_, "cannot rename into place");
  }

  void SyncFolder() {
    const Descriptor folder(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    // A folder that may be written but not read, or a file system that cannot sync folders, has
    // still the complete file under its name.
    if (!folder.open()) return;
    if (::fsync(folder.get()) != 0 && errno != EINVAL && errno != ENOTSUP) {
      ThrowSystemError(ErrorKind::kOutput, folder_, "cannot sync the folder");
    }
  }

  std::string path_;
  bool force_;
  std::string target_;
  std::string folder_;
  std::string temporary_;
  Descriptor file_;
  uint64_t end_ = 0;
};

}  // namespace

Result<std::unique_ptr<AtomicFile>> AtomicFile::Create(const std::string& path, bool force) {
  return ResultOf([&]() -> std::unique_ptr<AtomicFile> {
    try {
      return std::make_unique<AtomicFileOnDisk>(path, force);
    } catch (const fs::filesystem_error& error) {
      throw OutputFailure(path, error.code().message());
    }
  });
}

Result<void> WriteWholeFile(const std::string& path, std::string_view text, bool force) {
  return ResultOf([&] {
    const auto file = AtomicFile::Create(path, force).value();
    file->Append({reinterpret_cast<const uint8_t*>(text.data()), text.size()}).value();
    file->Commit().value();
  });
}

}  // namespace folprom::io
