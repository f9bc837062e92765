#include "engine/codec/plane_coder.h"

#include <array>
#include <bit>
#include <utility>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

/// Is it shorter to tell by how much each gap differs from the one before, as where planes are
/// evenly spaced.
bool AreEvenlySpaced(std::span<const int32_t> planes) {
  int64_t gain = 0, before = 0;
  for (size_t i = 1; i < planes.size(); ++i) {
    const int64_t gap = int64_t{planes[i]} - planes[i - 1], change = gap - before;
    gain += std::bit_width(static_cast<uint64_t>(gap));
    gain -= std::bit_width(static_cast<uint64_t>(change < 0 ? -2 * change : 2 * change));
    before = gap;
  }
  return gain > 0;
}

}  // namespace

template <class Coder>
std::vector<int32_t> PlaneCoder::CodeAxis(Coder& coder, int32_t lo, int32_t hi,
                                          std::span<const int32_t> planes) {
  const uint32_t count = counts_.CodeUnsigned(coder, {0}, static_cast<uint32_t>(planes.size()));
  if (count > kMostPlanes) throw Failure(ErrorKind::kCorrupt, "coded planes are too many");
  std::vector<int32_t> coded;
  if (count == 0) return coded;
  const bool evenly = coder.Code(32768, Coder::kEncoding && AreEvenlySpaced(planes));
  int64_t at = lo, gap = 0;
  for (uint32_t i = 0; i < count; ++i) {
    int64_t truth = 0;
    if constexpr (Coder::kEncoding) truth = planes[i] - at;
    if (evenly && i > 0) {
      gap += changes_.CodeSigned(coder, {0}, static_cast<int32_t>(truth - gap));
    } else {
      gap = gaps_.CodeUnsigned(coder, {0}, static_cast<uint32_t>(truth));
    }
    at += gap;
    if (at > hi || (i > 0 && gap <= 0)) {
      throw Failure(ErrorKind::kCorrupt, "a coded plane lies outside its box");
    }
    coded.push_back(static_cast<int32_t>(at));
    if (i == 0) gap = 0;  // that was no gap
  }
  return coded;
}

template <class Coder>
std::shared_ptr<const CoordinatePlanes> PlaneCoder::Code(
    Coder& coder, std::shared_ptr<const CoordinatePlanes> found) {
  if (!coder.Code(32768, Coder::kEncoding && found != nullptr)) return nullptr;
  std::array<std::vector<int32_t>, 3> values;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    std::span<const int32_t> planes;
    if constexpr (Coder::kEncoding) planes = found->On(axis);
    values[axis] = CodeAxis(coder, At(lo_, axis), At(hi_, axis), planes);
  }
  return std::make_shared<CoordinatePlanes>(std::move(values));
}

template std::shared_ptr<const CoordinatePlanes> PlaneCoder::Code<BitEncoder>(
    BitEncoder&, std::shared_ptr<const CoordinatePlanes>);
template std::shared_ptr<const CoordinatePlanes> PlaneCoder::Code<BitDecoder>(
    BitDecoder&, std::shared_ptr<const CoordinatePlanes>);

}  // namespace folprom
