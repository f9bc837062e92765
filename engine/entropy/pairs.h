// Two doubles at a time, alike on every machine: each lane is computed on its own, in the order in
// which one double would be.
#pragma once

#include <cmath>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace folprom {

using Pair = double __attribute__((vector_size(16)));

inline Pair Both(double value) { return Pair{value, value}; }
inline Pair Swapped(Pair a) { return __builtin_shufflevector(a, a, 1, 0); }
/// The first of one and the second of another, and so on.
inline Pair FirstFirst(Pair a, Pair b) { return __builtin_shufflevector(a, b, 0, 2); }
inline Pair FirstSecond(Pair a, Pair b) { return __builtin_shufflevector(a, b, 0, 3); }
inline Pair SecondFirst(Pair a, Pair b) { return __builtin_shufflevector(a, b, 1, 2); }
inline Pair SecondSecond(Pair a, Pair b) { return __builtin_shufflevector(a, b, 1, 3); }
#ifdef __SSE2__
inline Pair SquareRoot(Pair a) { return _mm_sqrt_pd(a); }
#else
inline Pair SquareRoot(Pair a) { return Pair{std::sqrt(a[0]), std::sqrt(a[1])}; }
#endif

}  // namespace folprom
