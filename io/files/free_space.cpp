#include "io/files/free_space.h"

#include <sys/stat.h>
#include <sys/statvfs.h>

#include "io/files/posix.h"

namespace folprom::io {

Volume VolumeOf(const std::string& folder) {
  struct stat status {};
  struct statvfs room {};
  if (::stat(folder.c_str(), &status) != 0 || ::statvfs(folder.c_str(), &room) != 0) {
    ThrowSystemError(ErrorKind::kOutput, folder, "cannot tell how much room there is");
  }
  return {uint64_t{status.st_dev}, uint64_t{room.f_bavail} * uint64_t{room.f_frsize}};
}

}  // namespace folprom::io
