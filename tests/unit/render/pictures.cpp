#include "tests/unit/render/pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace folprom::render {

measure::TriangleMesh Ball(double radius, uint32_t rings) {
  measure::TriangleMesh mesh;
  const uint32_t columns = 2 * rings;
  for (uint32_t i = 0; i < rings; ++i) {
    const double polar = std::numbers::pi * i / (rings - 1);
    for (uint32_t j = 0; j < columns; ++j) {
      const double azimuth = 2 * std::numbers::pi * j / columns;
      mesh.positions.push_back({radius * std::sin(polar) * std::cos(azimuth),
                                radius * std::sin(polar) * std::sin(azimuth),
                                radius * std::cos(polar)});
    }
  }
  for (uint32_t i = 0; i + 1 < rings; ++i) {
    for (uint32_t j = 0; j < columns; ++j) {
      const uint32_t a = i * columns + j, b = i * columns + (j + 1) % columns;
      mesh.faces.push_back({a, a + columns, b + columns});
      mesh.faces.push_back({a, b + columns, b});
    }
  }
  return mesh;
}

Image PictureOf(const measure::TriangleMesh& mesh, const Style& style, parallel::Runner* runner,
                uint32_t width, uint32_t height) {
  const auto serial = parallel::MakeSerialRunner();
  parallel::Runner& used = runner != nullptr ? *runner : *serial;
  parallel::Progress progress;
  Box box;
  for (const Vector3& p : mesh.positions) {
    for (size_t i = 0; i < 3; ++i) {
      if (std::isfinite(p[i])) {
        box.lo[i] = std::min(box.lo[i], p[i]);
        box.hi[i] = std::max(box.hi[i], p[i]);
      }
    }
  }
  const Camera camera(box, {}, width, height);
  const Scene scene(mesh, camera, used, progress);
  return Render(scene, camera, style, used, progress);
}

PictureOptions Small(uint32_t width, uint32_t height) {
  PictureOptions options;
  options.width = width;
  options.height = height;
  return options;
}

Picture DrawFile(const std::string& path, const PictureOptions& options) {
  const auto runner = parallel::MakeSerialRunner();
  parallel::Progress progress;
  return Draw(path, options, *runner, progress);
}

size_t InkedPixels(const Image& image) {
  const auto& pixels = image.pixels();
  return pixels.size() - static_cast<size_t>(std::count(pixels.begin(), pixels.end(), Pixel{}));
}

double Difference(const Image& a, const Image& b) {
  double sum = 0;
  for (size_t i = 0; i < a.pixels().size(); ++i) {
    sum += std::abs(int{a.pixels()[i].grey} - int{b.pixels()[i].grey});
  }
  return sum / static_cast<double>(a.pixels().size());
}

}  // namespace folprom::render
