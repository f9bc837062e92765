// The lattice of an exact encoding: coordinates as integers over a power of 2 or 10, and what such
// a lattice leaves over of a coordinate that does not lie on it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace folprom {

/// A position as it stood in the scan; floats are widened (folprom/float_bits.h).
using ExactPosition = std::array<double, 3>;

/// What is added to a point of the lattice. With `digits` further digits the coordinate is
/// (whole * radix^digits + value) / radix^(exponent + digits), rounded to its type.
struct CoordinateRest {
  static constexpr uint32_t kRaw = 255;
  uint32_t digits = 0;  ///< as few as possible; kRaw: `value` is the bits of the double itself
  uint64_t value = 0;
  bool operator==(const CoordinateRest&) const = default;
};

/// A step of radix^-exponent.
struct ExactStep {
  uint32_t radix = 10;     ///< 2 or 10
  int32_t exponent = 0;    ///< 0 .. 22 for radix 10, -126 .. 1074 for radix 2
  bool is_float = false;   ///< coordinates are binary32, else binary64
  bool has_rests = false;  ///< not every coordinate lies on the lattice
  bool operator==(const ExactStep&) const = default;

  static constexpr int32_t kMostDecimals = 22;  ///< 10^22 is the last power that a double holds
  static constexpr int32_t kLeastBits = -126, kMostBits = 1074;
  /// Larger coordinates, and those that are not finite, are only ever coded as raw bits.
  static constexpr double kLargest = 1e37;

  /// The step as a double.
  double Unit() const;
  /// x as a number of steps, not yet an integer.
  double Scaled(double x) const;
  /// number / radix^(exponent + digits) as a double; |number| <= 2^53.
  double Quotient(int64_t number, uint32_t digits) const;
  /// The same rounded to the type of the coordinates.
  double Value(int64_t number, uint32_t digits) const;
  /// Largest number of digits of a rest beside `whole`: numbers stay below 2^53.
  uint32_t MostDigits(int64_t whole) const;
  /// Number of digits of |whole| in the radix: by it the digits of rests are told.
  uint32_t SizeOf(int64_t whole) const;
};

/// Is the coordinate one that a lattice can be chosen by: finite, and not absurdly large.
bool IsTame(double x);
/// The sign of a zero is nothing that a lattice tells.
bool IsNegativeZero(double x);
/// Fewest decimals with which the coordinate can be written, kMostDecimals + 1 where that is none.
int32_t DecimalsOf(double x, bool is_float);
/// Fewest bits behind the binary point, negative where it is a multiple of a power of 2; x is not
/// 0.
int32_t FractionBitsOf(double x);
/// The multiple of the step at or below a tame coordinate.
int64_t WholeOf(const ExactStep& step, double x);

/// An ExactStep and where the box begins.
struct ExactLattice {
  ExactStep step;
  std::array<int64_t, 3> first{};  ///< whole number of lattice coordinate 0, at most 2^50 in size

  static constexpr int64_t kLargestWhole = int64_t{1} << 50;

  /// The coordinate of a vertex that lies on the lattice.
  double ToModel(size_t axis, int32_t k) const { return step.Value(first[axis] + k, 0); }

  struct Coordinate {
    int32_t k = 0;
    CoordinateRest rest;
  };
  /// k is kept inside 0 .. extent, in its middle for what is not tame. Encoder only.
  Coordinate Split(size_t axis, int32_t extent, double x) const;
  /// The same coordinate, bit for bit.
  double Join(size_t axis, int32_t k, const CoordinateRest& rest) const;
};

}  // namespace folprom
