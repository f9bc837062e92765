#include "engine/connectivity/split_oracle.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace folprom {

SplitOracle::SplitOracle(uint32_t vertex_count, std::vector<Face> faces,
                         std::vector<uint32_t> set_of_vertex)
    : faces_(std::move(faces)), vertex_label_(std::move(set_of_vertex)) {
  if (vertex_label_.empty()) vertex_label_.assign(vertex_count, 0);
  uint32_t sets = 0;
  for (uint32_t label : vertex_label_) sets = std::max(sets, label + 1);
  for (uint32_t i = 0; i < sets; ++i) vertex_of_label_.push_back(i);
  corner_begin_.assign(vertex_count + size_t{1}, 0);
  for (const Face& face : faces_) {
    for (uint32_t vertex : face) ++corner_begin_[vertex + 1];
  }
  for (size_t i = 0; i < vertex_count; ++i) corner_begin_[i + 1] += corner_begin_[i];
  corners_.resize(faces_.size() * 3);
  std::vector<uint32_t> cursor(corner_begin_.begin(), corner_begin_.end() - 1);
  for (uint32_t f = 0; f < faces_.size(); ++f) {
    const auto [a, b, c] = faces_[f];
    corners_[cursor[a]++] = {b, c, f};
    corners_[cursor[b]++] = {c, a, f};
    corners_[cursor[c]++] = {a, b, f};
  }
  face_label_.assign(faces_.size(), kNone);
}

void SplitOracle::AttachInitial(const Complex& complex) {
  edge_count_.assign(complex.edge_count(), 0);
  records_.assign(complex.face_count(), {});
  face_of_label_.resize(complex.face_count());
  for (uint32_t f = 0; f < complex.face_count(); ++f) face_of_label_[f] = records_[f].label = f;
  for (uint32_t t = 0; t < faces_.size(); ++t) {
    const Face set = SetsOf(t);
    for (size_t i = 0; i < 3; ++i) {
      for (const auto& [target, h] : complex.Spokes(set[i])) {
        // Each pair of corners is met twice over the loop, once in each direction.
        if (h % 2 == 0 && target == set[(i + 1) % 3]) ++edge_count_[h / 2];
        if (h % 2 == 0 && target == set[(i + 2) % 3]) ++edge_count_[h / 2];
      }
    }
    if (set[0] == set[1] || set[1] == set[2] || set[0] == set[2]) continue;
    for (const uint32_t c : complex.Corners(set[0])) {
      const auto [next, previous] = complex.Opposite(c);
      if ((next == set[1] && previous == set[2]) || (next == set[2] && previous == set[1])) {
        face_label_[t] = c / 3;
        ++records_[c / 3].count;
        records_[c / 3].along += RunsAlong(complex.face(c / 3), SetsOf(t)) ? 1 : -1;
      }
    }
  }
}

SplitOracle::PerNeighbour& SplitOracle::At(uint32_t neighbour) {
  PerNeighbour& entry = neighbour_[neighbour];
  if (entry.stamp != stamp_) entry = PerNeighbour{stamp_, 0, 0, 0, kNone};
  return entry;
}

void SplitOracle::Scan(uint32_t vertex, std::span<const std::span<const uint32_t>> moved,
                       bool moved_is_second) {
  ++stamp_;
  moved_is_second_ = moved_is_second;
  child_edge_count_ = 0;
  touched_faces_.clear();
  opened_faces_.clear();
  moved_label_ = static_cast<uint32_t>(vertex_of_label_.size());
  vertex_of_label_.push_back(vertex);
  neighbour_.resize(std::max(neighbour_.size(), vertex_of_label_.size()));
  face_.resize(std::max(face_.size(), records_.size()));
  has_counted_along_ = false;
  old_label_ = kNone;
  for (auto range : moved) {
    for (uint32_t v : range) {
      old_label_ = vertex_label_[v];
      vertex_label_[v] = moved_label_;
    }
  }
  for (auto range : moved) {
    for (uint32_t v : range) {
      for (uint32_t i = corner_begin_[v]; i < corner_begin_[v + 1]; ++i) ScanCorner(corners_[i]);
    }
  }
}

void SplitOracle::ScanCorner(const Corner& corner) {
  const uint32_t t = corner.face;
  const uint32_t next = vertex_label_[corner.next], previous = vertex_label_[corner.previous];
  for (uint32_t label : {next, previous}) {
    if (label == moved_label_) continue;
    if (label == old_label_) {
      ++child_edge_count_;
    } else {
      ++At(vertex_of_label_[label]).edges;
    }
  }
  if (next == moved_label_ || previous == moved_label_ || next == previous) return;
  if (next == old_label_ || previous == old_label_) {
    uint32_t third = vertex_of_label_[next == old_label_ ? previous : next];
    PerNeighbour& entry = At(third);
    ++entry.new_faces;
    // (moved, other child, third) is (first, second, third) when the moved set is the first child.
    bool forward = (next == old_label_) != moved_is_second_;
    entry.forward += forward ? 1 : -1;
    opened_faces_.push_back({t, third});
    return;
  }
  PerFace& entry = face_[face_of_label_[face_label_[t]]];
  if (entry.stamp != stamp_) entry = PerFace{stamp_, 0, 0, kNone};
  ++entry.count;
  touched_faces_.push_back(t);
}

Side SplitOracle::SideOf(uint32_t moved_count, uint32_t total) const {
  if (moved_count == 0) return moved_is_second_ ? kFirst : kSecond;
  if (moved_count == total) return moved_is_second_ ? kSecond : kFirst;
  return kBoth;
}

Side SplitOracle::NeighbourSide(uint32_t half_edge, uint32_t neighbour) const {
  const PerNeighbour& entry = neighbour_[neighbour];
  return SideOf(entry.stamp == stamp_ ? entry.edges : 0, edge_count_[half_edge / 2]);
}

Side SplitOracle::FaceSide(uint32_t face) const {
  const PerFace& entry = face_[face];
  return SideOf(entry.stamp == stamp_ ? entry.count : 0, records_[face].count);
}

Face SplitOracle::SetsOf(uint32_t original) const {
  const auto [a, b, c] = faces_[original];
  return {VertexOf(a), VertexOf(b), VertexOf(c)};
}

void SplitOracle::CountAlong(const Complex& complex) {
  has_counted_along_ = true;
  for (const uint32_t t : touched_faces_) {
    const uint32_t face = face_of_label_[face_label_[t]];
    face_[face].along += RunsAlong(complex.face(face), SetsOf(t)) ? 1 : -1;
  }
}

FaceTurns SplitOracle::TurnsOf(const Complex& complex, uint32_t face) {
  // Few splits part the originals of a face, so the others do not count.
  if (!has_counted_along_) CountAlong(complex);
  const bool moved = face_[face].along < 0, stayed = records_[face].along < face_[face].along;
  return moved_is_second_ ? FaceTurns{stayed, moved} : FaceTurns{moved, stayed};
}

bool SplitOracle::HasNewFace(uint32_t neighbour) const {
  const PerNeighbour& entry = neighbour_[neighbour];
  return entry.stamp == stamp_ && entry.new_faces > 0;
}

bool SplitOracle::NewFaceForward(uint32_t neighbour) const {
  return neighbour_[neighbour].forward >= 0;
}

void SplitOracle::Commit(const SplitStar& star) {
  vertex_of_label_[moved_label_] = moved_is_second_ ? star.second : star.vertex;
  if (old_label_ != kNone) {
    vertex_of_label_[old_label_] = moved_is_second_ ? star.vertex : star.second;
  }
  CommitEdges(star);
  CommitFaces(star);
  CommitNewFaces(star);
}

void SplitOracle::CommitEdges(const SplitStar& star) {
  auto set = [&](uint32_t edge, uint32_t count) {
    if (edge >= edge_count_.size()) edge_count_.resize(edge + size_t{1}, 0);
    edge_count_[edge] = count;
  };
  for (const auto& neighbour : star.neighbours) {
    if (neighbour.side != kBoth) continue;
    uint32_t edge = neighbour.half_edge / 2, moved = neighbour_[neighbour.vertex].edges;
    uint32_t stayed = edge_count_[edge] - moved;
    set(edge, moved_is_second_ ? stayed : moved);
    set(neighbour.new_edge, moved_is_second_ ? moved : stayed);
  }
  if (star.child_edge != kNone) set(star.child_edge, child_edge_count_);
}

void SplitOracle::AddFaceRecord(uint32_t face, uint32_t count, int32_t along, uint32_t label) {
  if (face >= records_.size()) records_.resize(face + size_t{1});
  records_[face] = {count, std::abs(along), label};
  if (label >= face_of_label_.size()) face_of_label_.resize(label + size_t{1}, kNone);
  face_of_label_[label] = face;
}

void SplitOracle::CommitFaces(const SplitStar& star) {
  // Originals of the moved set get a label of their own; which face each label means is set after.
  uint32_t next_label = static_cast<uint32_t>(face_of_label_.size());
  for (const auto& face : star.faces) {
    if (face.side == kBoth) face_[face.corner / 3].new_label = next_label++;
  }
  for (uint32_t t : touched_faces_) {
    uint32_t label = face_[face_of_label_[face_label_[t]]].new_label;
    if (label != kNone) face_label_[t] = label;
  }
  for (const auto& face : star.faces) {
    if (face.side != kBoth) continue;
    const uint32_t first = face.corner / 3;
    const PerFace moved = face_[first];
    const FaceRecord before = records_[first];
    const uint32_t stays = moved_is_second_ ? first : face.new_face;
    const uint32_t goes = moved_is_second_ ? face.new_face : first;
    AddFaceRecord(stays, before.count - moved.count, before.along - moved.along, before.label);
    AddFaceRecord(goes, moved.count, moved.along, moved.new_label);
  }
}

void SplitOracle::CommitNewFaces(const SplitStar& star) {
  for (const auto& neighbour : star.neighbours) {
    if (neighbour.new_face == kNone) continue;
    PerNeighbour& entry = neighbour_[neighbour.vertex];
    entry.new_face_label = static_cast<uint32_t>(face_of_label_.size());
    AddFaceRecord(neighbour.new_face, entry.new_faces, entry.forward, entry.new_face_label);
  }
  for (const OpenedFace& opened : opened_faces_) {
    face_label_[opened.face] = neighbour_[opened.third].new_face_label;
  }
}

FaceCensus TakeCensus(const Complex& complex, const SplitOracle& oracle, size_t real_faces) {
  std::vector<Face> originals(real_faces);
  std::vector<uint32_t> face_of(real_faces);
  for (uint32_t i = 0; i < real_faces; ++i) {
    originals[i] = oracle.SetsOf(i);
    face_of[i] = oracle.FaceOf(i);
  }
  return TakeCensus(complex, originals, face_of);
}

}  // namespace folprom
