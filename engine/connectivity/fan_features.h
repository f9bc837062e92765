// What the triangles and edges around a split look like, for each place of its fan: what a FanModel
// weighs. Four places at a time.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/connectivity/fan.h"
#include "engine/entropy/lanes.h"
#include "engine/geometry/local_frame.h"

namespace folprom {

/// What is known of a neighbour.
struct FanSpoke {
  Vector3 position;      ///< relative to the first child, lattice units
  uint32_t degree;       ///< number of its edges before the split
  double age;            ///< its number over the number of vertices, 0 .. 1
  bool younger;          ///< than the vertex that is split
  uint32_t splits_past;  ///< splits since it was split itself, or made
};

/// A quantity per place, of which the places before and behind can be read as well.
class AroundFan {
 public:
  static constexpr uint32_t kGroups = Fan::kMostPlaces / kLanes;
  void Set(uint32_t group, Lanes value) { StoreLanes(value, &values_[kFirst + kLanes * group]); }
  void SetPlace(uint32_t place, float value) { values_[kFirst + place] = value; }
  /// After all are set: closes the ring.
  void Close(uint32_t places) {
    values_[kFirst - 1] = values_[kFirst + places - 1];
    values_[kFirst + places] = values_[kFirst];
  }
  Lanes At(uint32_t group) const { return LoadLanes(&values_[kFirst + kLanes * group]); }
  Lanes Before(uint32_t group) const { return LoadLanes(&values_[kFirst + kLanes * group - 1]); }
  Lanes After(uint32_t group) const { return LoadLanes(&values_[kFirst + kLanes * group + 1]); }
  float Of(uint32_t place) const { return values_[kFirst + place]; }

 private:
  static constexpr uint32_t kFirst = kLanes;
  std::array<float, kFirst + Fan::kMostPlaces + kLanes> values_{};
};

/// A knot says where a quantity lies among the weights of its table; below 0: the place has none.
class FanFeatures {
 public:
  static constexpr uint32_t kGroups = AroundFan::kGroups;
  /// Knots of a quantity, of a neighbour's age, of the time since its last split.
  static constexpr uint32_t kKnots = 8, kAgeKnots = 12;
  static constexpr uint32_t kMostDegree = 15;
  /// What a part of a cut adds up: by the face after the place, by its neighbour, by the new
  /// triangle at the begin or end of the second child's part, by a pivot.
  enum Role : uint32_t {
    kFaceFirstShape,
    kFaceFirstTurned,
    kFaceSecondShape,
    kFaceSecondTurned,
    kSpokeFirstLean,
    kSpokeFirstAngles,
    kSpokeFirstBend,
    kSpokeSecondLean,
    kSpokeSecondBend,
    kBeginShape,
    kBeginTurned,
    kBeginAnglesBefore,
    kBeginAnglesAfter,
    kBeginBend,
    kEndShape,
    kEndTurned,
    kEndAnglesBefore,
    kEndAnglesAfter,
    kEndBend,
    kPivotDegree,
    kPivotAge,
    kPivotRest,
    kPivotAngle,
    kRoles
  };

  /// spokes: by place, the outside has none. second: the second child relative to the first.
  void Measure(const Fan& fan, std::span<const FanSpoke> spokes, const Vector3& second);

  uint32_t groups() const { return groups_; }
  Lanes knot(Role role, uint32_t group) const { return knot_[role][group]; }
  /// Between the new triangles at two places, for four second places.
  Lanes PairKnot(uint32_t first, uint32_t group) const;

 private:
  /// Triangles of a child with two neighbours, or of both children with one.
  struct Triangles {
    AroundFan x, y, z;  ///< normal, as long as twice the area
    AroundFan length;
    Lanes shape[kGroups];  ///< 1: equilateral, 0: no area
    void Close(uint32_t places);
  };
  struct Vectors {
    Lanes x, y, z;
  };
  static Lanes Bend(const Vectors& a, Lanes a_length, const Vectors& b, Lanes b_length);
  static Vectors NormalsAt(const Triangles& triangles, uint32_t group);
  static Vectors NormalsBefore(const Triangles& triangles, uint32_t group);
  static void SetTriangles(Vectors a, Vectors b, uint32_t group, Triangles* triangles);
  void PlaceNeighbours(std::span<const FanSpoke> spokes);
  void MeasureFaces(uint32_t group);
  void MeasureNewTriangles(uint32_t group, const Vectors& second);
  void CollectFaces(uint32_t group);
  void CollectSpokes(uint32_t group);
  void CollectPivots(uint32_t group);

  uint32_t places_ = 0, groups_ = 0;
  float spacing2_ = 1;  ///< squared distance of the children
  Lanes normal_x_, normal_y_, normal_z_;
  AroundFan has_face_;  ///< 1: there is a face after the place
  Lanes face_here_[kGroups];  ///< the same; 0 behind the last place
  Lanes is_real_[kGroups];    ///< 1: a neighbour, not the outside
  // Of the neighbours, from each child.
  AroundFan first_x_, first_y_, first_z_, second_x_, second_y_, second_z_;
  Triangles of_first_, of_second_, of_both_;
  // Cotangents of the angles of a face with each child: at its first neighbour, at its second.
  AroundFan first_at_, first_at_next_, second_at_, second_at_next_;
  Lanes at_first_[kGroups], at_second_[kGroups], at_pivot_[kGroups];  ///< of the new triangle
  AroundFan degree_, age_, rest_;
  Lanes knot_[kRoles][kGroups];
};

}  // namespace folprom
