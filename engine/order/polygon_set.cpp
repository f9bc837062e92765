#include "engine/order/polygon_set.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "engine/entropy/bit_coder.h"
#include "engine/entropy/even_code.h"

namespace folprom {
namespace {

constexpr uint32_t kMostFaces = 1024;  // of a vertex that are looked at
constexpr size_t kMostMates = 16;      // across an edge
constexpr size_t kMostCorners = 4096;  // of a polygon that is grown
constexpr uint32_t kSizes = 12, kLastSizes = 8, kEdges = 4, kRanks = 4, kDirections = 27;

uint32_t SizeClass(size_t size, uint32_t classes) {
  return static_cast<uint32_t>(std::min<size_t>(size - 3, classes - 1));
}

double SquaredDistance(const Int3& a, const Int3& b) {
  const double x = static_cast<double>(a.x) - b.x, y = static_cast<double>(a.y) - b.y,
               z = static_cast<double>(a.z) - b.z;
  return x * x + y * y + z * z;
}

/// Are the corners those of the fan, beginning anywhere.
bool IsSameCycle(std::span<const uint32_t> corners, std::span<const uint32_t> fan) {
  if (corners.size() != fan.size()) return false;
  for (size_t turn = 0; turn < fan.size(); ++turn) {
    size_t i = 0;
    while (i < fan.size() && corners[i] == fan[(turn + i) % fan.size()]) ++i;
    if (i == fan.size()) return true;
  }
  return false;
}

std::vector<uint32_t> CornersOf(const PolygonTruth& truth, const PolygonTruth::Fan& fan) {
  const Face& first = truth.face(fan.first);
  std::vector<uint32_t> corners(first.begin(), first.end());
  for (uint32_t t = fan.first + 1; t <= fan.last; ++t) corners.push_back(truth.face(t)[2]);
  return corners;
}

}  // namespace

PolygonTruth::PolygonTruth(const OrderMesh& mesh, std::span<const Face> faces,
                           std::span<const uint8_t> joins, WorkSpace& space)
    : faces_(faces),
      joins_(joins),
      number_of_(space.Words(faces.size())),
      triangle_of_(space.Words(faces.size())) {
  UnusedSet left(mesh.face_count());
  for (uint32_t t = 0; t < faces.size(); ++t) {
    const uint32_t number = left.Select(left.Rank(mesh.NumberOf(faces[t])));
    left.Remove(number);
    number_of_[t] = number;
    triangle_of_[number] = t;
    space.Stepped(1);
  }
}

PolygonTruth::Fan PolygonTruth::FanOf(uint32_t number) const {
  Fan fan{triangle_of_[number], triangle_of_[number]};
  while (joins_[fan.first] != 0) --fan.first;
  while (fan.last + 1 < faces_.size() && joins_[fan.last + 1] != 0) ++fan.last;
  return fan;
}

void PolygonTruth::Assign(uint32_t triangle, uint32_t number) {
  const uint32_t other = triangle_of_[number];
  number_of_[other] = number_of_[triangle];
  triangle_of_[number_of_[triangle]] = other;
  number_of_[triangle] = number;
  triangle_of_[number] = triangle;
}

PolygonSet::PolygonSet(const OrderMesh& mesh, PolygonTruth* truth, WorkSpace& space)
    : mesh_(mesh),
      truth_(truth),
      space_(space),
      left_(mesh.face_count()),
      is_listed_({1}),
      is_joined_({kSizes * kLastSizes * kEdges * kRanks, kSizes * kLastSizes * kDirections,
                  kSizes * kEdges * kLastSizes * kLastSizes}),
      is_mate_({kMostMates}),
      sizes_({1}) {}

uint32_t PolygonSet::FirstLeft(const Face& face) const {
  const uint32_t equal = mesh_.NumberOf(face);
  if (equal == mesh_.face_count()) return kNoNumber;
  const uint32_t rank = left_.Rank(equal);
  if (rank == left_.left()) return kNoNumber;
  const uint32_t number = left_.Select(rank);
  Face turned = face;
  TurnToSmallest(&turned);
  return mesh_.faces[number] == turned ? number : kNoNumber;
}

void PolygonSet::CollectMates(uint32_t from, uint32_t to) {
  mates_.clear();
  for (const uint32_t number : mesh_.Star(from, kMostFaces)) {
    if (!left_.Has(number)) continue;
    const Face& face = mesh_.faces[number];
    for (size_t i = 0; i < 3 && mates_.size() < kMostMates; ++i) {
      const uint32_t mate = face[(i + 2) % 3];
      if (face[i] != to || face[(i + 1) % 3] != from) continue;
      // Copies of triangles of the polygon are left, but maybe not for another one.
      if (std::ranges::count(mates_, mate) == 0) mates_.push_back(mate);
    }
  }
}

void PolygonSet::Take(const Face& face, uint32_t number) {
  members_.push_back(face);
  numbers_.push_back(number);
  left_.Remove(number);
}

template <class Decide>
void PolygonSet::Grow(uint32_t number, Decide decide) {
  const Face& first = mesh_.faces[number];
  corners_.assign(first.begin(), first.end());
  members_.clear();
  numbers_.clear();
  Take(first, number);
  for (size_t edge = 0; edge < corners_.size() && corners_.size() < kMostCorners;) {
    const uint32_t from = corners_[edge], to = corners_[(edge + 1) % corners_.size()];
    CollectMates(from, to);
    const uint32_t mate = mates_.empty() ? kNoNumber : decide(edge);
    if (mate == kNoNumber) {
      ++edge;
      continue;
    }
    corners_.insert(corners_.begin() + static_cast<std::ptrdiff_t>(edge) + 1, mate);
    const Face face = {to, from, mate};
    Take(face, FirstLeft(face));
  }
}

bool PolygonSet::PlanGrowth(uint32_t number) {
  const PolygonTruth::Fan fan = truth_->FanOf(number);
  const std::vector<uint32_t> wanted = CornersOf(*truth_, fan);
  plan_.clear();
  if (wanted.size() >= kMostCorners) return false;
  uint32_t first = truth_->TriangleOf(number), last = first;
  Grow(number, [&](size_t edge) {
    const uint32_t from = corners_[edge], to = corners_[(edge + 1) % corners_.size()];
    uint32_t mate = kNoNumber;
    if (last < fan.last && from == truth_->face(last)[2] && to == truth_->face(last)[0]) {
      mate = truth_->face(last + 1)[2];
    }
    if (mate != kNoNumber && std::ranges::count(mates_, mate) > 0) {
      ++last;
    } else if (first > fan.first && from == truth_->face(first)[0] &&
               to == truth_->face(first)[1] &&
               std::ranges::count(mates_, truth_->face(first - 1)[1]) > 0) {
      mate = truth_->face(--first)[1];
    } else {
      mate = kNoNumber;
    }
    plan_.push_back(mate);
    return mate;
  });
  for (const uint32_t taken : numbers_) left_.PutBack(taken);
  return IsSameCycle(corners_, wanted);
}

uint32_t PolygonSet::LengthRank(size_t edge) const {
  if (corners_.size() > 3) return kRanks - 1;
  std::array<double, 3> length;
  for (size_t i = 0; i < 3; ++i) {
    length[i] =
        SquaredDistance(mesh_.positions[corners_[i]], mesh_.positions[corners_[(i + 1) % 3]]);
  }
  return static_cast<uint32_t>(
      std::ranges::count_if(length, [&](double other) { return other > length[edge]; }));
}

/// Per axis whether the edge goes along it, and then which way; either way along the whole.
uint32_t PolygonSet::Direction(size_t edge) const {
  const Int3& from = mesh_.positions[corners_[edge]];
  const Int3& to = mesh_.positions[corners_[(edge + 1) % corners_.size()]];
  std::array<int64_t, 3> step;
  int64_t longest = 0, sign = 0;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    step[axis] = int64_t{At(to, axis)} - At(from, axis);
    longest = std::max(longest, std::abs(step[axis]));
  }
  uint32_t direction = 0;
  for (const int64_t along : step) {
    const bool is_along = 5 * std::abs(along) > 2 * longest;
    if (is_along && sign == 0) sign = along < 0 ? -1 : 1;
    direction = direction * 3 + (is_along ? (along * sign < 0 ? 2 : 1) : 0);
  }
  return direction;
}

template <class Coder>
uint32_t PolygonSet::CodeMate(Coder& coder, size_t edge, uint32_t mate) {
  const uint32_t size = SizeClass(corners_.size(), kSizes);
  const uint32_t at = static_cast<uint32_t>(std::min<size_t>(edge, kEdges - 1));
  const uint32_t last = SizeClass(last_size_, kLastSizes);
  const uint32_t before = SizeClass(size_before_, kLastSizes);
  const bool is_joined =
      is_joined_.Code(coder,
                      {((size * kLastSizes + last) * kEdges + at) * kRanks + LengthRank(edge),
                       (size * kLastSizes + last) * kDirections + Direction(edge),
                       ((size * kEdges + at) * kLastSizes + last) * kLastSizes + before},
                      0, mate != kNoNumber);
  if (!is_joined) return kNoNumber;
  for (uint32_t i = 0; i + 1 < mates_.size(); ++i) {
    if (is_mate_.Code(coder, {i}, 0, mates_[i] == mate)) return mates_[i];
  }
  return mates_.back();
}

template <class Coder>
void PolygonSet::CodeCorners(Coder& coder, const PolygonTruth::Fan& fan) {
  corners_.assign(3, 0);
  members_.clear();
  numbers_.clear();
  if constexpr (Coder::kEncoding) corners_ = CornersOf(*truth_, fan);
  const uint32_t triangles =
      sizes_.CodeUnsigned(coder, {0}, static_cast<uint32_t>(corners_.size()) - 3);
  if (triangles >= left_.left()) {
    throw Failure(ErrorKind::kCorrupt, "a coded polygon has more triangles than are left");
  }
  corners_.resize(size_t{triangles} + 3);
  for (uint32_t& corner : corners_) {
    corner = static_cast<uint32_t>(CodeEvenly(coder, mesh_.vertex_count() - 1, corner,
                                              "a coded polygon has a corner that is no vertex"));
  }
  for (size_t i = 2; i < corners_.size(); ++i) {
    const Face face = {corners_[0], corners_[i - 1], corners_[i]};
    const uint32_t found = FirstLeft(face);
    if (found == kNoNumber) {
      throw Failure(ErrorKind::kCorrupt, "a coded polygon has a triangle that is not there");
    }
    Take(face, found);
  }
}

/// The triangles of the scan take the numbers that have been taken for them.
void PolygonSet::Settle(const PolygonTruth::Fan& fan, bool is_listed) {
  for (uint32_t t = fan.first; t <= fan.last; ++t) {
    size_t i = t - fan.first;  // in their order where they are listed
    if (!is_listed) {
      Face face = truth_->face(t);
      TurnToSmallest(&face);
      i = 0;
      while (numbers_[i] == kNoNumber || mesh_.faces[numbers_[i]] != face) ++i;
    }
    truth_->Assign(t, numbers_[i]);
    numbers_[i] = kNoNumber;
  }
}

template <class Coder>
void PolygonSet::Code(Coder& coder, uint32_t most, std::vector<Face>* triangles,
                      std::vector<uint8_t>* joins, std::vector<PolygonTruth::Fan>* fans) {
  for (const size_t end = triangles->size() + most; !AtEnd() && triangles->size() < end;) {
    const uint32_t number = left_.Select(0);
    PolygonTruth::Fan fan{};
    bool is_listed = false;
    if constexpr (Coder::kEncoding) {
      fan = truth_->FanOf(number);
      is_listed = !PlanGrowth(number);
    }
    if (is_listed_.Code(coder, {0}, 0, is_listed)) {
      CodeCorners(coder, fan);
    } else {
      size_t next = 0;
      Grow(number, [&](size_t edge) {
        return CodeMate(coder, edge, Coder::kEncoding ? plan_[next++] : kNoNumber);
      });
    }
    if constexpr (Coder::kEncoding) Settle(fan, is_listed);
    if (fans != nullptr) fans->push_back(fan);
    size_before_ = last_size_;
    last_size_ = static_cast<uint32_t>(corners_.size());
    for (size_t i = 2; i < corners_.size(); ++i) {
      triangles->push_back({corners_[0], corners_[i - 1], corners_[i]});
      joins->push_back(i > 2 ? 1 : 0);
    }
    space_.Stepped(corners_.size());
  }
}

template void PolygonSet::Code(BitEncoder&, uint32_t, std::vector<Face>*, std::vector<uint8_t>*,
                               std::vector<PolygonTruth::Fan>*);
template void PolygonSet::Code(BitDecoder&, uint32_t, std::vector<Face>*, std::vector<uint8_t>*,
                               std::vector<PolygonTruth::Fan>*);

}  // namespace folprom
