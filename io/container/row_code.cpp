#include "io/container/row_code.h"

#include <bit>

namespace folprom::io {
namespace {

int BitWidth(uint64_t value) { return static_cast<int>(std::bit_width(value)); }

/// Length of the exponential Golomb code of an order.
int CodeBits(uint64_t number, int order) {
  return 2 * BitWidth(number + (uint64_t{1} << order)) - 1 - order;
}

/// The order that makes the row shortest, the smallest of several.
int BestOrder(std::span<const uint64_t> numbers) {
  int best = 0;
  uint64_t best_bits = UINT64_MAX;
  for (int order = 0; order < 1 << kRowParameterBits; ++order) {
    uint64_t bits = 0;
    for (const uint64_t number : numbers) bits += static_cast<uint64_t>(CodeBits(number, order));
    if (bits >= best_bits) continue;
    best_bits = bits;
    best = order;
  }
  return best;
}

}  // namespace

void WriteRow(std::span<const uint64_t> numbers, BitWriter* bits) {
  const int order = BestOrder(numbers);
  bits->Bits(static_cast<uint64_t>(order), kRowParameterBits);
  for (const uint64_t number : numbers) {
    const uint64_t shifted = number + (uint64_t{1} << order);
    const int width = BitWidth(shifted);
    bits->Bits(0, width - 1 - order);
    bits->Bits(shifted, width);
  }
}

uint64_t ReadNumber(int order, BitReader* bits) {
  const int width = order + bits->Zeros(62 - order);
  return ((uint64_t{1} << width) | bits->Bits(width)) - (uint64_t{1} << order);
}

}  // namespace folprom::io
