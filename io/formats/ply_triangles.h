// Turns lists of vertex indices into triangles, an index at a time.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "io/formats/mesh_source.h"
#include "io/formats/ply_layout.h"
#include "io/formats/ply_place.h"
#include "io/formats/ply_scalar.h"

namespace folprom::io {

/// What is remembered between two indices of a list; small, so that a list can be cut anywhere.
struct PlyListState {
  uint64_t first = 0;   ///< fan: the first corner; strip: the index before the last
  uint64_t second = 0;  ///< the last index
  uint64_t seen = 0;    ///< indices since the list or the strip began
};

/// The indices of one element. Throws Failure kInput for an index that is no vertex.
class PlyTriangulator {
 public:
  PlyTriangulator(const PlyElementPlan& plan, uint64_t vertex_count)
      : vertex_count_(vertex_count), is_strip_(plan.role == PlyRole::kStrips) {
    const uint64_t largest = UnsignedMax(plan.element->properties[plan.index_list].type);
    // Unsigned types cannot hold the -1 that ends a strip.
    if (largest >= vertex_count) unsigned_restart_ = largest;
  }

  uint64_t Vertex(int64_t index, const PlyPlace& place) const {
    // A negative index is a huge one.
    if (static_cast<uint64_t>(index) >= vertex_count_) [[unlikely]]
      ThrowNoVertex(index, place);
    return static_cast<uint64_t>(index);
  }

  /// Takes the next index of a list; true where it completes a triangle.
  bool Push(int64_t index, const PlyPlace& place, PlyListState& state, Triangle& triangle) const {
    return is_strip_ ? PushStrip(index, place, state, triangle)
                     : PushFan(Vertex(index, place), state, triangle);
  }

 private:
  static bool PushFan(uint64_t vertex, PlyListState& state, Triangle& triangle) {
    if (state.seen++ == 0) {
      state.first = vertex;
      return false;
    }
    triangle = {state.first, state.second, vertex};
    state.second = vertex;
    return state.seen > 2;
  }

  bool PushStrip(int64_t index, const PlyPlace& place, PlyListState& state,
                 Triangle& triangle) const {
    if (index == -1 || (unsigned_restart_ != 0 && index >= 0 &&
                        static_cast<uint64_t>(index) == unsigned_restart_)) {
      state = {};
      return false;
    }
    const uint64_t vertex = Vertex(index, place);
    const bool odd = state.seen % 2 == 1;
    triangle = {state.first, state.second, vertex};
    if (odd) std::swap(triangle[0], triangle[1]);
    const bool is_triangle = state.seen >= 2 && state.first != state.second &&
                             state.first != vertex && state.second != vertex;
    state = {state.second, vertex, state.seen + 1};
    return is_triangle;
  }

  [[noreturn]] void ThrowNoVertex(int64_t index, const PlyPlace& place) const {
    throw place.Fault("the vertex index " + std::to_string(index) + " is not below the count of " +
                      std::to_string(vertex_count_) + " vertices");
  }

  uint64_t vertex_count_;
  uint64_t unsigned_restart_ = 0;  // none
  bool is_strip_;
};

}  // namespace folprom::io
