#include "io/formats/mesh_format.h"

#include <filesystem>
#include <string_view>
#include <utility>

#include "io/formats/text_cursor.h"

namespace folprom::io {

std::optional<MeshFormat> FormatByEnding(const std::string& path) {
  static constexpr std::pair<std::string_view, MeshFormat> kEndings[] = {
      {".ply", MeshFormat::kPly},
      {".obj", MeshFormat::kObj},
      {".stl", MeshFormat::kStl},
      {".off", MeshFormat::kOff}};
  const std::string ending = std::filesystem::path(path).extension().string();
  for (const auto& [known, format] : kEndings) {
    if (EqualsIgnoringCase(ending, known)) return format;
  }
  return std::nullopt;
}

}  // namespace folprom::io
