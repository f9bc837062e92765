#include "tests/order/plain_mesh.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace folprom::support {
namespace {

std::string Content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("no file " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

size_t SizeOf(const std::string& type) {
  for (const char* name : {"char", "uchar", "int8", "uint8"}) {
    if (type == name) return 1;
  }
  for (const char* name : {"short", "ushort", "int16", "uint16"}) {
    if (type == name) return 2;
  }
  for (const char* name : {"int", "uint", "int32", "uint32", "float", "float32"}) {
    if (type == name) return 4;
  }
  if (type == "double" || type == "float64") return 8;
  throw std::runtime_error("type " + type);
}

template <class T>
std::string BytesOf(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// A decimal as the bytes of a type.
std::string Parsed(const std::string& word, const std::string& type) {
  if (type == "float" || type == "float32") return BytesOf(std::strtof(word.c_str(), nullptr));
  if (type == "double" || type == "float64") return BytesOf(std::strtod(word.c_str(), nullptr));
  return BytesOf(std::strtoll(word.c_str(), nullptr, 10)).substr(0, SizeOf(type));
}

struct Property {
  std::string type, name, count_type;  ///< no list where that is empty
};
struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  explicit PlyReader(std::string content) : content_(std::move(content)), in_(content_) {}

  PlainMesh Read() {
    ReadHeader();
    PlainMesh mesh;
    for (const Element& element : elements_) {
      for (uint64_t i = 0; i < element.count; ++i) ReadRecord(element, &mesh);
    }
    return mesh;
  }

 private:
  void ReadHeader() {
    std::string line, word;
    while (std::getline(in_, line)) {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      std::istringstream words(line);
      words >> word;
      if (word == "format") words >> format_;
      if (word == "element") {
        elements_.emplace_back();
        words >> elements_.back().name >> elements_.back().count;
      }
      if (word == "property") {
        Property property;
        words >> property.type;
        if (property.type == "list") words >> property.count_type >> property.type;
        words >> property.name;
        elements_.back().properties.push_back(property);
      }
      if (word == "end_header") return;
    }
    throw std::runtime_error("no end of the header");
  }

  void ReadRecord(const Element& element, PlainMesh* mesh) {
    std::string scalars;
    std::vector<std::string> lists;
    for (const Property& property : element.properties) {
      if (property.count_type.empty()) {
        scalars += Value(property.type);
        continue;
      }
      const auto count = static_cast<size_t>(Integer(property.count_type));
      if (property.name == "vertex_indices" || property.name == "vertex_index") {
        std::vector<int64_t> items(count);
        for (int64_t& item : items) item = Integer(property.type);
        if (element.name == "face") mesh->faces.push_back(std::move(items));
        continue;
      }
      std::string bytes;
      for (size_t i = 0; i < count; ++i) bytes += Value(property.type);
      lists.push_back(bytes);
    }
    if (element.name == "vertex") mesh->vertices.push_back(scalars);
    if (element.name == "face") {
      mesh->face_scalars.push_back(scalars);
      mesh->face_lists.push_back(lists);
    }
  }

  std::string Value(const std::string& type) {
    if (format_ == "ascii") {
      std::string word;
      in_ >> word;
      return Parsed(word, type);
    }
    std::string bytes(SizeOf(type), '\0');
    if (!in_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
      throw std::runtime_error("the file ends early");
    }
    if (format_ == "binary_big_endian") std::reverse(bytes.begin(), bytes.end());
    return bytes;
  }

  int64_t Integer(const std::string& type) {
    const std::string bytes = Value(type);
    uint64_t value = 0;
    for (size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<uint8_t>(bytes[i]);
    return static_cast<int64_t>(value);
  }

  std::string content_;
  std::istringstream in_;
  std::string format_;
  std::vector<Element> elements_;
};

std::string Position(std::istream& in) {
  std::string bytes, word;
  for (int axis = 0; axis < 3; ++axis) {
    in >> word;
    bytes += Parsed(word, "float");
  }
  return bytes;
}

PlainMesh ReadObj(const std::string& content) {
  PlainMesh mesh;
  std::istringstream lines(content);
  for (std::string line; std::getline(lines, line);) {
    // A backslash joins the next line.
    while (!line.empty() && line.find_last_not_of("\r") != std::string::npos &&
           line[line.find_last_not_of("\r")] == '\\') {
      line.erase(line.find_last_not_of("\r"));
      std::string next;
      std::getline(lines, next);
      line += " " + next;
    }
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") mesh.vertices.push_back(Position(words));
    if (word != "f") continue;
    std::vector<int64_t> face;
    while (words >> word) face.push_back(std::stoll(word) - 1);
    mesh.faces.push_back(face);
  }
  return mesh;
}

PlainMesh ReadOff(const std::string& content) {
  std::string text;
  std::istringstream lines(content);
  for (std::string line; std::getline(lines, line);) text += line.substr(0, line.find('#')) + "\n";
  std::istringstream in(text);
  std::string word;
  uint64_t vertices = 0, faces = 0, edges = 0;
  in >> word >> vertices >> faces >> edges;
  PlainMesh mesh;
  for (uint64_t i = 0; i < vertices; ++i) mesh.vertices.push_back(Position(in));
  for (uint64_t i = 0; i < faces; ++i) {
    size_t corners = 0;
    in >> corners;
    std::vector<int64_t> face(corners);
    for (int64_t& corner : face) in >> corner;
    std::getline(in, word);
    mesh.faces.push_back(face);
  }
  return mesh;
}

PlainMesh ReadStl(const std::string& content) {
  PlainMesh mesh;
  for (size_t facet = 84; facet + 50 <= content.size(); facet += 50) {
    const auto first = static_cast<int64_t>(mesh.vertices.size());
    for (size_t corner = 1; corner < 4; ++corner) {
      mesh.vertices.push_back(content.substr(facet + 12 * corner, 12));
    }
    mesh.faces.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace

PlainMesh ReadPlain(const std::string& path) {
  std::string content = Content(path);
  if (path.ends_with(".obj")) return ReadObj(content);
  if (path.ends_with(".off")) return ReadOff(content);
  if (path.ends_with(".stl")) return ReadStl(content);
  return PlyReader(std::move(content)).Read();
}

std::vector<std::vector<int64_t>> FacesAsSet(std::vector<std::vector<int64_t>> faces) {
  for (std::vector<int64_t>& face : faces) {
    std::vector<int64_t> turned = face, least = face;
    for (size_t i = 0; i < face.size(); ++i) {
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
      least = std::min(least, turned);
    }
    face = least;
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

}  // namespace folprom::support
