#include "tests/support/attribute_ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "tests/support/files.h"
#include "tests/support/ply.h"
#include "tests/support/random.h"

namespace folprom::support {
namespace {

constexpr std::array<const char*, 8> kNames{"char", "uchar", "short", "ushort",
                                            "int",  "uint",  "float", "double"};

ScalarType TypeNamed(const std::string& name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) throw std::runtime_error("PLY type " + name);
  return static_cast<ScalarType>(found - kNames.begin());
}

template <class T>
void Append(std::string* bytes, T value) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof value);
}

void AppendRow(const Mesh& mesh, size_t vertex, size_t begin, size_t end, std::string* bytes) {
  for (size_t a = begin; a < end; ++a) {
    const size_t size = ScalarSize(mesh.attributes[a].type);
    bytes->append(reinterpret_cast<const char*>(&mesh.attributes[a].values[vertex * size]), size);
  }
}

/// Takes values from the front of a text.
class Front {
 public:
  Front(const std::string& bytes, size_t at) : bytes_(bytes), at_(at) {}
  const char* Take(size_t size) {
    if (bytes_.size() - at_ < size) throw std::runtime_error("PLY ends early");
    at_ += size;
    return bytes_.data() + at_ - size;
  }
  template <class T>
  T Value() {
    T value;
    std::memcpy(&value, Take(sizeof value), sizeof value);
    return value;
  }
  bool AtEnd() const { return at_ == bytes_.size(); }

 private:
  const std::string& bytes_;
  size_t at_;
};

template <class T>
T Special(Random& random) {
  using Limits = std::numeric_limits<T>;
  switch (random.Below(8)) {
    case 0:
      return Limits::max();
    case 1:
      return Limits::lowest();
    case 2:
      return T{};
    case 3:
      return Limits::min();
    default:
      break;
  }
  if constexpr (std::is_floating_point_v<T>) {
    using Bits = std::conditional_t<sizeof(T) == 4, uint32_t, uint64_t>;
    switch (random.Below(5)) {
      case 0:
        return -T{};
      case 1:
        return Limits::infinity();
      case 2:
        return -Limits::infinity();
      case 3:
        return Limits::denorm_min();
      default:
        // Any bits at all under the exponent of a NaN, quiet or not, of either sign.
        return std::bit_cast<T>(static_cast<Bits>(
            std::bit_cast<Bits>(random.Below(2) == 0 ? Limits::infinity() : -Limits::infinity()) |
            (random.Next() & (sizeof(T) == 4 ? 0x7fffffu : 0xfffffffffffffu)) | 1u));
    }
  }
  return static_cast<T>(random.Next());
}

template <class T>
DecodedAttribute Smooth(const char* name, ScalarType type, const Mesh& mesh, uint64_t seed) {
  Random random(seed);
  DecodedAttribute attribute{name, type, {}};
  for (const Point& p : mesh.positions) {
    if (random.Below(10) == 0) {
      AppendValue(Special<T>(random), &attribute);
    } else {
      const double value = 40 + 0.01 * (p[0] - p[2]) + random.Between(0, 20);
      AppendValue(static_cast<T>(std::isfinite(value) ? std::fmod(std::fabs(value), 120) : 0),
                  &attribute);
    }
  }
  return attribute;
}

}  // namespace

void WriteAttributes(const std::string& path, const AttributeMesh& content) {
  const Mesh& mesh = content.mesh;
  std::string bytes = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : content.comments) bytes += comment + "\n";
  bytes += "element vertex " + std::to_string(mesh.positions.size()) + "\n";
  for (size_t a = 0; a <= mesh.attributes.size(); ++a) {
    if (a == content.before_position) {
      bytes += "property double x\nproperty double y\nproperty double z\n";
    }
    if (a == mesh.attributes.size()) break;
    bytes += std::string("property ") + kNames[static_cast<size_t>(mesh.attributes[a].type)] + " " +
             mesh.attributes[a].name + "\n";
  }
  bytes += "element face " + std::to_string(mesh.faces.size()) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    AppendRow(mesh, v, 0, content.before_position, &bytes);
    for (double value : mesh.positions[v]) Append(&bytes, value);
    AppendRow(mesh, v, content.before_position, mesh.attributes.size(), &bytes);
  }
  WriteBytes(path, bytes + FaceBytes(mesh));
}

AttributeMesh ReadAttributes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::string end = "end_header\n";
  const size_t found = bytes.find(end);
  if (found == std::string::npos) throw std::runtime_error("no PLY: " + path);
  AttributeMesh content;
  std::istringstream lines(bytes.substr(0, found));
  std::string line, element, coordinate;
  size_t vertices = 0, faces = 0;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first == "comment" || first == "obj_info") content.comments.push_back(line);
    if (first == "element") (second == "vertex" ? vertices : faces) = std::stoull(third);
    if (first == "element") element = second;
    if (first != "property" || element != "vertex") continue;
    if (third == "x") {
      content.before_position = content.mesh.attributes.size();
      coordinate = second;
    } else if (third != "y" && third != "z") {
      content.mesh.attributes.push_back({third, TypeNamed(second), {}});
    }
  }
  Front front(bytes, found + end.size());
  std::vector<DecodedAttribute>& attributes = content.mesh.attributes;
  for (size_t v = 0; v < vertices; ++v) {
    for (size_t a = 0; a <= attributes.size(); ++a) {
      if (a == content.before_position) {
        Point& point = content.mesh.positions.emplace_back();
        for (double& value : point) {
          value = coordinate == "double" ? front.Value<double>()
                                         : static_cast<double>(front.Value<float>());
        }
      }
      if (a == attributes.size()) break;
      const size_t size = ScalarSize(attributes[a].type);
      const char* value = front.Take(size);
      attributes[a].values.insert(attributes[a].values.end(), value, value + size);
    }
  }
  for (size_t f = 0; f < faces; ++f) {
    if (front.Value<uint8_t>() != 3) throw std::runtime_error("a face is no triangle");
    Triple& face = content.mesh.faces.emplace_back();
    for (uint64_t& index : face) index = static_cast<uint64_t>(front.Value<int32_t>());
  }
  if (!front.AtEnd()) throw std::runtime_error("bytes after the end of the PLY");
  return content;
}

std::vector<std::string> SortedVertices(const Mesh& mesh) {
  std::vector<std::string> vertices(mesh.positions.size());
  for (size_t v = 0; v < vertices.size(); ++v) {
    for (double value : mesh.positions[v]) Append(&vertices[v], value);
    AppendRow(mesh, v, 0, mesh.attributes.size(), &vertices[v]);
  }
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

std::vector<std::string> AttributeRows(const Mesh& mesh) {
  std::vector<std::string> rows(mesh.positions.size());
  for (size_t v = 0; v < rows.size(); ++v) AppendRow(mesh, v, 0, mesh.attributes.size(), &rows[v]);
  return rows;
}

std::vector<DecodedAttribute> EveryType(const Mesh& mesh, uint64_t seed) {
  return {Smooth<int8_t>("a_char", ScalarType::kInt8, mesh, seed),
          Smooth<uint8_t>("a_uchar", ScalarType::kUint8, mesh, seed + 1),
          Smooth<int16_t>("a_short", ScalarType::kInt16, mesh, seed + 2),
          Smooth<uint16_t>("a_ushort", ScalarType::kUint16, mesh, seed + 3),
          Smooth<int32_t>("an_int", ScalarType::kInt32, mesh, seed + 4),
          Smooth<uint32_t>("a_uint", ScalarType::kUint32, mesh, seed + 5),
          Smooth<float>("a_float", ScalarType::kFloat32, mesh, seed + 6),
          Smooth<double>("a_double", ScalarType::kFloat64, mesh, seed + 7)};
}

std::vector<DecodedAttribute> Colours(const Mesh& mesh, uint64_t seed) {
  Random random(seed);
  std::vector<DecodedAttribute> colours;
  for (const char* name : {"red", "green", "blue", "alpha"}) {
    colours.push_back({name, ScalarType::kUint8, {}});
  }
  for (const Point& p : mesh.positions) {
    const auto x = static_cast<int64_t>(p[0]), y = static_cast<int64_t>(p[1]);
    const int64_t light = 100 + (x / 64 + y / 96) % 60 + static_cast<int64_t>(random.Below(8));
    for (size_t c = 0; c < 3; ++c) {
      const int64_t value =
          light + 20 * static_cast<int64_t>(c) + static_cast<int64_t>(random.Below(3));
      AppendValue(static_cast<uint8_t>(std::clamp<int64_t>(value, 0, 255)), &colours[c]);
    }
    AppendValue(uint8_t{255}, &colours[3]);
  }
  return colours;
}

}  // namespace folprom::support
