#include "io/formats/text_number.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace folprom::io {
namespace {

std::string_view WithoutPlus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  return word;
}

template <class T>
bool Parse(std::string_view word, T* value) {
  const std::string_view digits = WithoutPlus(word);
  const char* end = digits.data() + digits.size();
  const auto result = fast_float::from_chars(digits.data(), end, *value);
  return result.ec != std::errc::invalid_argument && result.ptr == end;
}

/// The power of ten that the last digit of a decimal counts.
int64_t LastPlace(std::string_view word) {
  const size_t exponent_at = std::min(word.find_first_of("eE"), word.size());
  const size_t point = word.substr(0, exponent_at).find('.');
  int64_t place =
      point == std::string_view::npos ? 0 : -static_cast<int64_t>(exponent_at - point - 1);
  int64_t exponent = 0;
  if (exponent_at < word.size() && ParseInteger(word.substr(exponent_at + 1), &exponent)) {
    place += std::clamp<int64_t>(exponent, -10000, 10000);
  }
  return place;
}

/// x * 10^power, by products alone: the same on every machine.
double Scaled(double x, int64_t power) {
  constexpr double kStep = 1e16;
  for (; power >= 16 && std::isfinite(x); power -= 16) x *= kStep;
  for (; power <= -16 && x != 0; power += 16) x /= kStep;
  for (; power > 0; --power) x *= 10;
  for (; power < 0; ++power) x /= 10;
  return x;
}

}  // namespace

bool ParseInteger(std::string_view word, int64_t* value) {
  const std::string_view digits = WithoutPlus(word);
  const char* end = digits.data() + digits.size();
  const auto result = std::from_chars(digits.data(), end, *value);
  return result.ec == std::errc() && result.ptr == end;
}

bool ParseReal(std::string_view word, float* value) { return Parse(word, value); }
bool ParseReal(std::string_view word, double* value) { return Parse(word, value); }

bool IsFloat32Decimal(std::string_view word, double value) {
  const float nearest = static_cast<float>(value);
  const double difference = std::fabs(static_cast<double>(nearest) - value);
  if (!(difference > 0)) return true;  // equal, or no number
  if (std::isinf(nearest)) return false;
  // Half a unit of the last digit, and what the value itself was rounded by; the little more is for
  // the roundings of this sum.
  const double size = std::fabs(value);
  const double rounded = (std::nextafter(size, std::numeric_limits<double>::infinity()) - size) / 2;
  return Scaled(difference - rounded, -LastPlace(word)) <= 0.5 * (1 + 1e-9);
}

}  // namespace folprom::io
