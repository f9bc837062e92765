// A picture in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace folprom::render {

struct Pixel {
  uint8_t grey = 255;  ///< of what covers the pixel, not multiplied by alpha
  uint8_t alpha = 255;
  bool operator==(const Pixel&) const = default;
};

/// Rows from top to bottom. White to begin with.
class Image {
 public:
  Image() = default;
  Image(uint32_t width, uint32_t height)
      : width_(width), height_(height), pixels_(size_t{width} * height) {}

  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  /// Below width() and height().
  Pixel& At(uint32_t x, uint32_t y) { return pixels_[size_t{y} * width_ + x]; }
  const Pixel& At(uint32_t x, uint32_t y) const { return pixels_[size_t{y} * width_ + x]; }
  const std::vector<Pixel>& pixels() const { return pixels_; }

 private:
  uint32_t width_ = 0, height_ = 0;
  std::vector<Pixel> pixels_;
};

}  // namespace folprom::render
