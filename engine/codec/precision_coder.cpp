#include "engine/codec/precision_coder.h"

#include <algorithm>

#include "engine/entropy/bit_coder.h"

namespace folprom {

template <class Coder>
void PrecisionCoder::Code(Coder& coder, uint32_t shift, const LatticePrecision& chosen) {
  finer_[0] = CodeFiner(coder, 0, shift - chosen.tangential);
  const uint32_t left = shift - std::min(finer_[0], shift);
  finer_[1] = CodeFiner(coder, 1, left - chosen.normal);
  Follow(shift);
}

void PrecisionCoder::Follow(uint32_t shift) {
  precision_.tangential = shift - std::min(finer_[0], shift);
  precision_.normal = precision_.tangential - std::min(finer_[1], precision_.tangential);
}

template <class Coder>
uint32_t PrecisionCoder::CodeFiner(Coder& coder, uint32_t which, uint32_t finer) {
  const uint32_t before = finer_[which];
  if (same_.Code(coder, {which}, 0, finer == before)) return before;
  uint32_t coded = 0;
  for (uint32_t bit = 0; bit < 5; ++bit) {
    coded |= static_cast<uint32_t>(coder.Code(32768, (finer >> bit & 1) != 0)) << bit;
  }
  return coded;
}

template void PrecisionCoder::Code<BitEncoder>(BitEncoder&, uint32_t, const LatticePrecision&);
template void PrecisionCoder::Code<BitDecoder>(BitDecoder&, uint32_t, const LatticePrecision&);

}  // namespace folprom
