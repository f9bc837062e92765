// The one hash of the format.
#pragma once

#include <cstdint>
#include <span>

namespace folprom::io {

/// XXH3, 64 bits, seed 0, of `bytes` (may be empty). The same value on every machine.
uint64_t XxHash64(std::span<const uint8_t> bytes);

}  // namespace folprom::io
