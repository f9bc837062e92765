// A disk that fails when it is told to: this program's own system calls to write stand before those
// of the C library.
#pragma once

#include <cstdint>

namespace folprom::hostile {

enum class DiskFault : uint8_t {
  kFull,    ///< no room after so many bytes
  kShort,   ///< a call takes at most so many bytes
  kSync,    ///< the call to sync after so many fails
  kRename,  ///< the call to rename after so many fails
};

/// The fault of all files as long as it lives; one at a time.
class FailingDisk {
 public:
  FailingDisk(DiskFault fault, uint64_t after);
  ~FailingDisk();
  FailingDisk(const FailingDisk&) = delete;
  FailingDisk& operator=(const FailingDisk&) = delete;

  /// Bytes written since it was made.
  uint64_t written() const;
  /// Has the fault occurred.
  bool has_failed() const;
};

}  // namespace folprom::hostile
