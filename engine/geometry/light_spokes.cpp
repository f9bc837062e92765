#include "engine/geometry/light_spokes.h"

#include <algorithm>
#include <cmath>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

/// Cells by which the middle of a cell on a spoke may lie beside that of the way, on either axis.
constexpr double kReach = 0.75;

}  // namespace

LightSpokes::LightSpokes() : share_(65536 / 6) {
  later_.fill(kEvenState);
  for (auto* table : {&beside_, &above_}) {
    for (auto& states : *table) states.fill(kEvenState);
  }
}

bool LightSpokes::Asks(uint32_t neighbours) {
  constexpr uint32_t kRare = 65536 / 64, kAsks = 8;
  if (neighbours == 0) return false;
  return share_ >= kRare || ++skipped_ % kAsks == 0;
}

void LightSpokes::Learn(bool on_spoke) {
  constexpr uint32_t kRate = 6;
  share_ = on_spoke ? share_ + ((65535 - share_) >> kRate) : share_ - (share_ >> kRate);
}

double LightSpokes::PlaceOn(const Vertex& vertex, uint32_t neighbour, uint32_t axis) {
  const double way = vertex.ring.spokes[neighbour].way()[axis];
  const double unit = static_cast<double>(uint64_t{1} << vertex.shifts[axis]);
  return (static_cast<double>(At(vertex.old, axis)) + 0.5 + way / 2) / unit;
}

bool LightSpokes::IsAt(const Vertex& vertex, uint32_t neighbour,
                       const std::array<int32_t, 3>& cells) {
  for (uint32_t step = 0; step < 2; ++step) {
    const uint32_t axis = vertex.ring.axes[step];
    const double centre = static_cast<double>(cells[axis]) + 0.5;
    if (!(std::fabs(centre - PlaceOn(vertex, neighbour, axis)) <= kReach)) return false;
  }
  return true;
}

bool LightSpokes::Finds(const Vertex& vertex, const std::array<int32_t, 3>& cells) const {
  const uint32_t count = std::min(vertex.ring.count, kMostNeighbours);
  for (uint32_t n = 0; n < count; ++n) {
    if (IsAt(vertex, n, cells)) return true;
  }
  return false;
}

template <class Coder>
int64_t LightSpokes::CodeBeside(Coder& coder, uint32_t step, double place, int32_t truth) {
  const auto middle = static_cast<int64_t>(std::floor(place));
  const double behind = place - static_cast<double>(middle);
  const auto part = static_cast<uint32_t>(behind * kParts);
  if (!CodePlain(coder, &beside_[step][part], truth != middle)) return middle;
  // Along the surface the cell on the other side is too far off.
  bool above = behind > 0.5;
  if (step == 2) above = CodePlain(coder, &above_[step][part], truth > middle);
  return middle + (above ? 1 : -1);
}

template <class Coder>
bool LightSpokes::Code(Coder& coder, const Vertex& vertex, const std::array<int32_t, 3>& truth,
                       std::array<int32_t, 3>* cells) {
  const uint32_t count = std::min(vertex.ring.count, kMostNeighbours);
  std::array<Middle, kMostNeighbours> order{};
  for (uint32_t n = 0; n < count; ++n) {
    const Vector3 way = vertex.ring.spokes[n].way();
    double distance2 = 0;
    for (size_t i = 0; i < 3; ++i) {
      const double off = way[i] / 2 - vertex.expected[i];
      distance2 = distance2 + off * off;
    }
    order[n] = {n, distance2};
  }
  std::sort(order.begin(), order.begin() + count, [](const Middle& a, const Middle& b) {
    return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.neighbour < b.neighbour;
  });
  uint32_t rank = 0;
  while (rank + 1 < count) {
    bool later = false;
    if constexpr (Coder::kEncoding) later = !IsAt(vertex, order[rank].neighbour, truth);
    if (!CodePlain(coder, &later_[rank], later)) break;
    ++rank;
  }
  std::array<double, 3> place;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    place[axis] = PlaceOn(vertex, order[rank].neighbour, axis);
  }
  const uint32_t across = vertex.ring.axes[2];
  const double off = static_cast<double>(truth[across]) - std::floor(place[across]);
  for (uint32_t step = 0; step < 3; ++step) {
    const uint32_t axis = vertex.ring.axes[step];
    if (step == 2 && !CodePlain(coder, &straight_, std::fabs(off) <= 1)) return false;
    const int64_t cell = CodeBeside(coder, step, place[axis], truth[axis]);
    (*cells)[axis] =
        static_cast<int32_t>(std::clamp<int64_t>(cell, vertex.lo[axis], vertex.hi[axis]));
  }
  return true;
}

#define FOLPROM_INSTANTIATE(Coder)                                                             \
  template bool LightSpokes::Code<Coder>(Coder&, const Vertex&, const std::array<int32_t, 3>&, \
                                         std::array<int32_t, 3>*);
FOLPROM_INSTANTIATE(BitEncoder)
FOLPROM_INSTANTIATE(BitDecoder)
FOLPROM_INSTANTIATE(TrialCoder)
#undef FOLPROM_INSTANTIATE

}  // namespace folprom
