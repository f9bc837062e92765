#include "engine/connectivity/face_exceptions.h"

#include <algorithm>
#include <string>

#include "engine/entropy/bit_coder.h"
#include "engine/entropy/integer_model.h"

namespace folprom {
namespace {

/// Degenerate original on the edge (a, b), a < b: does it hold `b` twice.
struct EdgeFace {
  uint32_t a, b;
  bool second_twice;
  bool operator<(const EdgeFace& other) const { return a != other.a ? a < other.a : b < other.b; }
};

}  // namespace

FaceCensus TakeCensus(const Complex& complex, const std::vector<Face>& originals,
                      const std::vector<uint32_t>& face_of) {
  FaceCensus census;
  census.forward.assign(complex.face_count(), 0);
  census.backward.assign(complex.face_count(), 0);
  census.on_edge.assign(complex.edge_count(), {0, 0});
  census.on_vertex.assign(complex.vertex_count(), 0);
  std::vector<EdgeFace> on_edges;
  for (size_t i = 0; i < originals.size(); ++i) {
    const Face& face = originals[i];
    if (face_of[i] != kNone) {
      bool same = RunsAlong(complex.face(face_of[i]), face);
      ++(same ? census.forward : census.backward)[face_of[i]];
    } else if (face[0] == face[1] && face[1] == face[2]) {
      ++census.on_vertex[face[0]];
    } else {
      uint32_t twice = face[0] == face[1] || face[0] == face[2] ? face[0] : face[1];
      uint32_t once = face[0] != twice ? face[0] : (face[1] != twice ? face[1] : face[2]);
      on_edges.push_back({std::min(once, twice), std::max(once, twice), twice > once});
    }
  }
  if (on_edges.empty()) return census;
  std::sort(on_edges.begin(), on_edges.end());
  for (uint32_t e = 0; e < complex.edge_count(); ++e) {
    auto [a, b] = complex.edge(e);
    EdgeFace key{std::min(a, b), std::max(a, b), false};
    auto range = std::equal_range(on_edges.begin(), on_edges.end(), key);
    for (auto it = range.first; it != range.second; ++it) {
      uint32_t twice = it->second_twice ? it->b : it->a;
      ++census.on_edge[e][twice == a ? 0 : 1];
    }
  }
  return census;
}

void FaceExceptions::Repeat(const Complex& complex, const Face& face, uint32_t count) {
  if (count > most_faces_ || FaceCount(complex) + count > most_faces_) {
    throw Failure(ErrorKind::kCorrupt, "more faces coded than the table announces");
  }
  if (count > 0) extra_.push_back({face, count});
  extra_count_ += count;
}

template <class Coder>
void FaceExceptions::Code(Coder& coder, const Complex& complex, const FaceCensus* census) {
  bool any_copies = false, any_degenerate = false;
  if (census != nullptr) {
    for (size_t f = 0; f < census->forward.size(); ++f) {
      if (census->forward[f] == 0) {
        throw Failure(ErrorKind::kInternal, "a face of the complex runs against its originals");
      }
      any_copies |= census->forward[f] + census->backward[f] > 1;
    }
    for (const auto& counts : census->on_edge) any_degenerate |= counts[0] + counts[1] > 0;
    for (uint32_t count : census->on_vertex) any_degenerate |= count > 0;
  }
  any_copies = coder.Code(4096, any_copies);
  any_degenerate = coder.Code(4096, any_degenerate);
  if (any_copies) {
    IntegerModel<1> same({4}), opposite({4});
    uint32_t before_same = 0, before_opposite = 0;
    for (uint32_t f = 0; f < complex.face_count(); ++f) {
      uint32_t along = 0, against = 0;
      if (census != nullptr) {
        along = census->forward[f] - 1;
        against = census->backward[f];
      }
      along = same.CodeUnsigned(coder, {std::min(before_same, 3u)}, along);
      against = opposite.CodeUnsigned(coder, {std::min(before_opposite, 3u)}, against);
      Face face = complex.face(f);
      Repeat(complex, face, along);
      Repeat(complex, {face[0], face[2], face[1]}, against);
      before_same = along;
      before_opposite = against;
    }
  }
  if (any_degenerate) {
    IntegerModel<1> on_edge({4}), on_vertex({4});
    uint32_t before = 0;
    for (uint32_t e = 0; e < complex.edge_count(); ++e) {
      auto ends = complex.edge(e);
      for (size_t i = 0; i < 2; ++i) {
        uint32_t count = census != nullptr ? census->on_edge[e][i] : 0;
        count = on_edge.CodeUnsigned(coder, {std::min(before, 3u)}, count);
        Repeat(complex, {ends[i], ends[i], ends[1 - i]}, count);
        before = count;
      }
    }
    before = 0;
    for (uint32_t v = 0; v < complex.vertex_count(); ++v) {
      uint32_t count = census != nullptr ? census->on_vertex[v] : 0;
      count = on_vertex.CodeUnsigned(coder, {std::min(before, 3u)}, count);
      Repeat(complex, {v, v, v}, count);
      before = count;
    }
  }
}

void FaceExceptions::AppendFaces(const Complex& complex, std::vector<Face>* faces) const {
  if (FaceCount(complex) > kMostFaces) {
    throw Failure(ErrorKind::kLimit, std::to_string(FaceCount(complex)) +
                                         " faces between the same vertices, more than " +
                                         std::to_string(kMostFaces));
  }
  faces->reserve(faces->size() + FaceCount(complex));
  for (uint32_t f = 0; f < complex.face_count(); ++f) {
    faces->push_back(complex.face(f));
  }
  for (const Repeated& r : extra_) faces->insert(faces->end(), r.count, r.face);
}

template void FaceExceptions::Code<BitEncoder>(BitEncoder&, const Complex&, const FaceCensus*);
template void FaceExceptions::Code<BitDecoder>(BitDecoder&, const Complex&, const FaceCensus*);

}  // namespace folprom
