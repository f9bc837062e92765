// The faces of a split: which go to which child, which are new, and how they run.
#include <algorithm>
#include <utility>

#include "engine/connectivity/lean.h"
#include "engine/connectivity/split_coder.h"
#include "engine/entropy/bit_coder.h"

namespace folprom {

void SplitCoder::CountFace(const SplitStar::StarFace& face) {
  for (uint32_t i = 0; i < 2; ++i) {
    if (face.end[i] == kNone) continue;
    auto& neighbour = star_.neighbours[face.end[i]];
    // End 0 follows the split vertex: the face runs first -> neighbour, the new face
    // (first, second, neighbour) back; so they agree.
    const auto cast = [&](int vote) {
      neighbour.votes = static_cast<int8_t>(std::clamp(neighbour.votes + vote, -2, 2));
    };
    if (face.side & kFirst) {
      neighbour.faces_first = static_cast<uint16_t>(std::min(neighbour.faces_first + 1u, 2u));
      cast((i == 0) != face.turns.first ? 1 : -1);
    }
    if (face.side & kSecond) {
      neighbour.faces_second = static_cast<uint16_t>(std::min(neighbour.faces_second + 1u, 2u));
      cast((i == 0) != face.turns.second ? -1 : 1);
    }
  }
}

int32_t SplitCoder::LeanOfFace(const Complex& complex, const std::vector<Int3>& positions,
                               const Known& known, const SplitStar::StarFace& face) const {
  int32_t lean = 0;
  for (uint32_t i = 0; i < 2; ++i) {
    if (face.end[i] != kNone) {
      lean += star_.neighbours[face.end[i]].lean / 2;
      continue;
    }
    const Int3& foreign = positions[complex.Opposite(face.corner)[i]];
    lean += LeanOf(SquaredDistance(foreign, known.first), SquaredDistance(foreign, known.second),
                   SquaredDistance(known.first, known.second)) /
            2;
  }
  return lean;
}

template <class Coder>
void SplitCoder::CodeFreeFace(Coder& coder, const Complex& complex, int32_t lean,
                              SplitOracle* oracle, SplitStar::StarFace* face) {
  Side truth = kUndecided;
  if constexpr (Coder::kEncoding) truth = oracle->FaceSide(face->corner / 3);
  const uint32_t pivots = std::min(pivots_, 3u), bucket = LeanBucket(lean);
  const uint32_t foreign = face->end[0] == kNone || face->end[1] == kNone ? 1 : 0;
  const uint32_t around = pivots * 4 + (star_.connected ? 2u : 0u) + foreign;
  if (!face_both_.Code(coder, {around, bucket / 3}, 0, truth == kBoth)) {
    const Side nearer = lean < 0 ? kFirst : kSecond;
    const bool farther = face_side_.Code(coder, {bucket, pivots}, 0, truth != nearer);
    face->side = farther ? (nearer == kFirst ? kSecond : kFirst) : nearer;
    return;
  }
  face->side = kBoth;
  FaceTurns& turns = face->turns;
  if constexpr (Coder::kEncoding) turns = oracle->TurnsOf(complex, face->corner / 3);
  turns.first = face_turn_.Code(coder, {0}, 0, turns.first);
  turns.second = face_turn_.Code(coder, {turns.first ? 2u : 1u}, 0, turns.second);
}

template <class Coder>
void SplitCoder::CodeFaces(Coder& coder, const Complex& complex, const std::vector<Int3>& positions,
                           const Known& known, SplitOracle* oracle) {
  for (auto& face : star_.faces) {
    int possible = kBoth;
    for (const uint32_t end : face.end) {
      if (end != kNone) possible &= star_.neighbours[end].side;
    }
    face.side = static_cast<Side>(possible);
    if (possible == kBoth) {
      CodeFreeFace(coder, complex, LeanOfFace(complex, positions, known, face), oracle, &face);
    }
    CountFace(face);
  }
}

template <class Coder>
void SplitCoder::CodeNewFaces(Coder& coder, SplitOracle* oracle, Complex& complex) {
  if (!star_.connected) return;
  uint32_t made = 0;
  uint32_t before = 0;  // orientation of the face made last: 0 none, 1 backward, 2 forward
  for (uint32_t index : order_) {
    auto& neighbour = star_.neighbours[index];
    if (neighbour.side != kBoth) continue;
    bool exists = false;
    if constexpr (Coder::kEncoding) exists = oracle->HasNewFace(neighbour.vertex);
    uint32_t around = neighbour.faces_first * 3u + neighbour.faces_second;
    exists = new_face_.Code(
        coder, {around * 3 + std::min(made, 2u), std::min(pivots_, 5u) * 3 + std::min(made, 2u)}, 0,
        exists);
    if (!exists) continue;
    bool forward = false;
    if constexpr (Coder::kEncoding) forward = oracle->NewFaceForward(neighbour.vertex);
    uint32_t votes = static_cast<uint32_t>(neighbour.votes + 2);
    forward = orientation_.Code(coder, {votes * 3 + before}, 0, forward);
    before = forward ? 2 : 1;
    ++made;
    neighbour.new_face = forward ? complex.AddFace(star_.vertex, star_.second, neighbour.vertex)
                                 : complex.AddFace(star_.second, star_.vertex, neighbour.vertex);
  }
}

void SplitCoder::AddFanFaces(Complex& complex) {
  for (uint32_t place : {cut_.begin, cut_.end}) {
    if (fan_.IsOutside(place)) continue;
    auto& pivot = star_.neighbours[fan_.neighbour[place]];
    pivot.new_face = place == cut_.end ? complex.AddFace(star_.vertex, star_.second, pivot.vertex)
                                       : complex.AddFace(star_.second, star_.vertex, pivot.vertex);
  }
}

void SplitCoder::ApplySides(Complex& complex) {
  for (auto& neighbour : star_.neighbours) {
    if (neighbour.side == kSecond) {
      complex.MoveHalfEdge(neighbour.half_edge, star_.vertex, star_.second);
    } else if (neighbour.side == kBoth) {
      neighbour.new_edge = complex.AddEdge(star_.second, neighbour.vertex);
    }
  }
  if (star_.connected && owns_child_edge_) {
    star_.child_edge = complex.AddEdge(star_.vertex, star_.second);
  }
  for (auto& face : star_.faces) {
    if (face.side == kSecond) {
      complex.MoveCorner(face.corner, star_.vertex, star_.second);
    } else if (face.side == kBoth) {
      auto [next, previous] = complex.Opposite(face.corner);
      if (face.turns.second) std::swap(next, previous);
      face.new_face = complex.AddFace(star_.second, next, previous);
      if (face.turns.first) complex.TurnFace(face.corner);
    }
  }
}

template void SplitCoder::CodeFaces<BitEncoder>(BitEncoder&, const Complex&,
                                                const std::vector<Int3>&, const Known&,
                                                SplitOracle*);
template void SplitCoder::CodeNewFaces<BitEncoder>(BitEncoder&, SplitOracle*, Complex&);
template void SplitCoder::CodeFaces<BitDecoder>(BitDecoder&, const Complex&,
                                                const std::vector<Int3>&, const Known&,
                                                SplitOracle*);
template void SplitCoder::CodeNewFaces<BitDecoder>(BitDecoder&, SplitOracle*, Complex&);

}  // namespace folprom
