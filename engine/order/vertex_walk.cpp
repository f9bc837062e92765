#include "engine/order/vertex_walk.h"

#include <algorithm>
#include <array>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

constexpr uint32_t kHistories = 256;  // what the last eight were
constexpr uint32_t kManyClasses = 4;  // of the number of vertices found
constexpr uint32_t kPlaces = 6;       // by distance, or in the order found; the last: all further
constexpr uint32_t kDistances = 8;    // in steps of the walk
constexpr size_t kMostFound = 24;     // vertices
constexpr uint32_t kMostFaces = 32;   // of a vertex that are looked at
constexpr uint32_t kMostCoincident = 6;  // to each side

double SquaredDistance(const Int3& p, const std::array<double, 3>& q) {
  const double x = p.x - q[0], y = p.y - q[1], z = p.z - q[2];
  return x * x + y * y + z * z;
}

uint32_t ManyClass(size_t found) { return found < 2 ? 0 : (found < 4 ? 1 : (found < 8 ? 2 : 3)); }

/// In eighths of a squared step, by squares.
uint32_t DistanceClass(double distance, double step) {
  uint32_t result = 0;
  while (result + 1 < kDistances && distance > step * (result + 1) * (result + 1) / 8) ++result;
  return result;
}

}  // namespace

VertexWalk::VertexWalk(const OrderMesh& mesh, const Sweep& sweep, std::span<uint32_t> sequence,
                       std::span<uint32_t> place_of)
    : mesh_(mesh),
      sequence_(sequence),
      place_of_(place_of),
      remaining_(mesh.vertex_count(), sweep),
      near_({kHistories * kManyClasses, kReasons}),
      choice_({kReasons * kPlaces, kReasons * kReasons, kPlaces * kPlaces * kDistances,
               kReasons * kDistances, kReasons * 16}) {
  std::ranges::fill(place_of_, kNoNumber);
}

void VertexWalk::Add(uint32_t vertex, uint32_t reason) {
  if (place_of_[vertex] != kNoNumber) return;
  const auto found = std::ranges::find(found_, vertex, &Found::vertex);
  if (found != found_.end()) {
    found->reasons |= reason;
  } else if (found_.size() < kMostFound) {
    found_.push_back({vertex, reason, 0});
  }
}

void VertexWalk::AddNeighbours(uint32_t vertex, uint32_t reason) {
  for (const uint32_t f : mesh_.Star(vertex, kMostFaces)) {
    for (const uint32_t corner : mesh_.faces[f]) Add(corner, reason);
  }
}

void VertexWalk::AddCoincident(uint32_t vertex) {
  // Such vertices follow each other.
  const Int3& p = mesh_.positions[vertex];
  for (uint32_t v = vertex; v-- > 0 && vertex - v <= kMostCoincident && mesh_.positions[v] == p;) {
    Add(v, kCoincident);
  }
  for (uint32_t v = vertex + 1;
       v < mesh_.vertex_count() && v - vertex <= kMostCoincident && mesh_.positions[v] == p; ++v) {
    Add(v, kCoincident);
  }
}

uint32_t VertexWalk::FirstNeighbour(uint32_t vertex) const {
  uint32_t first = kNoNumber;
  for (const uint32_t f : mesh_.Star(vertex, kMostFaces)) {
    for (const uint32_t corner : mesh_.faces[f]) {
      if (corner != vertex) first = std::min(first, place_of_[corner]);
    }
  }
  return first;
}

bool VertexWalk::HasNeighboursLeft(uint32_t vertex) const {
  for (const uint32_t f : mesh_.Star(vertex, kMostFaces)) {
    for (const uint32_t corner : mesh_.faces[f]) {
      if (place_of_[corner] == kNoNumber) return true;
    }
  }
  return false;
}

void VertexWalk::Collect() {
  found_.clear();
  if (next_ == 0) return;
  const std::array<uint32_t, 3> last = {Before(1), Before(2), Before(3)};
  constexpr std::array<uint32_t, 3> kReason = {kOfLast, kOfSecond, kOfThird};
  for (size_t i = 0; i < 3; ++i) {
    if (last[i] != kNoNumber) AddNeighbours(last[i], kReason[i]);
  }
  for (const uint32_t vertex : last) {
    if (vertex != kNoNumber) AddCoincident(vertex);
  }
  const uint32_t row = FirstNeighbour(last[0]);
  if (row != kNoNumber && row + 1 < next_) {
    AddNeighbours(sequence_[row], kOfRow);
    AddNeighbours(sequence_[row + 1], kOfNextInRow);
  }
  while (front_ < next_ && !HasNeighboursLeft(sequence_[front_])) ++front_;
  if (front_ < next_) AddNeighbours(sequence_[front_], kOfFront);
}

template <class Coder>
uint32_t VertexWalk::CodeNear(Coder& coder, uint32_t vertex) {
  const Int3& a = mesh_.positions[Before(1)];
  const Int3& b = mesh_.positions[Before(next_ > 1 ? 2 : 1)];
  // From the last vertex as far on as it lies from the one before.
  const std::array<double, 3> ahead = {2.0 * a.x - b.x, 2.0 * a.y - b.y, 2.0 * a.z - b.z};
  const double step = SquaredDistance(a, ahead);
  for (Found& found : found_) {
    found.distance = SquaredDistance(mesh_.positions[found.vertex], ahead);
  }
  options_.clear();
  for (uint32_t i = 0; i < found_.size(); ++i) {
    const auto& [number, reasons, distance] = found_[i];
    const auto count = std::ranges::count_if(
        found_, [d = distance](const Found& other) { return other.distance < d; });
    const uint32_t nearer = std::min(static_cast<uint32_t>(count), kPlaces - 1);
    const uint32_t far = DistanceClass(distance, step);
    options_.push_back({number,
                        {reasons * kPlaces + nearer, reasons * kReasons + last_reasons_,
                         (std::min(i, kPlaces - 1) * kPlaces + nearer) * kDistances + far,
                         reasons * kDistances + far, reasons * 16 + (history_ & 15)}});
  }
  return choice_.Code(coder, std::span(options_), vertex);
}

template <class Coder>
void VertexWalk::Code(Coder& coder, uint32_t count) {
  for (; count > 0; --count) {
    uint32_t vertex = Coder::kEncoding ? sequence_[next_] : 0;
    Collect();
    bool is_near = false;
    if (!found_.empty()) {
      is_near = Coder::kEncoding && std::ranges::count(found_, vertex, &Found::vertex) > 0;
      const uint32_t past = history_ * kManyClasses + ManyClass(found_.size());
      is_near = near_.Code(coder, {past, last_reasons_}, 0, is_near);
    }
    if (is_near) {
      vertex = CodeNear(coder, vertex);
      last_reasons_ = std::ranges::find(found_, vertex, &Found::vertex)->reasons;
    } else {
      vertex = remaining_.Code(coder, next_ == 0 ? 0 : Before(1), vertex);
      last_reasons_ = 0;
    }
    history_ = (history_ << 1 | (is_near ? 1 : 0)) % kHistories;
    remaining_.Remove(vertex);
    place_of_[vertex] = next_;
    sequence_[next_++] = vertex;
  }
}

template void VertexWalk::Code(BitEncoder&, uint32_t);
template void VertexWalk::Code(BitDecoder&, uint32_t);

}  // namespace folprom
