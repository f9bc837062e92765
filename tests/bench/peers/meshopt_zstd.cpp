// The peer "meshoptimizer + zstd" as a program, made as its users make it: triangles in strip-like
// order for the vertex cache, vertices in the order of their use, positions rounded to a lattice,
// both buffers through meshoptimizer's codecs, the whole through zstd.
//   peer_meshopt_zstd encode SCAN.ply FILE BITS
//   peer_meshopt_zstd decode FILE MESH.ply
#include <meshoptimizer.h>
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "folprom/result.h"
#include "tests/bench/peers/mesh_file.h"

namespace folprom::peers {
namespace {

constexpr int kZstdLevel = 19;
/// x, y, z and a filler: the vertex codec wants a multiple of four bytes.
using LatticePoint = std::array<uint16_t, 4>;

struct Header {
  uint32_t vertices = 0;
  uint32_t indices = 0;
  uint32_t index_bytes = 0;
  uint32_t vertex_bytes = 0;
  double origin[3] = {};
  double step = 0;  ///< model units
};

std::vector<unsigned> StripOrder(const Mesh& mesh) {
  const size_t count = 3 * mesh.faces.size();
  std::vector<unsigned> indices(count);
  meshopt_optimizeVertexCacheStrip(indices.data(), mesh.faces.front().data(), count,
                                   mesh.positions.size());
  return indices;
}

// Vertices that no face uses come last, so that none is lost.
std::vector<unsigned> FetchOrder(const std::vector<unsigned>& indices, size_t vertices) {
  std::vector<unsigned> place(vertices);
  size_t next =
      meshopt_optimizeVertexFetchRemap(place.data(), indices.data(), indices.size(), vertices);
  for (unsigned& p : place) {
    if (p == ~0U) p = static_cast<unsigned>(next++);
  }
  return place;
}

std::vector<LatticePoint> Rounded(const Mesh& mesh, const std::vector<unsigned>& place, int bits,
                                  Header* header) {
  double side = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto [lo, hi] =
        std::minmax_element(mesh.positions.begin(), mesh.positions.end(),
                            [&](const Point& a, const Point& b) { return a[axis] < b[axis]; });
    header->origin[axis] = (*lo)[axis];
    side = std::max(side, (*hi)[axis] - (*lo)[axis]);
  }
  header->step = side / ((1 << bits) - 1);
  std::vector<LatticePoint> points(mesh.positions.size());
  for (size_t v = 0; v < points.size(); ++v) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double steps = (mesh.positions[v][axis] - header->origin[axis]) / header->step;
      points[place[v]][axis] = static_cast<uint16_t>(std::lround(steps));
    }
  }
  return points;
}

void Encode(const std::string& scan, const std::string& output, int bits) {
  const Mesh mesh = ReadMesh(scan);
  const size_t vertices = mesh.positions.size();
  std::vector<unsigned> indices = StripOrder(mesh);
  const std::vector<unsigned> place = FetchOrder(indices, vertices);
  meshopt_remapIndexBuffer(indices.data(), indices.data(), indices.size(), place.data());
  Header header;
  const std::vector<LatticePoint> points = Rounded(mesh, place, bits, &header);

  meshopt_encodeIndexVersion(1);
  std::vector<uint8_t> bytes(sizeof header +
                             meshopt_encodeIndexBufferBound(indices.size(), vertices) +
                             meshopt_encodeVertexBufferBound(vertices, sizeof(LatticePoint)));
  const size_t index_bytes = meshopt_encodeIndexBuffer(
      bytes.data() + sizeof header, bytes.size() - sizeof header, indices.data(), indices.size());
  const size_t vertex_at = sizeof header + index_bytes;
  const size_t vertex_bytes =
      meshopt_encodeVertexBuffer(bytes.data() + vertex_at, bytes.size() - vertex_at, points.data(),
                                 vertices, sizeof(LatticePoint));
  header.vertices = static_cast<uint32_t>(vertices);
  header.indices = static_cast<uint32_t>(indices.size());
  header.index_bytes = static_cast<uint32_t>(index_bytes);
  header.vertex_bytes = static_cast<uint32_t>(vertex_bytes);
  std::memcpy(bytes.data(), &header, sizeof header);
  bytes.resize(vertex_at + vertex_bytes);

  std::vector<uint8_t> packed(ZSTD_compressBound(bytes.size()));
  const size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kZstdLevel);
  if (ZSTD_isError(size)) throw Failure(ErrorKind::kInternal, ZSTD_getErrorName(size));
  packed.resize(size);
  WriteBytes(output, packed);
}

std::vector<uint8_t> Unpacked(const std::string& input) {
  const std::vector<uint8_t> packed = ReadBytes(input);
  const auto size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN) {
    throw Failure(ErrorKind::kCorrupt, input + ": no zstd frame");
  }
  std::vector<uint8_t> bytes(size);
  const size_t got = ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) || got != size || size < sizeof(Header)) {
    throw Failure(ErrorKind::kCorrupt, input + ": damaged");
  }
  return bytes;
}

void Decode(const std::string& input, const std::string& output) {
  const std::vector<uint8_t> bytes = Unpacked(input);
  Header header;
  std::memcpy(&header, bytes.data(), sizeof header);
  if (bytes.size() != sizeof header + header.index_bytes + size_t{header.vertex_bytes} ||
      header.indices % 3 != 0) {
    throw Failure(ErrorKind::kCorrupt, input + ": damaged");
  }
  Mesh mesh;
  mesh.faces.resize(header.indices / 3);
  std::vector<LatticePoint> points(header.vertices);
  const uint8_t* at = bytes.data() + sizeof header;
  if (meshopt_decodeIndexBuffer(mesh.faces.data(), header.indices, sizeof(unsigned), at,
                                header.index_bytes) != 0 ||
      meshopt_decodeVertexBuffer(points.data(), points.size(), sizeof(LatticePoint),
                                 at + header.index_bytes, header.vertex_bytes) != 0) {
    throw Failure(ErrorKind::kCorrupt, input + ": damaged");
  }
  mesh.positions.reserve(points.size());
  for (const LatticePoint& p : points) {
    mesh.positions.push_back({header.origin[0] + p[0] * header.step,
                              header.origin[1] + p[1] * header.step,
                              header.origin[2] + p[2] * header.step});
  }
  WriteMesh(output, mesh);
}

int Main(const std::vector<std::string>& words) {
  if (words.size() == 5 && words[1] == "encode") {
    const int bits = std::stoi(words[4]);
    if (bits < 1 || bits > 16) throw Failure(ErrorKind::kUsage, "BITS is not within 1 .. 16");
    Encode(words[2], words[3], bits);
  } else if (words.size() == 4 && words[1] == "decode") {
    Decode(words[2], words[3]);
  } else {
    throw Failure(ErrorKind::kUsage, "encode SCAN.ply FILE BITS | decode FILE MESH.ply");
  }
  return 0;
}

}  // namespace
}  // namespace folprom::peers

int main(int argc, char** argv) {
  try {
    return folprom::peers::Main({argv, argv + argc});
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "peer_meshopt_zstd: %s\n", fault.what());
    return 1;
  }
}
