// Rows of small numbers in few bits: exponential Golomb codes of an order that suits the row.
#pragma once

#include <cstdint>
#include <span>

#include "io/container/byte_code.h"

namespace folprom::io {

inline constexpr int kRowParameterBits = 5;

/// The order that makes the row shortest, the smallest of several, then the numbers: below 2^62.
void WriteRow(std::span<const uint64_t> numbers, BitWriter* bits);
inline int ReadOrder(BitReader* bits) { return static_cast<int>(bits->Bits(kRowParameterBits)); }
/// The next number of a row of that order.
uint64_t ReadNumber(int order, BitReader* bits);

}  // namespace folprom::io
