#include "engine/order/face_walk.h"

#include <algorithm>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

constexpr uint32_t kHistories = 256;  // what the last eight were
constexpr uint32_t kManyClasses = 4;  // of the number of faces found
constexpr uint32_t kRelations = 8;    // of two faces
constexpr uint32_t kRanks = 4;        // among the faces found; the last: all further
constexpr size_t kMostFound = 32;     // faces
constexpr uint32_t kMostFaces = 24;   // of a vertex that are looked at

uint32_t CornerAt(const Face& face, uint32_t vertex) {
  return static_cast<uint32_t>(std::ranges::find(face, vertex) - face.begin());
}

uint32_t CommonCorners(const Face& a, const Face& b) {
  return static_cast<uint32_t>(
      std::ranges::count_if(a, [&](uint32_t vertex) { return CornerAt(b, vertex) < 3; }));
}

/// What a face has in common with the one before: nothing; a corner, which (1 .. 3); all but one,
/// which (4 .. 6); all.
uint32_t RelationTo(const Face& before, const Face& face) {
  uint32_t common = 0, sum = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    if (CornerAt(face, before[i]) == 3) continue;
    ++common;
    sum += i;
  }
  const std::array<uint32_t, 4> relation = {0, 1 + sum, 7 - sum, 7};
  return relation[common];
}

uint32_t ManyClass(size_t found) { return found < 3 ? 0 : (found < 6 ? 1 : (found < 12 ? 2 : 3)); }

/// Of the first corner among the three by place: 0, 1, 2.
uint32_t RankOfFirst(const Face& places) {
  return (places[1] < places[0] ? 1u : 0u) + (places[2] < places[0] ? 1u : 0u);
}

}  // namespace

FaceWalk::FaceWalk(const OrderMesh& mesh, const Sweep& sweep, std::span<uint32_t> sequence,
                   std::span<uint32_t> place_of, bool is_soup)
    : mesh_(mesh),
      sequence_(sequence),
      place_of_(place_of),
      placed_(is_soup ? 0 : mesh.vertex_count()),
      remaining_(mesh.face_count(), sweep),
      near_({kHistories * kManyClasses, kRelations * kRelations}),
      choice_({kRelations * kRelations * 4, kRelations * 4 * 2 * 3 * 4,
               kRanks * kRanks * kRelations, kRanks * kRanks * 2 * 3,
               kRelations * kRelations * kRelations, kRanks * kRanks * 3 * 4 * kRelations}),
      turns_({64 * 3, 6 * 3 * 4, 64 * 4, kRelations * 6 * 3}) {}

Face FaceWalk::PlacesOf(const Face& face) const {
  uint32_t next = placed_;
  Face places;
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t place = place_of_[face[i]];
    places[i] = place != kNoNumber ? place : next++;
  }
  return places;
}

void FaceWalk::GivePlaces(const Face& face) {
  for (const uint32_t vertex : face) {
    if (place_of_[vertex] != kNoNumber) continue;
    place_of_[vertex] = placed_;
    sequence_[placed_++] = vertex;
  }
}

void FaceWalk::Add(uint32_t face, uint32_t patterns) {
  if (!remaining_.Has(face)) return;
  const auto found = std::ranges::find(found_, face, &Found::face);
  if (found != found_.end()) {
    found->patterns |= patterns;
  } else if (found_.size() < kMostFound) {
    const Face places = PlacesOf(mesh_.faces[face]);
    found_.push_back({face, patterns, std::ranges::min(places), std::ranges::max(places)});
  }
}

void FaceWalk::AddStar(uint32_t vertex) {
  for (const uint32_t face : mesh_.Star(vertex, kMostFaces)) Add(face, 0);
}

uint32_t FaceWalk::FindLeft(Face face) const {
  TurnToSmallest(&face);
  const uint32_t equal = mesh_.NumberOf(face);
  // Equal faces follow each other along every sweep.
  const uint32_t left = equal < mesh_.face_count() ? remaining_.FirstFrom(equal) : kNoNumber;
  if (left == kNoNumber || mesh_.faces[left] != face) {
    throw Failure(ErrorKind::kInternal, "a face to be ordered is not in the mesh");
  }
  return left;
}

uint32_t FaceWalk::FindNear(Face face) const {
  TurnToSmallest(&face);
  for (const uint32_t number : mesh_.Star(face[0], kMostFaces)) {
    if (mesh_.faces[number] == face && remaining_.Has(number)) return number;
  }
  return kNoNumber;
}

/// Pattern p: each place as far from that p + 1 faces before as that from the one before it.
void FaceWalk::AddPatterns() {
  has_pattern_ = {};
  for (uint32_t p = 0; p < kPatterns && done_ >= 2 * (p + 1); ++p) {
    const Face near = PlacesOf(last_[p]), far = PlacesOf(last_[2 * p + 1]);
    Face& next = pattern_[p];
    // Modulo 2^32; what is no vertex is beyond them.
    for (size_t i = 0; i < 3; ++i) next[i] = near[i] + (near[i] - far[i]);
    if (std::ranges::max(next) >= placed_) continue;
    has_pattern_[p] = true;
    const uint32_t face = FindNear({sequence_[next[0]], sequence_[next[1]], sequence_[next[2]]});
    if (face != kNoNumber) Add(face, 1u << p);
  }
}

bool FaceWalk::HasFacesLeft(uint32_t place) const {
  return std::ranges::any_of(mesh_.Star(sequence_[place], kMostFaces),
                             [this](uint32_t face) { return remaining_.Has(face); });
}

void FaceWalk::Collect() {
  found_.clear();
  if (done_ == 0) return;
  AddPatterns();
  for (const uint32_t vertex : last_[0]) AddStar(vertex);
  while (front_ < placed_ && !HasFacesLeft(front_)) ++front_;
  if (front_ < placed_) AddStar(sequence_[front_]);
  if (newest_ + 1 < placed_) AddStar(sequence_[newest_ + 1]);
}

Option<FaceWalk::kContexts> FaceWalk::OptionOf(const Found& found) const {
  const Face& face = mesh_.faces[found.face];
  const uint32_t relation = RelationTo(last_[0], face);
  const uint32_t before = done_ > 1 ? CommonCorners(last_[1], face) : 0;
  const uint32_t at_front = found.least == front_ ? 1 : 0;
  const uint32_t age = found.most <= newest_ ? 0 : (found.most == newest_ + 1 ? 1 : 2);
  uint32_t lower_least = 0, lower_most = 0;
  for (const Found& other : found_) {
    const bool is_before =
        other.least != found.least ? other.least < found.least : other.most < found.most;
    if (is_before) ++lower_least;
    if (other.most < found.most) ++lower_most;
  }
  const uint32_t ranks =
      std::min(lower_least, kRanks - 1) * kRanks + std::min(lower_most, kRanks - 1);
  return {found.face,
          {(relation * kRelations + relation_) * 4 + found.patterns,
           (((relation * 4 + before) * 2 + at_front) * 3 + age) * 4 + found.patterns,
           ranks * kRelations + relation, (ranks * 2 + at_front) * 3 + age,
           (relation * kRelations + relation_) * kRelations + relation_before_,
           ((ranks * 3 + age) * 4 + before) * kRelations + relation_}};
}

template <class Coder>
uint32_t FaceWalk::CodeNumber(Coder& coder, uint32_t number) {
  Collect();
  bool is_near = false;
  if (!found_.empty()) {
    is_near = Coder::kEncoding && std::ranges::count(found_, number, &Found::face) > 0;
    const uint32_t past = history_ * kManyClasses + ManyClass(found_.size());
    is_near = near_.Code(coder, {past, relation_ * kRelations + relation_before_}, 0, is_near);
  }
  history_ = (history_ << 1 | (is_near ? 1 : 0)) % kHistories;
  if (!is_near) return remaining_.Code(coder, last_number_, number);
  options_.clear();
  for (const Found& found : found_) options_.push_back(OptionOf(found));
  return choice_.Code(coder, std::span(options_), number);
}

template <class Coder>
uint32_t FaceWalk::CodeTurn(Coder& coder, const Face& face, uint32_t turn) {
  const uint32_t relation = done_ == 0 ? 0 : RelationTo(last_[0], face);
  std::array<Option<kTurnContexts>, 3> options;
  for (uint32_t t = 0; t < 3; ++t) {
    const Face turned = {face[t], face[(t + 1) % 3], face[(t + 2) % 3]};
    const Face places = PlacesOf(turned);
    const uint32_t shape = RankOfFirst(places) * 2 + (places[1] < places[2] ? 1 : 0);
    uint32_t patterns = 0, corners = 0;
    for (uint32_t p = 0; p < kPatterns; ++p) {
      if (has_pattern_[p] && pattern_[p] == places) patterns |= 1u << p;
    }
    for (const uint32_t vertex : turned) {
      corners = corners * 4 + (done_ == 0 ? 3 : CornerAt(last_[0], vertex));
    }
    options[t] = {t,
                  {corners * 3 + first_corner_, (shape * 3 + first_corner_) * 4 + patterns,
                   corners * 4 + patterns, (relation * 6 + shape) * 3 + first_corner_}};
  }
  return turns_.Code(coder, std::span(options), turn);
}

void FaceWalk::Advance(uint32_t number, const Face& face) {
  GivePlaces(face);
  const Face places = PlacesOf(face);
  first_corner_ = RankOfFirst(places);
  relation_before_ = relation_;
  relation_ = done_ == 0 ? 0 : RelationTo(last_[0], face);
  remaining_.Remove(number);
  last_number_ = number;
  last_ = {face, last_[0], last_[1], last_[2]};
  newest_ = std::max(newest_, std::ranges::max(places));
  ++done_;
}

template <class Coder>
void FaceWalk::Code(Coder& coder, std::span<Face> faces) {
  for (Face& face : faces) {
    uint32_t number = 0, turn = 0;
    if constexpr (Coder::kEncoding) {
      Face first = face;
      turn = (3 - TurnToSmallest(&first)) % 3;
      number = FindLeft(face);
    }
    number = CodeNumber(coder, number);
    const Face& found = mesh_.faces[number];
    turn = CodeTurn(coder, found, turn);
    face = {found[turn], found[(turn + 1) % 3], found[(turn + 2) % 3]};
    Advance(number, face);
  }
}

template void FaceWalk::Code(BitEncoder&, std::span<Face>);
template void FaceWalk::Code(BitDecoder&, std::span<Face>);

}  // namespace folprom
