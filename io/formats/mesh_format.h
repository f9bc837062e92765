// The formats of mesh files that are known, and their endings.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace folprom::io {

enum class MeshFormat : uint8_t { kPly, kObj, kStl, kOff };

/// By the ending of the file's name, in large or small letters; none where it is another one.
std::optional<MeshFormat> FormatByEnding(const std::string& path);

}  // namespace folprom::io
