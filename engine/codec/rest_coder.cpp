#include "engine/codec/rest_coder.h"

#include <algorithm>
#include <bit>

#include "engine/entropy/bit_coder.h"
#include "folprom/float_bits.h"

namespace folprom {
namespace {

constexpr uint32_t kSizes = 64;  ///< of a number below 2^54, in either radix
constexpr uint32_t kContexts = 3 * kSizes;
/// A decimal is three nodes and a leaf of a binary tree; it is the first, second, later or last.
constexpr uint32_t kDecimalNodes = 16, kDecimalPlaces = 4;

}  // namespace

RestCoder::RestCoder(const ExactLattice& lattice)
    : lattice_(lattice),
      usual_(kContexts, 0),
      beyond_({kContexts}),
      raw_({kContexts}),
      more_({3}),
      fewer_({kContexts}),
      decimal_({kDecimalPlaces * kDecimalNodes}) {}

template <class Coder>
std::vector<ExactPosition> RestCoder::Code(Coder& coder, std::span<const Int3> positions,
                                           const RestTruth* truth) {
  std::vector<ExactPosition> exact(positions.size());
  for (uint32_t vertex = 0; vertex < positions.size(); ++vertex) {
    const int32_t k[3] = {positions[vertex].x, positions[vertex].y, positions[vertex].z};
    for (size_t axis = 0; axis < 3; ++axis) {
      CoordinateRest rest;
      if constexpr (Coder::kEncoding) rest = truth->Rest(vertex, axis);
      rest = CodeRest(coder, axis, lattice_.first[axis] + k[axis], rest);
      exact[vertex][axis] = lattice_.Join(axis, k[axis], rest);
    }
  }
  return exact;
}

template <class Coder>
CoordinateRest RestCoder::CodeRest(Coder& coder, size_t axis, int64_t whole,
                                   const CoordinateRest& truth) {
  const auto context = static_cast<uint32_t>(axis) * kSizes + lattice_.step.SizeOf(whole);
  const uint32_t most = lattice_.step.MostDigits(whole);
  const uint32_t usual = std::min(usual_[context], most);
  CoordinateRest rest;
  // kRaw is more than any number of digits.
  if (beyond_.Code(coder, {context}, 0, truth.digits > usual)) {
    if (usual == most || raw_.Code(coder, {context}, 0, truth.digits == CoordinateRest::kRaw)) {
      return {CoordinateRest::kRaw, CodeRaw(coder, truth.value)};
    }
    const uint32_t more =
        more_.CodeUnsigned(coder, {static_cast<uint32_t>(axis)}, truth.digits - usual - 1);
    if (more >= most - usual) throw Failure(ErrorKind::kCorrupt, "coded rest has too many digits");
    rest.digits = usual + 1 + more;
    usual_[context] = rest.digits;
  } else if (usual > 0) {
    const uint32_t fewer = fewer_.CodeUnsigned(coder, {context}, usual - truth.digits);
    if (fewer > usual) throw Failure(ErrorKind::kCorrupt, "coded rest has less than no digits");
    rest.digits = usual - fewer;
  }
  rest.value = CodeDigits(coder, rest.digits, truth.value);
  return rest;
}

template <class Coder>
uint64_t RestCoder::CodeRaw(Coder& coder, uint64_t bits) {
  const bool is_float = lattice_.step.is_float;
  const uint64_t known = is_float ? NarrowToFloatBits(std::bit_cast<double>(bits)) : bits;
  uint64_t coded = 0;
  for (int bit = is_float ? 31 : 63; bit >= 0; --bit) {
    coded = coded << 1 | static_cast<uint64_t>(coder.Code(32768, (known >> bit & 1) != 0));
  }
  if (!is_float) return coded;
  const auto value = std::bit_cast<float>(static_cast<uint32_t>(coded));
  return std::bit_cast<uint64_t>(WidenFloat(value));
}

template <class Coder>
uint64_t RestCoder::CodeDigits(Coder& coder, uint32_t digits, uint64_t value) {
  if (digits == 0) return 0;
  uint64_t coded = 0;
  if (lattice_.step.radix == 2) {
    for (uint32_t bit = digits - 1; bit > 0; --bit) {
      coded = coded << 1 | static_cast<uint64_t>(coder.Code(32768, (value >> bit & 1) != 0));
    }
    return coded << 1 | 1;  // the last bit is 1, or there would be fewer
  }
  uint64_t power = 1;
  for (uint32_t i = 1; i < digits; ++i) power *= 10;
  for (uint32_t place = 0; place < digits; ++place, power /= 10) {
    const uint64_t digit = value / power % 10;
    const uint32_t kind = place + 1 == digits ? kDecimalPlaces - 1 : std::min(place, 2u);
    uint32_t node = 1;
    for (int bit = 3; bit >= 0; --bit) {
      const bool upper =
          decimal_.Code(coder, {kind * kDecimalNodes + node}, 0, (digit >> bit & 1) != 0);
      node = node << 1 | static_cast<uint32_t>(upper);
    }
    if (node - kDecimalNodes > 9) throw Failure(ErrorKind::kCorrupt, "coded digit is above 9");
    coded = coded * 10 + (node - kDecimalNodes);
  }
  return coded;
}

template std::vector<ExactPosition> RestCoder::Code<BitEncoder>(BitEncoder&, std::span<const Int3>,
                                                                const RestTruth*);
template std::vector<ExactPosition> RestCoder::Code<BitDecoder>(BitDecoder&, std::span<const Int3>,
                                                                const RestTruth*);

}  // namespace folprom
