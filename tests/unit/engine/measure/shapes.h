// Surfaces whose distances are known in closed form.
#pragma once

#include <cstddef>

#include "engine/measure/triangle_mesh.h"
#include "folprom/measure.h"
#include "parallel/runner.h"

namespace folprom::measure {

/// A unit square in the plane z = height, its lower corner at (x, 0), cells x cells squares.
TriangleMesh Plane(double x, double height, uint32_t cells);
/// The same in the plane z = 0, but a pyramid of this height stands on the square of half width
/// `half_width` around its centre.
TriangleMesh PlaneWithPyramid(double half_width, double height);
/// A cube of edge 1, each side of cells x cells squares.
TriangleMesh Cube(uint32_t cells);
/// A sphere around the origin of 2 rings^2 vertices.
TriangleMesh Sphere(double radius, uint32_t rings);
TriangleMesh Moved(TriangleMesh mesh, const Vector3& by, double factor = 1);
/// Random triangles in the unit box, some of them slivers, segments and points.
TriangleMesh RandomTriangles(size_t count, uint64_t seed);

/// Compares on a serial runner unless another is given.
Comparison Compare(const TriangleMesh& a, const TriangleMesh& b, uint64_t samples = 100'000,
                   parallel::Runner* runner = nullptr);

}  // namespace folprom::measure
