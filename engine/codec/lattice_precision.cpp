#include "engine/codec/lattice_precision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace folprom {
namespace {

/// What rounding along the surface, and across it, may add: parts of the error that is there. A bit
/// of every vertex costs less than the vertices that would lower the error as much, across the
/// surface half as much as along it.
constexpr double kTangentialShare = 0.5;
constexpr double kNormalShare = 0.25;
/// A value rounded to a cell misses by a quarter of the cell on average.
constexpr double kMeanMiss = 0.25;

/// Distance from the faces, per cell, that rounding the coordinates of their corners makes: of the
/// axis nearest to the corner's normal, and of the other two.
struct Leverage {
  double tangential = 0, normal = 0;
};

Leverage MeasureLeverage(const Complex& complex, const SubtreeTruth& truth) {
  const uint32_t vertices = complex.vertex_count(), faces = complex.face_count();
  std::vector<Vector3> vertex_normal(vertices, Vector3{0, 0, 0}), face_normal(faces);
  for (uint32_t f = 0; f < faces; ++f) {
    const Face face = complex.face(f);
    const Int3 at = truth.VertexPosition(face[0]);
    face_normal[f] = Cross(Difference(truth.VertexPosition(face[1]), at),
                           Difference(truth.VertexPosition(face[2]), at));
    for (uint32_t v : face) {
      for (size_t i = 0; i < 3; ++i) vertex_normal[v][i] = vertex_normal[v][i] + face_normal[f][i];
    }
  }
  Leverage sum;
  for (uint32_t f = 0; f < faces; ++f) {
    const Vector3& n = face_normal[f];
    for (uint32_t v : complex.face(f)) {
      size_t dominant = 0;
      for (size_t i = 1; i < 3; ++i) {
        if (std::fabs(vertex_normal[v][i]) > std::fabs(vertex_normal[v][dominant])) dominant = i;
      }
      const double across = n[dominant] * n[dominant];
      sum.normal = sum.normal + std::sqrt(across) / 6;
      sum.tangential = sum.tangential + std::sqrt(std::max(Dot(n, n) - across, 0.0)) / 6;
    }
  }
  return sum;
}

uint32_t CoarsestShift(double leverage, double bound, uint32_t coarsest) {
  uint32_t shift = coarsest;
  while (shift > 0 && kMeanMiss * leverage * static_cast<double>(uint64_t{1} << shift) > bound) {
    --shift;
  }
  return shift;
}

}  // namespace

LatticePrecision ChoosePrecision(const Complex& complex, const SubtreeTruth& truth,
                                 std::span<const uint32_t> open, uint32_t coarsest) {
  double missing = 0;
  for (uint32_t set : open) missing = missing + truth.Distortion(set);
  const Leverage leverage = MeasureLeverage(complex, truth);
  LatticePrecision precision;
  precision.tangential = CoarsestShift(leverage.tangential, kTangentialShare * missing, coarsest);
  precision.normal = CoarsestShift(leverage.normal, kNormalShare * missing, precision.tangential);
  return precision;
}

}  // namespace folprom
