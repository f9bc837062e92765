#include "tests/bench/peers/mesh_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include "folprom/result.h"
#include "io/formats/mesh_source.h"

namespace folprom::peers {
namespace {

static_assert(std::endian::native == std::endian::little);

std::unique_ptr<io::MeshSource> Open(const std::string& path) {
  auto source = io::MeshSource::Open(path).value();
  if (source->vertex_count() >= std::numeric_limits<uint32_t>::max()) {
    throw Failure(ErrorKind::kLimit, path + ": too many vertices to compare programs on");
  }
  return source;
}

template <class T>
void Append(std::vector<uint8_t>* bytes, const T& value) {
  const size_t end = bytes->size();
  bytes->resize(end + sizeof value);
  std::memcpy(bytes->data() + end, &value, sizeof value);
}

}  // namespace

Mesh ReadMesh(const std::string& path) {
  const auto source = Open(path);
  Mesh mesh;
  mesh.positions.reserve(source->vertex_count());
  std::vector<double> xyz;
  for (size_t block = 0; block < source->vertex_block_count(); ++block) {
    source->ReadVertexBlock(block, &xyz).value();
    for (size_t i = 0; i < xyz.size(); i += 3) {
      mesh.positions.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
    }
  }
  mesh.faces.reserve(source->triangle_count());
  std::vector<io::Triangle> triangles;
  for (size_t block = 0; block < source->triangle_block_count(); ++block) {
    source->ReadTriangleBlock(block, &triangles).value();
    for (const io::Triangle& t : triangles) {
      mesh.faces.push_back(
          {static_cast<uint32_t>(t[0]), static_cast<uint32_t>(t[1]), static_cast<uint32_t>(t[2])});
    }
  }
  return mesh;
}

ScanSize MeasureScan(const std::string& path) {
  const auto source = Open(path);
  ScanSize size;
  size.vertices = source->vertex_count();
  size.faces = source->triangle_count();
  Point lo, hi;
  lo.fill(std::numeric_limits<double>::infinity());
  hi.fill(-std::numeric_limits<double>::infinity());
  std::vector<double> xyz;
  for (size_t block = 0; block < source->vertex_block_count(); ++block) {
    source->ReadVertexBlock(block, &xyz).value();
    for (size_t i = 0; i < xyz.size(); ++i) {
      lo[i % 3] = std::min(lo[i % 3], xyz[i]);
      hi[i % 3] = std::max(hi[i % 3], xyz[i]);
      size.largest_coordinate = std::max(size.largest_coordinate, std::fabs(xyz[i]));
    }
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    size.longest_side = std::max(size.longest_side, hi[axis] - lo[axis]);
  }
  if (!(size.longest_side > 0) || size.faces == 0) {
    throw Failure(ErrorKind::kInput, path + ": no surface to measure");
  }
  return size;
}

void WriteMesh(const std::string& path, const Mesh& mesh) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex " +
      std::to_string(mesh.positions.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(mesh.faces.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  std::vector<uint8_t> bytes(header.begin(), header.end());
  bytes.reserve(bytes.size() + 12 * mesh.positions.size() + 13 * mesh.faces.size());
  for (const Point& point : mesh.positions) {
    for (const double value : point) Append(&bytes, static_cast<float>(value));
  }
  for (const Triple& face : mesh.faces) {
    bytes.push_back(3);
    Append(&bytes, face);
  }
  WriteBytes(path, bytes);
}

std::vector<uint8_t> ReadBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw Failure(ErrorKind::kInput, path + ": cannot be read");
  std::vector<uint8_t> bytes(static_cast<size_t>(file.tellg()));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw Failure(ErrorKind::kInput, path + ": cannot be read");
  return bytes;
}

void WriteBytes(const std::string& path, const std::vector<uint8_t>& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw Failure(ErrorKind::kOutput, path + ": cannot be written");
}

}  // namespace folprom::peers
