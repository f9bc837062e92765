#include "apps/render/png_code.h"

#include <png.h>

#include <algorithm>
#include <string>

#include "folprom/result.h"

namespace folprom::render {

std::vector<uint8_t> PngOf(const Image& image) {
  const auto& pixels = image.pixels();
  const bool opaque =
      std::all_of(pixels.begin(), pixels.end(), [](const Pixel& p) { return p.alpha == 255; });
  std::vector<uint8_t> samples;
  samples.reserve(pixels.size() * 2);
  for (const Pixel& pixel : pixels) {
    samples.push_back(pixel.grey);
    if (!opaque) samples.push_back(pixel.alpha);
  }
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  header.width = image.width();
  header.height = image.height();
  header.format = opaque ? PNG_FORMAT_GRAY : PNG_FORMAT_GA;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::vector<uint8_t> bytes(size);
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, samples.data(), 0, nullptr) == 0) {
    throw Failure(ErrorKind::kInternal, std::string("libpng: ") + header.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace folprom::render
