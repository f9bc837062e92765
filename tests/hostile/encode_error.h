// Encodes scans that may be damaged.
#pragma once

#include <string>
#include <string_view>

#include "tests/hostile/support.h"

namespace folprom::hostile {

/// Encodes `scan`, which may fail only with kInput, and then leaves nothing; what was encoded must
/// verify. Returns the error's message, empty after success.
std::string EncodeError(const std::string& scan, EncodeOptions options = SmallOptions());

/// The same of a file of these bytes and this name.
std::string EncodeErrorOfBytes(std::string_view bytes,
                               const EncodeOptions& options = SmallOptions(),
                               const std::string& name = "scan.ply");

}  // namespace folprom::hostile
