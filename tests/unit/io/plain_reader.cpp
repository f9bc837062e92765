#include "plain_reader.h"

#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace folprom::io::testing {
namespace {

double Value(const std::string& word, bool as_float) {
  char* end = nullptr;
  const double value = as_float ? static_cast<double>(std::strtof(word.c_str(), &end))
                                : std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0') throw std::runtime_error("no number: " + word);
  return value;
}

/// Lines without comments and line ends; a line that ends in a backslash has the next one in it.
std::vector<std::vector<std::string>> LinesOfWords(const std::string& text) {
  std::string plain;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && text.compare(i + 1, 2, "\r\n") == 0) {
      i += 2;
    } else if (text[i] == '\\' && text.compare(i + 1, 1, "\n") == 0) {
      i += 1;
    } else if (text[i] == '\r') {
      if (text.compare(i + 1, 1, "\n") != 0) plain += '\n';
    } else {
      plain += text[i];
    }
  }
  std::vector<std::vector<std::string>> lines;
  std::istringstream all(plain);
  for (std::string line; std::getline(all, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::vector<std::string> split;
    for (std::string word; words >> word;) split.push_back(word);
    if (!split.empty()) lines.push_back(split);
  }
  return lines;
}

void AddFan(const std::vector<uint64_t>& corners, Mesh* mesh) {
  for (size_t i = 2; i < corners.size(); ++i) {
    mesh->triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

void AddPosition(const std::vector<std::string>& words, size_t first, bool as_float, Mesh* mesh) {
  for (size_t i = first; i < first + 3; ++i) mesh->xyz.push_back(Value(words.at(i), as_float));
}

template <class T>
T Take(const std::string& bytes, size_t* at, bool swap) {
  std::string piece = bytes.substr(*at, sizeof(T));
  if (piece.size() < sizeof(T)) throw std::runtime_error("cut");
  if (swap) piece.assign(piece.rbegin(), piece.rend());
  *at += sizeof(T);
  T value;
  std::memcpy(&value, piece.data(), sizeof(T));
  return value;
}

}  // namespace

Mesh PlainObj(const std::string& text, bool as_float) {
  Mesh mesh;
  for (const auto& words : LinesOfWords(text)) {
    if (words[0] == "v") AddPosition(words, 1, as_float, &mesh);
    if (words[0] != "f") continue;
    std::vector<uint64_t> corners;
    for (size_t i = 1; i < words.size(); ++i) {
      const long index = std::strtol(words[i].c_str(), nullptr, 10);
      corners.push_back(index > 0 ? static_cast<uint64_t>(index) - 1
                                  : mesh.xyz.size() / 3 - static_cast<uint64_t>(-index));
    }
    AddFan(corners, &mesh);
  }
  return mesh;
}

Mesh PlainOff(const std::string& text, bool as_float) {
  const auto lines = LinesOfWords(text);
  size_t at = lines.at(0).size() > 1 ? 0 : 1;
  const size_t first = at == 0 ? 1 : 0;
  const uint64_t vertices = std::stoull(lines.at(at).at(first));
  const uint64_t faces = std::stoull(lines.at(at).at(first + 1));
  Mesh mesh;
  for (uint64_t i = 0; i < vertices; ++i) AddPosition(lines.at(++at), 0, as_float, &mesh);
  for (uint64_t i = 0; i < faces; ++i) {
    const auto& words = lines.at(++at);
    std::vector<uint64_t> corners;
    for (uint64_t c = 1; c <= std::stoull(words[0]); ++c) {
      corners.push_back(std::stoull(words.at(c)));
    }
    AddFan(corners, &mesh);
  }
  return mesh;
}

Mesh PlainTextStl(const std::string& text, bool as_float) {
  Mesh mesh;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (word != "vertex") continue;
    for (int axis = 0; axis < 3; ++axis) {
      words >> word;
      mesh.xyz.push_back(Value(word, as_float));
    }
  }
  for (uint64_t v = 0; v < mesh.xyz.size() / 3; v += 3) mesh.triangles.push_back({v, v + 1, v + 2});
  return mesh;
}

Mesh PlainBinaryStl(const std::string& bytes) {
  Mesh mesh;
  size_t at = 80;
  const auto facets = Take<uint32_t>(bytes, &at, false);
  for (uint64_t f = 0; f < facets; ++f) {
    at += 12;
    for (int i = 0; i < 9; ++i) mesh.xyz.push_back(Take<float>(bytes, &at, false));
    at += 2;
    mesh.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return mesh;
}

Mesh PlainBinaryOff(const std::string& bytes, bool geomview) {
  Mesh mesh;
  size_t at = bytes.find('\n') + 1;
  const auto vertices = Take<uint32_t>(bytes, &at, geomview);
  const auto faces = Take<uint32_t>(bytes, &at, geomview);
  at += 4;
  for (uint64_t i = 0; i < 3 * uint64_t{vertices}; ++i) {
    mesh.xyz.push_back(Take<float>(bytes, &at, geomview));
  }
  for (uint64_t f = 0; f < faces; ++f) {
    std::vector<uint64_t> corners(Take<uint32_t>(bytes, &at, geomview));
    for (uint64_t& corner : corners) corner = Take<uint32_t>(bytes, &at, geomview);
    AddFan(corners, &mesh);
    if (geomview) at += 4 * Take<uint32_t>(bytes, &at, true);
  }
  return mesh;
}

}  // namespace folprom::io::testing
