#include "tests/support/ply.h"

#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "tests/support/files.h"

namespace folprom::support {
namespace {

static_assert(std::endian::native == std::endian::little);

struct Property {
  std::string type;
  std::string name;
};

size_t SizeOf(const std::string& type) {
  if (type == "char" || type == "uchar") return 1;
  if (type == "short" || type == "ushort") return 2;
  if (type == "int" || type == "uint" || type == "float") return 4;
  if (type == "double") return 8;
  throw std::runtime_error("PLY type " + type + " is not known to the tests");
}

template <class T>
void Append(std::string* bytes, T value) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The bytes after the header.
class Body {
 public:
  Body(const std::string& bytes, size_t position) : bytes_(bytes), position_(position) {}
  double Number(const std::string& type) {
    if (type == "float") return static_cast<double>(Take<float>());
    if (type == "double") return Take<double>();
    if (type == "int") return static_cast<double>(Take<int32_t>());
    if (type == "uint") return static_cast<double>(Take<uint32_t>());
    if (type == "short") return static_cast<double>(Take<int16_t>());
    if (type == "uchar") return static_cast<double>(Take<uint8_t>());
    position_ += SizeOf(type);
    return 0;
  }
  bool AtEnd() const { return position_ == bytes_.size(); }

 private:
  template <class T>
  T Take() {
    if (bytes_.size() - position_ < sizeof(T)) throw std::runtime_error("PLY ends early");
    T value;
    std::memcpy(&value, bytes_.data() + position_, sizeof value);
    position_ += sizeof value;
    return value;
  }
  const std::string& bytes_;
  size_t position_;
};

struct Header {
  uint64_t vertices = 0, faces = 0;
  std::vector<Property> properties;  ///< of a vertex
  std::string count_type, index_type;
  size_t size = 0;
};

Header ReadHeader(const std::string& bytes) {
  const std::string end = "end_header\n";
  size_t found = bytes.find(end);
  if (found == std::string::npos) throw std::runtime_error("no end of the PLY header");
  Header header;
  header.size = found + end.size();
  std::istringstream lines(bytes.substr(0, found));
  std::string line, element;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first == "format" && second != "binary_little_endian") {
      throw std::runtime_error("PLY format " + second + " is not known to the tests");
    }
    if (first == "element") {
      element = second;
      (element == "vertex" ? header.vertices : header.faces) = std::stoull(third);
    } else if (first == "property" && element == "vertex") {
      header.properties.push_back({second, third});
    } else if (first == "property") {
      header.count_type = third;
      words >> header.index_type;
    }
  }
  return header;
}

}  // namespace

std::string FaceBytes(const Mesh& mesh) {
  std::string bytes;
  for (const Triple& face : mesh.faces) {
    bytes.push_back(3);
    for (uint64_t index : face) Append(&bytes, static_cast<int32_t>(index));
  }
  return bytes;
}

void WritePly(const std::string& path, const Mesh& mesh, CoordinateType type) {
  const char* names[] = {"short", "int", "float", "double"};
  std::string name = names[static_cast<int>(type)];
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(mesh.positions.size()) + "\nproperty " + name +
                      " x\nproperty " + name + " y\nproperty " + name + " z\nelement face " +
                      std::to_string(mesh.faces.size()) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Point& point : mesh.positions) {
    for (double value : point) {
      switch (type) {
        case CoordinateType::kShort:
          Append(&bytes, static_cast<int16_t>(value));
          break;
        case CoordinateType::kInt:
          Append(&bytes, static_cast<int32_t>(value));
          break;
        case CoordinateType::kFloat:
          Append(&bytes, static_cast<float>(value));
          break;
        case CoordinateType::kDouble:
          Append(&bytes, value);
          break;
      }
    }
  }
  WriteBytes(path, bytes + FaceBytes(mesh));
}

PlyContent ReadPly(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  Header header = ReadHeader(bytes);
  Body body(bytes, header.size);
  PlyContent content;
  content.mesh.positions.resize(header.vertices);
  for (Point& point : content.mesh.positions) {
    for (const Property& property : header.properties) {
      double value = body.Number(property.type);
      size_t axis = property.name == "x"   ? 0
                    : property.name == "y" ? 1
                    : property.name == "z" ? 2
                                           : 3;
      if (axis == 3) continue;
      point[axis] = value;
      content.coordinate_type = property.type;
    }
  }
  content.mesh.faces.resize(header.faces);
  for (Triple& face : content.mesh.faces) {
    if (body.Number(header.count_type) != 3) throw std::runtime_error("a face is no triangle");
    for (uint64_t& index : face) {
      double value = body.Number(header.index_type);
      if (!(value >= 0 && value < static_cast<double>(header.vertices))) {
        throw std::runtime_error("a face names no vertex");
      }
      index = static_cast<uint64_t>(value);
    }
  }
  if (!body.AtEnd()) throw std::runtime_error("bytes after the end of the PLY");
  if (header.vertices == 0) content.coordinate_type = header.properties.at(0).type;
  return content;
}

}  // namespace folprom::support
