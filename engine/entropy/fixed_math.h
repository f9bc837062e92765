// Elementary functions from + - * / and sqrt only, so that every machine gets the same bits.
#pragma once

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>

#if defined(__FAST_MATH__) || FLT_EVAL_METHOD != 0
#error \
    "files would differ: floating point must be rounded after every operation, as IEEE 754 has it"
#endif

namespace folprom {

inline constexpr double kPi = 3.14159265358979323846;

/// Natural exponential for |x| < 40; relative error below 1e-14.
constexpr double ExpExact(double x) {
  double reduced = x / 64;  // |reduced| < 0.63, then six squarings
  double term = 1, sum = 1;
  for (int i = 1; i < 20; ++i) {
    term = term * reduced / i;
    sum = sum + term;
  }
  for (int i = 0; i < 6; ++i) sum = sum * sum;
  return sum;
}

/// Binary logarithm of x > 0; absolute error below 1e-12.
constexpr double Log2Exact(double x) {
  double whole = 0;
  while (x >= 2) {
    x = x / 2;
    whole = whole + 1;
  }
  while (x < 1) {
    x = x * 2;
    whole = whole - 1;
  }
  double y = (x - 1) / (x + 1), square = y * y, power = y, sum = 0;
  for (int i = 1; i < 40; i += 2) {
    sum = sum + power / i;
    power = power * square;
  }
  return whole + 2 * sum / 0.69314718055994530942;
}

/// Sine and cosine of an angle of any sign below 100 radians in size; absolute error below 2e-14.
inline void SinCos(double angle, double* sine, double* cosine) {
  double turns = std::floor(angle / (kPi / 2) + 0.5);
  double x = angle - turns * (kPi / 2), square = x * x;
  double s =
      x * (1 - square / 6 *
                   (1 - square / 20 *
                            (1 - square / 42 *
                                     (1 - square / 72 *
                                              (1 - square / 110 *
                                                       (1 - square / 156 * (1 - square / 210)))))));
  double c =
      1 -
      square / 2 *
          (1 - square / 12 *
                   (1 - square / 30 *
                            (1 - square / 56 *
                                     (1 - square / 90 *
                                              (1 - square / 132 *
                                                       (1 - square / 182 * (1 - square / 240)))))));
  switch (static_cast<int>(static_cast<int64_t>(turns) & 3)) {
    case 0:
      *sine = s;
      *cosine = c;
      break;
    case 1:
      *sine = c;
      *cosine = -s;
      break;
    case 2:
      *sine = -s;
      *cosine = -c;
      break;
    default:
      *sine = -c;
      *cosine = s;
      break;
  }
}

/// Angle of (x, y) in [0, 2 pi); 0 for the origin. Absolute error below 1e-14.
inline double Angle(double x, double y) {
  double length = std::sqrt(x * x + y * y);
  if (!(length > 0)) return 0;
  // Three half-angle steps bring the tangent below 0.21; then the series.
  double c = x / length, s = y / length;
  bool negative = s < 0;
  if (negative) s = -s;
  double tangent = c > 0 ? s / (1 + c) : (s > 0 ? (1 - c) / s : 0);
  if (!(c > 0) && !(s > 0)) return kPi;
  // angle = 2 atan(tangent), tangent in [0, inf)
  bool inverted = tangent > 1;
  if (inverted) tangent = 1 / tangent;
  tangent = tangent / (1 + std::sqrt(1 + tangent * tangent));
  tangent = tangent / (1 + std::sqrt(1 + tangent * tangent));
  double square = tangent * tangent, power = tangent, sum = 0;
  for (int i = 1; i < 28; i += 2) {
    sum = sum + (i % 4 == 1 ? power : -power) / i;
    power = power * square;
  }
  double half = 4 * sum;
  if (inverted) half = kPi / 2 - half;
  double angle = 2 * half;
  if (negative) angle = 2 * kPi - angle;
  return angle < 2 * kPi ? angle : 0;
}

/// About the floor of 2 log2(value) for value >= 1 (half octaves begin at 181/128 of a power of
/// two); 0 for 0.
inline int HalfOctave(uint64_t value) {
  if (value < 2) return 0;
  int width = static_cast<int>(std::bit_width(value)) - 1;
  // The half octave begins at sqrt(2) = 1.0110101b; seven bits decide.
  uint64_t top = width >= 7 ? value >> (width - 7) : value << (7 - width);
  return 2 * width + (top >= 181 ? 1 : 0);
}

}  // namespace folprom
