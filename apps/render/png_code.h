// A picture as the bytes of a PNG file.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/render/image.h"

namespace folprom::render {

/// Eight bits of grey a pixel, and as many of alpha where a pixel is not opaque. Throws Failure
/// kInternal.
std::vector<uint8_t> PngOf(const Image& image);

}  // namespace folprom::render
