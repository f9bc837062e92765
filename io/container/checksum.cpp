#include "io/container/checksum.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace folprom::io {

uint64_t XxHash64(std::span<const uint8_t> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace folprom::io
