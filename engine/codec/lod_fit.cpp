#include "engine/codec/lod_fit.h"

#include <cmath>

#include "engine/connectivity/area_normal.h"
#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

/// Heights over the neighbours, per mean distance to them, at which a surface is bent more.
constexpr std::array<double, kBends - 1> kBendLimits{0.05, 0.1, 0.2};

}  // namespace

std::optional<FitMove> FitMoveOf(const SubtreeLod& lod, uint32_t set) {
  const Complex& complex = lod.complex;
  const auto spokes = complex.Spokes(set);
  // Where other subtrees or nothing go on, the neighbours here are one side of a ring.
  const SetRecord& record = lod.sets[set];
  if (record.is_leaf || record.border != kNone || spokes.size() < 3) return std::nullopt;
  if (complex.Corners(set).size() != spokes.size()) return std::nullopt;
  Vector3 sum{0, 0, 0};
  double distance = 0, open = 1;
  for (const auto& spoke : spokes) {
    const Vector3 d = Difference(lod.positions[set], lod.positions[spoke.target]);
    for (size_t i = 0; i < 3; ++i) sum[i] = sum[i] + d[i];
    distance = distance + std::sqrt(Dot(d, d));
    if (!lod.sets[spoke.target].is_leaf) open = open + 1;
  }
  const Vector3 normal = AreaNormal(complex, lod.positions, set);
  const double square = Dot(normal, normal);
  if (!(square > 0)) return std::nullopt;
  const auto count = static_cast<double>(spokes.size());
  const double scaled_height = Dot(sum, normal) / count;  // times the length of the normal
  FitMove move;
  move.set = set;
  const double bend = std::fabs(scaled_height) / std::sqrt(square) * count / distance;
  while (move.bend + 1 < kBends && bend >= kBendLimits[move.bend]) ++move.bend;
  // Where neighbours are vertices of the mesh for good, the surface is nearly there.
  const double factor = scaled_height / square * open / (count + 1);
  for (size_t i = 0; i < 3; ++i) move.shift[i] = factor * normal[i];
  return move;
}

template <class Coder>
void LodFit::Code(Coder& coder, const FitShares& chosen) {
  for (uint32_t bend = 0; bend < kBends; ++bend) {
    if (same_.Code(coder, {bend}, 0, chosen[bend] == shares_[bend])) continue;
    uint32_t share = 0;
    for (uint32_t bit = 0; bit < 3; ++bit) {
      share |= static_cast<uint32_t>(coder.Code(32768, (chosen[bend] >> bit & 1) != 0)) << bit;
    }
    shares_[bend] = share;
  }
}

Vector3 LodFit::ShiftOf(const FitMove& move, double longest) const {
  double share = kShareStep * static_cast<double>(shares_[move.bend]);
  const double length = share * std::sqrt(Dot(move.shift, move.shift));
  if (length > longest) share = share * (longest / length);
  return {share * move.shift[0], share * move.shift[1], share * move.shift[2]};
}

template void LodFit::Code<BitEncoder>(BitEncoder&, const FitShares&);
template void LodFit::Code<BitDecoder>(BitDecoder&, const FitShares&);

}  // namespace folprom
