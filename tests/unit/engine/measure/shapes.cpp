#include "tests/unit/engine/measure/shapes.h"

#include <cmath>
#include <numbers>

#include "engine/measure/compare.h"
#include "tests/support/random.h"

namespace folprom::measure {
namespace {

// A grid of squares over (u, v) in [0, cells]^2, each cut in two.
template <class Position>
void AddGrid(uint32_t cells, const Position& position, TriangleMesh* mesh) {
  const auto first = static_cast<uint32_t>(mesh->positions.size());
  const uint32_t row = cells + 1;
  for (uint32_t v = 0; v < row; ++v) {
    for (uint32_t u = 0; u < row; ++u) {
      mesh->positions.push_back(
          position(static_cast<double>(u) / cells, static_cast<double>(v) / cells));
    }
  }
  for (uint32_t v = 0; v < cells; ++v) {
    for (uint32_t u = 0; u < cells; ++u) {
      const uint32_t corner = first + v * row + u;
      mesh->faces.push_back({corner, corner + 1, corner + row + 1});
      mesh->faces.push_back({corner, corner + row + 1, corner + row});
    }
  }
}

}  // namespace

TriangleMesh Plane(double x, double height, uint32_t cells) {
  TriangleMesh mesh;
  AddGrid(
      cells,
      [&](double u, double v) {
        return Vector3{x + u, v, height};
      },
      &mesh);
  return mesh;
}

TriangleMesh PlaneWithPyramid(double half_width, double height) {
  const double lo = 0.5 - half_width, hi = 0.5 + half_width;
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0},   {1, 0, 0},   {1, 1, 0},   {0, 1, 0},         {lo, lo, 0},
                    {hi, lo, 0}, {hi, hi, 0}, {lo, hi, 0}, {0.5, 0.5, height}};
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t next = (i + 1) % 4;
    mesh.faces.push_back({i, next, 4 + next});
    mesh.faces.push_back({i, 4 + next, 4 + i});
    mesh.faces.push_back({4 + i, 4 + next, 8});
  }
  return mesh;
}

TriangleMesh Cube(uint32_t cells) {
  TriangleMesh mesh;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {0.0, 1.0}) {
      const auto position = [&](double u, double v) {
        Vector3 p{};
        p[axis] = side;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        return p;
      };
      AddGrid(cells, position, &mesh);
    }
  }
  return mesh;
}

TriangleMesh Sphere(double radius, uint32_t rings) {
  TriangleMesh mesh;
  const auto position = [&](double u, double v) {
    const double latitude = std::numbers::pi * v, longitude = 2 * std::numbers::pi * u;
    return Vector3{radius * std::sin(latitude) * std::cos(longitude),
                   radius * std::sin(latitude) * std::sin(longitude), radius * std::cos(latitude)};
  };
  AddGrid(rings, position, &mesh);
  return mesh;
}

TriangleMesh Moved(TriangleMesh mesh, const Vector3& by, double factor) {
  for (Vector3& p : mesh.positions) {
    for (size_t i = 0; i < 3; ++i) p[i] = p[i] * factor + by[i];
  }
  return mesh;
}

TriangleMesh RandomTriangles(size_t count, uint64_t seed) {
  support::Random random(seed);
  TriangleMesh mesh;
  for (uint32_t i = 0; i < count; ++i) {
    const double size = std::ldexp(1, -static_cast<int>(random.Below(12)));
    Vector3 corners[3];
    for (double& x : corners[0]) x = random.Between(0, 1);
    for (size_t corner : {1, 2}) {
      for (size_t axis = 0; axis < 3; ++axis) {
        corners[corner][axis] = corners[0][axis] + size * random.Between(-1, 1);
      }
    }
    const uint64_t kind = random.Below(10);
    if (kind == 0) corners[2] = corners[0];               // a segment
    if (kind == 1) corners[1] = corners[2] = corners[0];  // a point
    if (kind == 2) {                                      // a sliver
      const Vector3 along = Difference(corners[1], corners[0]);
      corners[2] = Combination(corners[0], 0.3, along, 0, along);
    }
    for (const Vector3& corner : corners) mesh.positions.push_back(corner);
    mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

Comparison Compare(const TriangleMesh& a, const TriangleMesh& b, uint64_t samples,
                   parallel::Runner* runner) {
  const auto serial = parallel::MakeSerialRunner();
  parallel::Progress progress;
  Original original(a, "a.ply", runner != nullptr ? *runner : *serial, progress);
  return original.Against(b, "b.ply", samples);
}

}  // namespace folprom::measure
