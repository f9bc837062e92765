// Words in a picture.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "apps/render/image.h"

namespace folprom::render {

inline constexpr uint32_t kLetterWidth = 9, kLetterHeight = 15;  ///< pixels, the gap included

/// Writes a line with its upper left corner at (x, y). What does not lie in the picture is cut off,
/// what is not printable ASCII becomes a question mark, one for each character of UTF-8.
void Write(Image* image, uint32_t x, uint32_t y, std::string_view text, uint8_t grey);

/// The text, or its beginning and an ellipsis, so that it is at most `pixels` wide.
std::string Fitted(std::string_view text, uint32_t pixels);

}  // namespace folprom::render
