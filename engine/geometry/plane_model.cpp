#include "engine/geometry/plane_model.h"

namespace folprom {
namespace {

/// Planes are told apart where they are so many cells from each other.
constexpr int64_t kLeastGap = 2;

uint32_t Octave(int64_t ratio, uint32_t most) {
  uint32_t octave = 0;
  while (ratio > 1 && octave < most) ratio >>= 1, ++octave;
  return octave;
}

}  // namespace

PlaneModel::PlaneModel() : weights_(kContexts, LearnedScale{0, 0}) {}

int64_t PlaneModel::GapAt(uint32_t axis, int64_t coordinate) const {
  const std::span<const int32_t> on = planes_->On(axis);
  if (on.size() < 2) return int64_t{1} << 31;
  const size_t i = std::clamp<size_t>(planes_->Below(axis, coordinate), 1, on.size() - 1);
  return int64_t{on[i]} - on[i - 1];
}

PlaneModel::Place PlaneModel::PlaceOf(uint32_t axis, uint32_t shift, int32_t cell) const {
  const int64_t begin = int64_t{cell} << shift, size = int64_t{1} << shift;
  if (planes_->On(axis).empty() || GapAt(axis, begin) < kLeastGap * size) return kUnknown;
  return planes_->Any(axis, begin, begin + size) ? kOn : kOff;
}

bool PlaneModel::Collect(const Coordinate& coordinate, PlaneWindow* window) const {
  constexpr size_t kSide = PlaneWindow::kMost / 2;
  const std::span<const int32_t> on = planes_->On(coordinate.axis);
  if (on.empty()) return false;
  const int64_t lo = coordinate.lo, hi = coordinate.hi;
  const double near = std::clamp(coordinate.near, static_cast<double>(lo), static_cast<double>(hi));
  const uint32_t shift = coordinate.shift;
  const size_t middle = planes_->Below(coordinate.axis, static_cast<int64_t>(near) << shift);
  const size_t begin = middle > kSide ? middle - kSide : 0;
  const size_t end = std::min(on.size(), middle + kSide);
  window->count = 0;
  window->first = lo;
  window->last = hi + 1;
  // Those next to the window end it.
  const size_t last = std::min(on.size(), end + 1);
  for (size_t i = begin > 0 ? begin - 1 : 0; i < last; ++i) {
    const int64_t cell = on[i] >> shift;
    if (i + 1 < last && (on[i + 1] >> shift) - cell < kLeastGap) return false;
    if (i < begin) {
      window->first = cell + 1;
    } else if (i < end) {
      window->cell[window->count++] = cell;
    } else {
      window->last = cell;
    }
  }
  return true;
}

void PlaneModel::Learn(int32_t cell) {
  if (planes_ == nullptr) return;
  constexpr double kMostSeen = 200, kMost = 9;
  const Place place = PlaceOf(axis_, shift_, cell);
  if (weight_ != nullptr && place != kUnknown) {
    const double miss = (place == kOn ? 1 : 0) - on_plane_;
    weight_->count = std::min(weight_->count + 1, kMostSeen);
    weight_->mean = std::clamp(weight_->mean + miss * 8 / (weight_->count + 4), -kMost, kMost);
  }
  known_ = known_ * kPlaces + place;
  ++step_;
}

PlaneModel::HalfSigns PlaneModel::SignsOf(uint32_t axis, const std::array<int32_t, 3>& cells,
                                          const std::array<uint8_t, 3>& shifts) const {
  if (planes_ == nullptr) return {};
  const uint32_t shift = shifts[axis];
  const int64_t begin = int64_t{cells[axis]} << shift, half = int64_t{1} << (shift - 1);
  const bool lower = planes_->Any(axis, begin, begin + half);
  const bool upper = planes_->Any(axis, begin + half, begin + 2 * half);
  HalfSigns signs;
  signs.tells = lower != upper;
  if (!signs.tells) return signs;
  uint32_t on = 0, off = 0;
  for (uint32_t other : {(axis + 1) % 3, (axis + 2) % 3}) {
    const Place place = PlaceOf(other, shifts[other], cells[other]);
    on += place == kOn ? 1 : 0;
    off += place == kOff ? 1 : 0;
  }
  const uint32_t side = upper ? 1 : 0, size = Octave(GapAt(axis, begin) >> shift, 15);
  signs.contexts = {((side * 16 + size) * 3 + on) * 3 + off, side * 32 + std::min(shift, 31u)};
  return signs;
}

}  // namespace folprom
