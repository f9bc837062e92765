// How much room a disk has.
#pragma once

#include <cstdint>
#include <string>

namespace folprom::io {

/// The file system of a folder.
struct Volume {
  uint64_t id = 0;          ///< the same for folders of one file system
  uint64_t free_bytes = 0;  ///< that this user may still write
};

/// Throws Failure kOutput with the path where it cannot be told.
Volume VolumeOf(const std::string& folder);

}  // namespace folprom::io
