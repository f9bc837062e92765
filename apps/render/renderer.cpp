#include "apps/render/renderer.h"

#include <algorithm>
#include <cmath>

#include "apps/render/lights.h"

namespace folprom::render {
namespace {

constexpr uint32_t kTile = 32;  ///< pixels of an edge

constexpr float kClay = 0.68F;      ///< part of the light that comes back
constexpr float kEdge = 0.06F;      ///< brightness of the wireframe
constexpr float kEdgeWidth = 1.1F;  ///< pixels
// Edges of faces between these sizes, in pixels, fade, so that dense meshes stay bright.
constexpr float kUnseenFace = 2.5F, kSmallFace = 10;

// Where the ray of a sample goes through its pixel: 16 places, no two in one row or column.
std::array<float, 2> PlaceOf(size_t sample) {
  size_t reversed = 0;
  for (size_t bit = 0; bit < 4; ++bit) reversed |= (sample >> bit & 1) << (3 - bit);
  return {(static_cast<float>(sample) + 0.5F) / kSamples,
          (static_cast<float>(reversed) + 0.5F) / kSamples};
}

float LengthOf(float x, float y) { return std::sqrt(x * x + y * y); }

// How much of the wireframe lies over a place of the picture, 0 .. 1.
float EdgeAt(const std::array<std::array<float, 2>, 3>& corners, float x, float y) {
  float nearest = kEdgeWidth;
  float longest = 0;
  for (size_t i = 0; i < 3; ++i) {
    const auto& a = corners[i];
    const auto& b = corners[(i + 1) % 3];
    const float along_x = b[0] - a[0], along_y = b[1] - a[1];
    const float length = LengthOf(along_x, along_y);
    const float away = std::abs(along_x * (y - a[1]) - along_y * (x - a[0]));
    if (length > 0) nearest = std::min(nearest, away / length);
    longest = std::max(longest, length);
  }
  if (nearest >= kEdgeWidth / 2) return 0;
  return std::clamp((longest - kUnseenFace) / (kSmallFace - kUnseenFace), 0.0F, 1.0F);
}

class Painter {
 public:
  Painter(const Scene& scene, const Camera& camera, const Style& style)
      : scene_(scene), camera_(camera), style_(style), lights_(camera.up()) {}

  Pixel Paint(uint32_t x, uint32_t y) const {
    float light = 0;
    int hits = 0;
    for (size_t sample = 0; sample < kSamples; ++sample) {
      const auto [dx, dy] = PlaceOf(sample);
      const float px = static_cast<float>(x) + dx, py = static_cast<float>(y) + dy;
      const auto hit = scene_.FirstHit(camera_.Direction(px, py));
      if (!hit) continue;
      ++hits;
      light += Brightness(*hit, sample, px, py);
    }
    return PixelOf(light, hits);
  }

 private:
  float Brightness(const Scene::Hit& hit, size_t sample, float x, float y) const {
    float light = LightFrom(lights_.Lamp(sample), hit);
    for (const Lights::Ray& ray : lights_.Sky(sample)) light += LightFrom(ray, hit);
    const float clay = kClay * light;
    if (!style_.wireframe || !scene_.has_faces()) return clay;
    std::array<std::array<float, 2>, 3> corners;
    const auto points = scene_.CornersOf(hit.element);
    for (size_t i = 0; i < 3; ++i) {
      if (points[i].z >= 0) return clay;  // reaches behind the eye
      corners[i] = camera_.PixelOf(points[i]);
    }
    return clay + EdgeAt(corners, x, y) * (kEdge - clay);
  }

  float LightFrom(const Lights::Ray& ray, const Scene::Hit& hit) const {
    const float cosine = Dot(ray.direction, hit.normal);
    if (cosine <= 0 || scene_.Blocked(hit, ray.direction)) return 0;
    return cosine * ray.weight;
  }

  // The square root stands for the gamma of displays.
  Pixel PixelOf(float light, int hits) const {
    constexpr float kAll = kSamples;
    const auto covered = static_cast<float>(hits);
    const auto byte = [](float x) {
      return static_cast<uint8_t>(std::min(255.0F, x * 255 + 0.5F));
    };
    if (!style_.transparent) return {byte(std::sqrt((light + kAll - covered) / kAll)), 255};
    if (hits == 0) return {255, 0};
    return {byte(std::sqrt(light / covered)), byte(covered / kAll)};
  }

  const Scene& scene_;
  const Camera& camera_;
  const Style style_;
  const Lights lights_;
};

}  // namespace

Image Render(const Scene& scene, const Camera& camera, const Style& style, parallel::Runner& runner,
             parallel::Progress& progress) {
  Image image(camera.width(), camera.height());
  const Painter painter(scene, camera, style);
  const uint32_t columns = (image.width() + kTile - 1) / kTile;
  const uint32_t rows = (image.height() + kTile - 1) / kTile;
  progress.StartStage("render", image.pixels().size());
  runner.ForEach(size_t{columns} * rows, [&](size_t tile) {
    const uint32_t left = static_cast<uint32_t>(tile % columns) * kTile;
    const uint32_t top = static_cast<uint32_t>(tile / columns) * kTile;
    const uint32_t right = std::min(left + kTile, image.width());
    const uint32_t bottom = std::min(top + kTile, image.height());
    for (uint32_t y = top; y < bottom; ++y) {
      for (uint32_t x = left; x < right; ++x) image.At(x, y) = painter.Paint(x, y);
    }
    progress.Advance(uint64_t{right - left} * (bottom - top));
  });
  return image;
}

}  // namespace folprom::render
