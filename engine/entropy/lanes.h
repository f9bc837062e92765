// Four floats at a time, alike on every machine: each lane is computed on its own, and sums over
// lanes have one order.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace folprom {

using Lanes = float __attribute__((vector_size(16)));
using LaneIntegers = int32_t __attribute__((vector_size(16)));
inline constexpr uint32_t kLanes = 4;

inline Lanes AllLanes(float value) { return Lanes{value, value, value, value}; }
#ifdef __SSE2__
// The same in one instruction, which g++ 12 does not find by itself.
inline Lanes LesserOf(Lanes a, Lanes b) { return _mm_min_ps(a, b); }
inline Lanes GreaterOf(Lanes a, Lanes b) { return _mm_max_ps(a, b); }
inline Lanes SquareRoot(Lanes a) { return _mm_sqrt_ps(a); }
#else
inline Lanes LesserOf(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes GreaterOf(Lanes a, Lanes b) { return a > b ? a : b; }
inline Lanes SquareRoot(Lanes a) {
  return Lanes{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}
#endif
inline Lanes Magnitude(Lanes a) { return GreaterOf(a, -a); }
inline float SumOf(Lanes a) { return (a[0] + a[1]) + (a[2] + a[3]); }
#ifdef __SSE2__
inline float MostOf(Lanes a) {
  const __m128 halves = _mm_max_ps(a, _mm_movehl_ps(a, a));
  return _mm_cvtss_f32(_mm_max_ss(halves, _mm_shuffle_ps(halves, halves, 1)));
}
#else
inline float MostOf(Lanes a) { return std::fmax(std::fmax(a[0], a[1]), std::fmax(a[2], a[3])); }
#endif
inline Lanes LoadLanes(const float* values) {
  Lanes result;
  std::memcpy(&result, values, sizeof result);
  return result;
}
inline void StoreLanes(Lanes lanes, float* values) { std::memcpy(values, &lanes, sizeof lanes); }
/// Towards zero.
inline LaneIntegers WholeOf(Lanes a) { return __builtin_convertvector(a, LaneIntegers); }
inline Lanes FloatsOf(LaneIntegers a) { return __builtin_convertvector(a, Lanes); }
inline Lanes LookUp(const float* table, LaneIntegers at) {
  return Lanes{table[at[0]], table[at[1]], table[at[2]], table[at[3]]};
}
/// table[at] and table[at + 1].
struct NeighbouringLanes {
  Lanes here, next;
};
#ifdef __SSE2__
inline NeighbouringLanes LookUpTwo(const float* table, LaneIntegers at) {
  // Both values of a lane in one load.
  const auto two = [&](int lane) {
    return _mm_castsi128_ps(_mm_loadu_si64(table + static_cast<uint32_t>(at[lane])));
  };
  const __m128 first = _mm_movelh_ps(two(0), two(1)), second = _mm_movelh_ps(two(2), two(3));
  return {_mm_shuffle_ps(first, second, 0x88), _mm_shuffle_ps(first, second, 0xdd)};
}
#else
inline NeighbouringLanes LookUpTwo(const float* table, LaneIntegers at) {
  return {LookUp(table, at), LookUp(table + 1, at)};
}
#endif

/// 2^x for |x| <= 60, relative error below 1e-4.
inline Lanes FastExp2(Lanes x) {
  constexpr float kShift = 64;
  const LaneIntegers whole = WholeOf(x + kShift);
  const Lanes f = x + kShift - FloatsOf(whole);
  const Lanes value =
      1 + f * (0.69314718F + f * (0.24022651F + f * (0.05550410F + f * 0.00961812F)));
  const LaneIntegers exponent = (whole - static_cast<int32_t>(kShift) + 127) << 23;
  return value * reinterpret_cast<Lanes>(exponent);
}

}  // namespace folprom
