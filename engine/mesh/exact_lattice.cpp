#include "engine/mesh/exact_lattice.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace folprom {
namespace {

constexpr int64_t kLargestNumber = int64_t{1} << 53;

constexpr auto kPowersOfTen = [] {
  std::array<double, ExactStep::kMostDecimals + 1> powers{};
  double power = 1;
  for (double& entry : powers) {
    entry = power;
    power = power * 10;
  }
  return powers;
}();

double PowerOfTen(int32_t exponent) { return kPowersOfTen[static_cast<size_t>(exponent)]; }

double RoundedTo(bool is_float, double value) {
  return is_float ? static_cast<double>(static_cast<float>(value)) : value;
}

/// radix^digits, which is known to be at most 2^53.
int64_t Power(uint32_t radix, uint32_t digits) {
  if (radix == 2) return int64_t{1} << digits;
  return static_cast<int64_t>(PowerOfTen(static_cast<int32_t>(digits)));
}

/// The size of a number as its digits show it; -1 is as large as 0, since wholes are rounded down.
uint64_t Size(int64_t whole) { return static_cast<uint64_t>(whole < 0 ? ~whole : whole); }

/// The integer whose quotient with 10^decimals is x, if there is one.
bool FindDecimal(double x, bool is_float, int32_t decimals, int64_t* number) {
  const double scaled = x * PowerOfTen(decimals);
  if (!(std::fabs(scaled) < static_cast<double>(kLargestNumber))) return false;
  const double nearest = std::floor(scaled + 0.5);
  *number = static_cast<int64_t>(nearest);
  return RoundedTo(is_float, nearest / PowerOfTen(decimals)) == x;
}

/// x = number * 2^-bits with an odd number, x is finite and not 0.
struct BinaryNumber {
  int64_t number;
  int32_t bits;
};
BinaryNumber BinaryNumberOf(double x) {
  int exponent = 0;
  auto number = static_cast<int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int zeros = std::countr_zero(static_cast<uint64_t>(number));
  return {number >> zeros, 53 - exponent - zeros};
}

int64_t FloorDivide(int64_t number, int64_t divisor) {
  const int64_t quotient = number / divisor;
  return number % divisor < 0 ? quotient - 1 : quotient;
}

struct Whole {
  int64_t number;
  CoordinateRest rest;
};

/// The number at or below x, for what no further digits describe.
Whole Raw(const ExactStep& step, double x) {
  const double limit = static_cast<double>(kLargestNumber);
  return {static_cast<int64_t>(std::floor(std::clamp(step.Scaled(x), -limit, limit))),
          {CoordinateRest::kRaw, std::bit_cast<uint64_t>(x)}};
}

Whole SplitDecimal(const ExactStep& step, double x) {
  int64_t number = 0;
  for (int32_t decimals = step.exponent; decimals <= ExactStep::kMostDecimals; ++decimals) {
    if (!FindDecimal(x, step.is_float, decimals, &number)) continue;
    const auto digits = static_cast<uint32_t>(decimals - step.exponent);
    if (digits > step.MostDigits(0)) break;
    const int64_t power = Power(10, digits), whole = FloorDivide(number, power);
    if (digits > step.MostDigits(whole)) break;
    return {whole, {digits, static_cast<uint64_t>(number - whole * power)}};
  }
  return Raw(step, x);
}

Whole SplitBinary(const ExactStep& step, double x) {
  if (x == 0) return {0, {}};
  const BinaryNumber binary = BinaryNumberOf(x);
  const int32_t digits = binary.bits - step.exponent;
  if (digits <= 0) {
    const double whole = step.Scaled(x);
    if (std::fabs(whole) < static_cast<double>(kLargestNumber)) {
      return {static_cast<int64_t>(whole), {}};
    }
  } else if (static_cast<uint32_t>(digits) <= step.MostDigits(0)) {
    const int64_t whole = binary.number >> digits;
    if (static_cast<uint32_t>(digits) <= step.MostDigits(whole)) {
      return {whole,
              {static_cast<uint32_t>(digits),
               static_cast<uint64_t>(binary.number - whole * (int64_t{1} << digits))}};
    }
  }
  return Raw(step, x);
}

Whole SplitTame(const ExactStep& step, double x) {
  return step.radix == 2 ? SplitBinary(step, x) : SplitDecimal(step, x);
}

}  // namespace

double ExactStep::Unit() const { return Quotient(1, 0); }

double ExactStep::Scaled(double x) const {
  return radix == 2 ? std::ldexp(x, exponent) : x * PowerOfTen(exponent);
}

double ExactStep::Quotient(int64_t number, uint32_t digits) const {
  const int32_t places = exponent + static_cast<int32_t>(digits);
  // Both are rounded once at most: the power is exact.
  if (radix == 2) return std::ldexp(static_cast<double>(number), -places);
  return static_cast<double>(number) / PowerOfTen(places);
}

double ExactStep::Value(int64_t number, uint32_t digits) const {
  return RoundedTo(is_float, Quotient(number, digits));
}

uint32_t ExactStep::MostDigits(int64_t whole) const {
  const uint64_t above = Size(whole) + 1;
  const auto limit = static_cast<uint64_t>(kLargestNumber);
  if (radix == 2) {
    const auto bits = static_cast<int32_t>(std::bit_width(limit / above)) - 1;
    return static_cast<uint32_t>(std::clamp(bits, 0, kMostBits - exponent));
  }
  uint32_t digits = 0;
  uint64_t power = 10;
  while (static_cast<int32_t>(digits) < kMostDecimals - exponent && power <= limit / above) {
    ++digits;
    power *= 10;
  }
  return digits;
}

uint32_t ExactStep::SizeOf(int64_t whole) const {
  uint64_t size = Size(whole);
  if (radix == 2) return static_cast<uint32_t>(std::bit_width(size));
  uint32_t digits = 0;
  for (; size > 0; size /= 10) ++digits;
  return digits;
}

bool IsTame(double x) { return std::fabs(x) <= ExactStep::kLargest; }

bool IsNegativeZero(double x) { return x == 0 && std::signbit(x); }

int32_t DecimalsOf(double x, bool is_float) {
  int64_t number = 0;
  int32_t decimals = 0;
  while (decimals <= ExactStep::kMostDecimals && !FindDecimal(x, is_float, decimals, &number)) {
    ++decimals;
  }
  return decimals;
}

int32_t FractionBitsOf(double x) { return BinaryNumberOf(x).bits; }

int64_t WholeOf(const ExactStep& step, double x) { return SplitTame(step, x).number; }

ExactLattice::Coordinate ExactLattice::Split(size_t axis, int32_t extent, double x) const {
  const CoordinateRest raw{CoordinateRest::kRaw, std::bit_cast<uint64_t>(x)};
  if (!IsTame(x)) return {extent / 2, raw};
  const Whole whole = SplitTame(step, x);
  const int64_t k = whole.number - first[axis];
  const int64_t inside = std::clamp<int64_t>(k, 0, extent);
  return {static_cast<int32_t>(inside), inside != k || IsNegativeZero(x) ? raw : whole.rest};
}

double ExactLattice::Join(size_t axis, int32_t k, const CoordinateRest& rest) const {
  if (rest.digits == CoordinateRest::kRaw) return std::bit_cast<double>(rest.value);
  const int64_t number =
      (first[axis] + k) * Power(step.radix, rest.digits) + static_cast<int64_t>(rest.value);
  return step.Value(number, rest.digits);
}

}  // namespace folprom
