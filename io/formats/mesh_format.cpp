#include "io/formats/mesh_format.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

namespace folprom::io {

std::optional<MeshFormat> FormatByEnding(const std::string& path) {
  static constexpr std::pair<std::string_view, MeshFormat> kEndings[] = {
      {".ply", MeshFormat::kPly},
      {".obj", MeshFormat::kObj},
      {".stl", MeshFormat::kStl},
      {".off", MeshFormat::kOff}};
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  for (const auto& [known, format] : kEndings) {
    if (known == ending) return format;
  }
  return std::nullopt;
}

}  // namespace folprom::io
