#include "tests/support/bit_mesh.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <utility>

#include "folprom/float_bits.h"
#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"

namespace folprom::support {
namespace {

using Corners = std::array<Bits3, 3>;

/// The smallest of all rotations, also where corners coincide.
Corners Turned(const Corners& face) {
  const auto [a, b, c] = face;
  return std::min({face, Corners{b, c, a}, Corners{c, a, b}});
}

std::pair<std::vector<Bits3>, std::vector<Corners>> Sorted(const BitMesh& mesh) {
  std::vector<Bits3> positions = mesh.positions;
  std::vector<Corners> faces;
  for (const Triple& f : mesh.faces) {
    faces.push_back(Turned({positions[f[0]], positions[f[1]], positions[f[2]]}));
  }
  std::sort(positions.begin(), positions.end());
  std::sort(faces.begin(), faces.end());
  return {positions, faces};
}

}  // namespace

void WriteBits(const std::string& path, const BitMesh& mesh) {
  const std::string type = mesh.is_float ? "float" : "double";
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(mesh.positions.size()) + "\nproperty " + type +
                      " x\nproperty " + type + " y\nproperty " + type + " z\nelement face " +
                      std::to_string(mesh.faces.size()) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
  const auto append = [&](uint64_t value, size_t size) {
    bytes.append(reinterpret_cast<const char*>(&value), size);
  };
  for (const Bits3& position : mesh.positions) {
    for (uint64_t value : position) append(value, mesh.is_float ? 4 : 8);
  }
  for (const Triple& face : mesh.faces) {
    bytes.push_back(3);
    for (uint64_t index : face) append(index, 4);
  }
  std::ofstream(path, std::ios::binary) << bytes;
}

BitMesh ReadBits(const std::string& path) {
  const PlyContent content = ReadPly(path);
  const std::vector<uint8_t> bytes = FileBytes(path);
  BitMesh mesh{content.coordinate_type == "float", {}, content.mesh.faces};
  const std::string end = "end_header\n";
  const auto header = std::search(bytes.begin(), bytes.end(), end.begin(), end.end());
  const uint8_t* at = bytes.data() + (header - bytes.begin()) + end.size();
  const size_t size = mesh.is_float ? 4 : 8;
  mesh.positions.resize(content.mesh.positions.size());
  for (Bits3& position : mesh.positions) {
    for (uint64_t& value : position) {
      value = 0;
      std::memcpy(&value, at, size);
      at += size;
    }
  }
  return mesh;
}

BitMesh BitsFromMemory(const std::string& folp) {
  const Mesh decoded = LodOf(folp);
  BitMesh mesh{decoded.is_float, {}, decoded.faces};
  for (const Point& p : decoded.positions) {
    Bits3 bits = std::bit_cast<Bits3>(p);
    for (size_t axis = 0; decoded.is_float && axis < 3; ++axis) {
      bits[axis] = NarrowToFloatBits(p[axis]);
    }
    mesh.positions.push_back(bits);
  }
  return mesh;
}

std::string DifferenceOfBits(const BitMesh& a, const BitMesh& b) {
  if (a.is_float != b.is_float) return "one has floats, the other doubles";
  const auto sorted_a = Sorted(a), sorted_b = Sorted(b);
  if (sorted_a.first != sorted_b.first) return "positions differ";
  return sorted_a.second == sorted_b.second ? "" : "faces differ";
}

EncodeOptions ExactOptions(uint32_t subtree_vertices) {
  EncodeOptions options;
  options.exact = true;
  options.codec.subtree_vertices = subtree_vertices;
  return options;
}

}  // namespace folprom::support
