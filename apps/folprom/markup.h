// Text and pictures as they stand in HTML and SVG.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace folprom::cli {

/// For text and for values in double quotes. What is not UTF-8, or a control character, becomes
/// U+FFFD; a line break stays.
std::string Escaped(std::string_view text);

/// A PNG file as a data: address.
std::string PngAddress(std::span<const uint8_t> png);

}  // namespace folprom::cli
