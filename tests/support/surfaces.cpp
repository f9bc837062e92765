#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tests/support/random.h"

namespace folprom::support {
namespace {

constexpr double kTurn = 6.283185307179586;

/// Two triangles per cell of a grid whose columns, and rows where wanted, close up.
void AddCells(uint64_t columns, uint64_t rows, bool columns_close, bool rows_close, Mesh* mesh) {
  for (uint64_t r = 0; r + (rows_close ? 0 : 1) < rows; ++r) {
    for (uint64_t c = 0; c + (columns_close ? 0 : 1) < columns; ++c) {
      uint64_t right = (c + 1) % columns, up = (r + 1) % rows;
      uint64_t a = r * columns + c, b = r * columns + right;
      uint64_t d = up * columns + c, e = up * columns + right;
      mesh->faces.push_back({a, b, e});
      mesh->faces.push_back({a, e, d});
    }
  }
}

double Relief(const Point& p) {
  double height = 0, size = 0.12;
  for (double waves = 3; waves < 50; waves *= 2.3, size /= 2.5) {
    height +=
        size * std::sin(waves * p[0] + 1) * std::sin(waves * p[1] + 2) * std::cos(waves * p[2]);
  }
  return height;
}

double Distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

Mesh BumpySphere(uint64_t vertices, bool holes, uint64_t seed) {
  Random random(seed);
  uint64_t columns =
      std::max<uint64_t>(static_cast<uint64_t>(std::sqrt(2.0 * static_cast<double>(vertices))), 4);
  uint64_t rows = std::max<uint64_t>(vertices / columns, 3);
  Mesh mesh;
  std::vector<Point> directions;
  for (uint64_t r = 0; r < rows; ++r) {
    for (uint64_t c = 0; c < columns; ++c) {
      double latitude = (static_cast<double>(r) + random.Between(0.2, 0.8)) /
                        static_cast<double>(rows) * kTurn / 2;
      double longitude = (static_cast<double>(c) + random.Between(0.2, 0.8)) /
                         static_cast<double>(columns) * kTurn;
      Point p{std::sin(latitude) * std::cos(longitude), std::sin(latitude) * std::sin(longitude),
              std::cos(latitude)};
      directions.push_back(p);
      double radius = 1 + Relief(p);
      mesh.positions.push_back({radius * p[0], radius * p[1], radius * p[2]});
    }
  }
  AddCells(columns, rows, true, false, &mesh);
  if (!holes) return mesh;
  const Point centres[3] = {{1, 0, 0}, {-0.6, 0.8, 0}, {0, -0.6, 0.8}};
  std::erase_if(mesh.faces, [&](const Triple& face) {
    return std::any_of(std::begin(centres), std::end(centres), [&](const Point& centre) {
      return Distance(directions[face[0]], centre) < 0.3;
    });
  });
  return mesh;
}

Mesh Torus(uint64_t columns, uint64_t rows) {
  Mesh mesh;
  for (uint64_t r = 0; r < rows; ++r) {
    for (uint64_t c = 0; c < columns; ++c) {
      double u = kTurn * static_cast<double>(c) / static_cast<double>(columns);
      double v = kTurn * static_cast<double>(r) / static_cast<double>(rows);
      double reach = 3 + std::cos(v);
      mesh.positions.push_back({reach * std::cos(u), reach * std::sin(u), std::sin(v)});
    }
  }
  AddCells(columns, rows, true, true, &mesh);
  return mesh;
}

Mesh FlatGrid(uint64_t columns, uint64_t rows) {
  Mesh mesh;
  for (uint64_t r = 0; r < rows; ++r) {
    for (uint64_t c = 0; c < columns; ++c) {
      mesh.positions.push_back({static_cast<double>(c) / static_cast<double>(columns),
                                static_cast<double>(r) / static_cast<double>(rows), 0});
    }
  }
  AddCells(columns, rows, false, false, &mesh);
  return mesh;
}

Mesh IntegerTerrain(uint64_t columns, uint64_t rows, uint64_t seed) {
  Random random(seed);
  Mesh mesh;
  for (uint64_t r = 0; r < rows; ++r) {
    for (uint64_t c = 0; c < columns; ++c) {
      // Hills as tents of several widths, and noise.
      uint64_t height = random.Below(200);
      for (uint64_t width = 8; width <= 64; width *= 2) {
        uint64_t x = c % (2 * width), y = (r + width / 2) % (2 * width);
        height += 40 * (std::min(x, 2 * width - x) + std::min(y, 2 * width - y));
      }
      mesh.positions.push_back({static_cast<double>(1000 * c + random.Below(600)),
                                static_cast<double>(1000 * r + random.Below(600)),
                                static_cast<double>(height)});
    }
  }
  AddCells(columns, rows, false, false, &mesh);
  return mesh;
}

Mesh VoxelTerrain(uint64_t columns, uint64_t rows, uint64_t seed) {
  constexpr int64_t kVoxel = 1000;
  Mesh mesh = IntegerTerrain(columns, rows, seed);
  Random random(seed + 1);
  for (Point& position : mesh.positions) {
    const uint64_t free = random.Below(3);
    for (uint64_t axis = 0; axis < 3; ++axis) {
      const auto value = static_cast<int64_t>(position[axis]);
      if (axis != free)
        position[axis] = static_cast<double>((value + kVoxel / 2) / kVoxel * kVoxel);
    }
  }
  return mesh;
}

Mesh SubdividedTerrain(uint64_t columns, uint64_t rows, uint64_t seed) {
  const Mesh coarse = IntegerTerrain(columns, rows, seed);
  Mesh mesh;
  for (const Point& at : coarse.positions)
    mesh.positions.push_back({2 * at[0], 2 * at[1], 2 * at[2]});
  std::map<std::pair<uint64_t, uint64_t>, uint64_t> middles;
  const auto middle = [&](uint64_t a, uint64_t b) {
    const auto [found, is_new] =
        middles.try_emplace({std::min(a, b), std::max(a, b)}, mesh.positions.size());
    if (is_new) {
      const Point &p = coarse.positions[a], &q = coarse.positions[b];
      mesh.positions.push_back({p[0] + q[0], p[1] + q[1], p[2] + q[2]});
    }
    return found->second;
  };
  for (const auto& [a, b, c] : coarse.faces) {
    const uint64_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triple& face : {Triple{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
      mesh.faces.push_back(face);
    }
  }
  return mesh;
}

Mesh RangeGrid(uint64_t columns, uint64_t rows, uint64_t seed) {
  Random random(seed);
  const auto seen = [&](uint64_t c, uint64_t r) {
    const auto off = [](uint64_t a, uint64_t b) { return a > b ? a - b : b - a; };
    const uint64_t x = off(c % 23, 11), y = off(r % 29, 14);
    return x * x + y * y > 9 && random.Below(200) != 0;
  };
  std::vector<bool> present;
  Mesh grid, mesh;
  for (uint64_t r = 0; r < rows; ++r) {
    for (uint64_t c = 0; c < columns; ++c) {
      const uint64_t depth = 3 * (c * c + r * (rows - r)) + (2 * r > rows ? 40000 : 0);
      present.push_back(seen(c, r));
      grid.positions.push_back({static_cast<double>(1000 * c + 100 * r),
                                static_cast<double>(1000 * r + depth / 8),
                                static_cast<double>(depth + random.Below(200))});
    }
  }
  AddCells(columns, rows, false, false, &grid);
  std::vector<uint64_t> number(grid.positions.size(), ~uint64_t{0});
  for (Triple face : grid.faces) {
    bool whole = true;
    for (uint64_t v : face) whole = whole && present[v];
    // The jump of the depth lies between two rows.
    const auto far = [&](uint64_t v) { return 2 * (v / columns) > rows; };
    if (!whole || far(face[0]) != far(face[1]) || far(face[1]) != far(face[2])) continue;
    for (uint64_t& v : face) {
      if (number[v] == ~uint64_t{0}) {
        number[v] = mesh.positions.size();
        mesh.positions.push_back(grid.positions[v]);
      }
      v = number[v];
    }
    mesh.faces.push_back(face);
  }
  return mesh;
}

}  // namespace folprom::support
