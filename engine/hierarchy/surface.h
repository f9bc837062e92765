// Normals and curvatures of the original vertices. Encoder only.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "engine/mesh/types.h"

namespace folprom {

struct SurfaceAttributes {
  std::vector<Eigen::Vector3d>
      normals;                ///< unit, area-weighted over the adjacent faces; 0 where undefined
  std::vector<double> areas;  ///< a third of the adjacent faces', lattice units squared
  std::vector<double>
      curvature;  ///< c_i of section 2.1: deviation of adjacent face normals, 0 .. 1
};

/// `subtree` is the number by which cross faces refer to these vertices.
SurfaceAttributes MeasureSurface(std::span<const Int3> positions, std::span<const Face> faces,
                                 std::span<const CrossFace> cross_faces, uint32_t subtree);

}  // namespace folprom
