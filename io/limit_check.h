// Refuses what is larger than a limit.
#pragma once

#include <cstdint>
#include <string>

#include "folprom/limits.h"
#include "folprom/result.h"

namespace folprom::io {

/// Failure kLimit where `path` has more than `most` of `what`, which is the name of the limit.
inline void CheckLimit(const std::string& path, uint64_t count, uint64_t most, const char* what) {
  if (count <= most) return;
  throw Failure(ErrorKind::kLimit, path + ": " + std::to_string(count) + " " + what +
                                       " are more than the limit of " + std::to_string(most));
}

}  // namespace folprom::io
