// Values of which none is likelier than another.
#pragma once

#include <bit>
#include <cstdint>

#include "folprom/result.h"

namespace folprom {

/// Codes a value in 0 .. most, in as many bits as `most` has. Throws Failure(kCorrupt, message)
/// where what is decoded lies beyond.
template <class Coder>
uint64_t CodeEvenly(Coder& coder, uint64_t most, uint64_t value, const char* message) {
  uint64_t coded = 0;
  for (int bit = static_cast<int>(std::bit_width(most)) - 1; bit >= 0; --bit) {
    coded |= static_cast<uint64_t>(coder.Code(32768, (value >> bit & 1) != 0)) << bit;
  }
  if (coded > most) throw Failure(ErrorKind::kCorrupt, message);
  return coded;
}

}  // namespace folprom
