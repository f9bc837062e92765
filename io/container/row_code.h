// Rows of small numbers in few bits: exponential Golomb codes of an order that suits the row.
#pragma once

#include <cstdint>
#include <span>

#include "io/container/byte_code.h"

namespace folprom::io {

inline constexpr int kRowParameterBits = 5;
/// Numbers of rows are below this.
inline constexpr uint64_t kMaxRowNumber = uint64_t{1} << 62;

/// The order that makes the row shortest, the smallest of several.
int BestOrder(std::span<const uint64_t> numbers);

/// The order, then the numbers.
void WriteRow(std::span<const uint64_t> numbers, BitWriter* bits);
inline int ReadOrder(BitReader* bits) { return static_cast<int>(bits->Bits(kRowParameterBits)); }
/// The next number of a row of that order.
uint64_t ReadNumber(int order, BitReader* bits);

}  // namespace folprom::io
