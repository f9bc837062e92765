// Meshes that the tests make themselves, and a scan in memory in place of a file.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/mesh/lattice.h"
#include "io/formats/mesh_source.h"

namespace folprom::partition {

struct TestMesh {
  std::vector<std::array<double, 3>> positions;
  std::vector<io::Triangle> triangles;
};

/// Numbers in [0, 1), the same on every machine.
class TestRandom {
 public:
  explicit TestRandom(uint64_t seed) : state_(seed) {}
  double Next();
  uint64_t Below(uint64_t bound);

 private:
  uint64_t state_;
};

/// rows x columns vertices of a wavy, closed or open sheet.
TestMesh WavySheet(size_t rows, size_t columns);
TestMesh Sphere(size_t rings, size_t sectors);
/// No faces.
TestMesh Line(size_t count);
TestMesh FlatPlane(size_t side);
TestMesh Coincident(size_t count);
/// Half of the vertices in a millionth of the box.
TestMesh DenseSpot(size_t count);
/// Two spheres far apart.
TestMesh TwoComponents();
/// Random vertices with duplicates; random faces, also degenerate and duplicate ones.
TestMesh Soup(size_t vertices, size_t triangles);
TestMesh Shuffled(const TestMesh& mesh, uint64_t seed);

/// The lattice of `bits` bits that spans the mesh.
Lattice LatticeOf(const TestMesh& mesh, int bits);

/// The mesh in blocks of at most `block_size` records.
class TestSource final : public io::MeshSource {
 public:
  explicit TestSource(TestMesh mesh, size_t block_size = 97)
      : mesh_(std::move(mesh)), block_size_(block_size) {}

  const TestMesh& mesh() const { return mesh_; }
  const std::string& path() const override { return path_; }
  uint64_t vertex_count() const override { return mesh_.positions.size(); }
  uint64_t triangle_count() const override { return mesh_.triangles.size(); }
  ScalarType coordinate_type() const override { return ScalarType::kFloat64; }
  size_t vertex_block_count() const override;
  uint64_t vertex_block_begin(size_t block) const override;
  Result<void> ReadVertexBlock(size_t block, std::vector<double>* xyz) const override;
  size_t triangle_block_count() const override;
  const io::SourceNotes& notes() const override { return notes_; }
  void DropResident() const override {}

 private:
  Result<void> ReadFaces(size_t block, std::vector<io::Triangle>* triangles,
                         std::vector<uint8_t>* joins) const override;

  const TestMesh mesh_;
  const size_t block_size_;
  const std::string path_ = "memory.ply";
  const io::SourceNotes notes_;
};

}  // namespace folprom::partition
