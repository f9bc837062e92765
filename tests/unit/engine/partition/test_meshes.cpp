#include "test_meshes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace folprom::partition {
namespace {

void AddGridFaces(size_t first, size_t rows, size_t columns, TestMesh* mesh) {
  for (size_t row = 0; row + 1 < rows; ++row) {
    for (size_t column = 0; column + 1 < columns; ++column) {
      const uint64_t a = first + row * columns + column;
      mesh->triangles.push_back({a, a + 1, a + columns});
      mesh->triangles.push_back({a + 1, a + columns + 1, a + columns});
    }
  }
}

void Append(const TestMesh& part, double shift, TestMesh* mesh) {
  const uint64_t first = mesh->positions.size();
  for (const auto& position : part.positions) {
    mesh->positions.push_back({position[0] + shift, position[1], position[2]});
  }
  for (const io::Triangle& triangle : part.triangles) {
    mesh->triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
  }
}

size_t Blocks(size_t count, size_t size) { return (count + size - 1) / size; }

template <class T>
std::vector<size_t> ShuffledOrder(const std::vector<T>& items, TestRandom* random) {
  std::vector<size_t> order(items.size());
  std::iota(order.begin(), order.end(), size_t{0});
  for (size_t left = order.size(); left > 1; --left) {
    std::swap(order[left - 1], order[random->Below(left)]);
  }
  return order;
}

}  // namespace

double TestRandom::Next() { return static_cast<double>(Below(uint64_t{1} << 53)) * 0x1p-53; }

uint64_t TestRandom::Below(uint64_t bound) {
  state_ = state_ * 6364136223846793005u + 1442695040888963407u;
  return (state_ >> 11) % bound;
}

TestMesh WavySheet(size_t rows, size_t columns) {
  TestMesh mesh;
  for (size_t row = 0; row < rows; ++row) {
    for (size_t column = 0; column < columns; ++column) {
      const double x = static_cast<double>(column), y = static_cast<double>(row);
      mesh.positions.push_back({x, y, 6 * std::sin(x / 7) * std::cos(y / 9)});
    }
  }
  AddGridFaces(0, rows, columns, &mesh);
  return mesh;
}

TestMesh Sphere(size_t rings, size_t sectors) {
  TestMesh mesh;
  for (size_t ring = 0; ring < rings; ++ring) {
    for (size_t sector = 0; sector < sectors; ++sector) {
      const double polar = 3.14159 * (static_cast<double>(ring) + 0.5) / static_cast<double>(rings);
      const double around =
          6.28318 * static_cast<double>(sector) / static_cast<double>(sectors - 1);
      mesh.positions.push_back({std::sin(polar) * std::cos(around),
                                std::sin(polar) * std::sin(around), std::cos(polar)});
    }
  }
  AddGridFaces(0, rings, sectors, &mesh);
  return mesh;
}

TestMesh Line(size_t count) {
  TestMesh mesh;
  for (size_t i = 0; i < count; ++i) mesh.positions.push_back({0, 0, static_cast<double>(i)});
  return mesh;
}

TestMesh FlatPlane(size_t side) {
  TestMesh mesh = WavySheet(side, side);
  for (auto& position : mesh.positions) position[2] = -5;
  return mesh;
}

TestMesh Coincident(size_t count) {
  TestMesh mesh;
  mesh.positions.assign(count, {3, 4, 5});
  for (uint64_t i = 0; i + 2 < count; i += 2) mesh.triangles.push_back({i, i + 1, i + 2});
  return mesh;
}

TestMesh DenseSpot(size_t count) {
  TestRandom random(5);
  TestMesh mesh;
  for (size_t i = 0; i < count; ++i) {
    const double scale = i % 2 == 0 ? 1e-6 : 1;
    mesh.positions.push_back(
        {0.3 + scale * random.Next(), 0.3 + scale * random.Next(), 0.3 + scale * random.Next()});
  }
  for (uint64_t i = 0; i + 2 < count; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
  return mesh;
}

TestMesh TwoComponents() {
  const TestMesh sphere = Sphere(40, 50);
  TestMesh mesh;
  Append(sphere, 0, &mesh);
  Append(sphere, 100, &mesh);
  return mesh;
}

TestMesh Soup(size_t vertices, size_t triangles) {
  TestRandom random(11);
  TestMesh mesh;
  for (size_t i = 0; i < vertices; ++i) {
    if (i > 0 && i % 5 == 0) {
      mesh.positions.push_back(mesh.positions[random.Below(i)]);
    } else {
      mesh.positions.push_back({random.Next(), random.Next(), random.Next()});
    }
  }
  for (size_t i = 0; i < triangles; ++i) {
    io::Triangle corners{random.Below(vertices), random.Below(vertices), random.Below(vertices)};
    if (i % 7 == 1) corners[1] = corners[0];
    if (i % 7 == 2) corners = {corners[0], corners[0], corners[0]};
    mesh.triangles.push_back(i % 7 == 3 ? mesh.triangles.back() : corners);
  }
  return mesh;
}

TestMesh Shuffled(const TestMesh& mesh, uint64_t seed) {
  TestRandom random(seed);
  const std::vector<size_t> vertex_order = ShuffledOrder(mesh.positions, &random);
  const std::vector<size_t> face_order = ShuffledOrder(mesh.triangles, &random);
  TestMesh shuffled;
  std::vector<uint64_t> place(mesh.positions.size());
  for (size_t from : vertex_order) {
    place[from] = shuffled.positions.size();
    shuffled.positions.push_back(mesh.positions[from]);
  }
  for (size_t from : face_order) {
    const io::Triangle& corners = mesh.triangles[from];
    shuffled.triangles.push_back({place[corners[0]], place[corners[1]], place[corners[2]]});
  }
  return shuffled;
}

Lattice LatticeOf(const TestMesh& mesh, int bits) {
  Lattice lattice;
  if (mesh.positions.empty()) return lattice;
  Bounds box{mesh.positions[0], mesh.positions[0]};
  for (const auto& position : mesh.positions) {
    for (size_t axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], position[axis]);
      box.hi[axis] = std::max(box.hi[axis], position[axis]);
    }
  }
  lattice.origin = box.lo;
  if (box.longest() > 0) lattice.unit = box.longest() / ((1 << bits) - 1);
  for (size_t axis = 0; axis < 3; ++axis) {
    lattice.extent[axis] = static_cast<int32_t>((box.hi[axis] - box.lo[axis]) / lattice.unit + 0.5);
  }
  return lattice;
}

size_t TestSource::vertex_block_count() const {
  return Blocks(mesh_.positions.size(), block_size_);
}

uint64_t TestSource::vertex_block_begin(size_t block) const {
  return std::min(block * block_size_, mesh_.positions.size());
}

Result<void> TestSource::ReadVertexBlock(size_t block, std::vector<double>* xyz) const {
  xyz->clear();
  for (uint64_t i = vertex_block_begin(block); i < vertex_block_begin(block + 1); ++i) {
    xyz->insert(xyz->end(), mesh_.positions[i].begin(), mesh_.positions[i].end());
  }
  return {};
}

size_t TestSource::triangle_block_count() const {
  return Blocks(mesh_.triangles.size(), block_size_);
}

Result<void> TestSource::ReadFaces(size_t block, std::vector<io::Triangle>* triangles,
                                   std::vector<uint8_t>* joins) const {
  triangles->clear();
  const size_t end = std::min((block + 1) * block_size_, mesh_.triangles.size());
  for (size_t i = block * block_size_; i < end; ++i) triangles->push_back(mesh_.triangles[i]);
  if (joins != nullptr) joins->assign(triangles->size(), 0);
  return {};
}

}  // namespace folprom::partition
