// How likely each way is in which a split can part a fan.
//
// A log-linear model over all cuts: what the triangles and edges after the split look like (shape,
// angles, bends), how many edges meet at its vertices and how old these are adds up, each by a
// piecewise linear function. The weights at its knots learn from each cut.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/connectivity/fan.h"
#include "engine/entropy/mixed_model.h"
#include "engine/geometry/local_frame.h"

namespace folprom {

class FanModel {
 public:
  /// What is known of a neighbour.
  struct Spoke {
    Vector3 position;      ///< relative to the first child, lattice units
    uint32_t degree;       ///< number of its edges before the split
    double age;            ///< its number over the number of vertices, 0 .. 1
    bool younger;          ///< than the vertex that is split
    uint32_t splits_past;  ///< splits since it was split itself, or made
  };

  FanModel();

  /// Codes the cut. spokes: by place, the outside has none. second: the second child relative to
  /// the first.
  template <class Coder>
  FanCut Code(Coder& coder, const Fan& fan, std::span<const Spoke> spokes, const Vector3& second,
              FanCut truth);
  void Visit(LearnedStateVisitor& visitor);

 private:
  static constexpr uint32_t kMost = Fan::kMostPlaces;
  /// A value between two neighbouring weights.
  struct Term {
    uint16_t weight;
    float share;  ///< of the weight after it
  };
  /// What adds up for one role of a place or face.
  struct Terms {
    static constexpr uint32_t kMostTerms = 6;
    std::array<Term, kMostTerms> term;
    uint32_t count = 0;
    double sum = 0;
  };
  struct Triangle {
    Vector3 normal;  ///< as long as twice the area
    double length = 0;
    double shape = 0;  ///< 1: equilateral, 0: no area
  };
  static Triangle TriangleOf(const Vector3& a, const Vector3& b);

  void Measure(const Fan& fan, std::span<const Spoke> spokes, const Vector3& second);
  void CollectFaces(const Fan& fan);
  void CollectSpokes(const Fan& fan);
  void CollectPivots(const Fan& fan, std::span<const Spoke> spokes);
  void Add(Terms* terms, uint32_t table, double knot, uint32_t knots);
  void AddShape(Terms* terms, uint32_t table, const Triangle& triangle, double sign);
  void AddBend(Terms* terms, uint32_t table, const Triangle& a, const Triangle& b, double sign);
  void AddAngles(Terms* terms, uint32_t table, double cotangents);
  void WeighPairs(const Fan& fan);
  void Weigh(const Fan& fan);
  FanCut TakeLikeliest(uint32_t places, double* probability);
  void Learn(const Fan& fan, FanCut truth);
  void Spread(const Terms& terms, double error);

  std::vector<float> weights_, gradient_, squares_;
  MixedModel<2, 1> hit_;

  // The fan under way.
  double spacing2_ = 1;  ///< squared distance of the children
  Vector3 normal_;
  std::array<Vector3, kMost> first_to_, second_to_;  ///< the neighbours from each child
  std::array<Triangle, kMost> of_first_, of_second_, of_both_;
  // Cotangents of the angles of a face with each child: at its first neighbour, at its second.
  std::array<double, kMost> first_at_, first_at_next_, second_at_, second_at_next_;
  std::array<double, kMost> at_first_, at_second_, at_pivot_;  ///< of the new triangle
  std::array<Terms, kMost> face_first_, face_second_, spoke_first_, spoke_second_;
  std::array<Terms, kMost> begin_, end_, pivot_;
  std::array<std::array<Term, kMost>, kMost> bend_;  ///< between the two new triangles
  std::array<double, kMost> arc_;  ///< by the number of neighbours between the pivots
  /// Per cut; of those not asked for yet, while they are coded.
  std::array<std::array<double, kMost>, kMost> probability_, left_;
};

}  // namespace folprom
