#include "apps/render/lights.h"

#include <cmath>
#include <numbers>

namespace folprom::render {
namespace {

// Brightness of a white surface: that of the open sky alone, and of the lamp alone.
constexpr double kSkyLight = 0.36;
constexpr double kLampLight = 0.80;
// The sky overhead beside that below the feet.
constexpr double kSkyTop = 1.3, kSkyBottom = 0.5;
// Over the left shoulder of who looks.
constexpr Float3 kLampTowards = {-0.45F, 0.65F, 0.75F};
constexpr double kLampRadius = 0.22;

constexpr double kGoldenAngle = 2.39996322972865332;

// Point `index` of `count` that lie evenly on the unit sphere.
Float3 OnSphere(size_t index, size_t count) {
  const double z = 1 - (2 * static_cast<double>(index) + 1) / static_cast<double>(count);
  const double r = std::sqrt(1 - z * z);
  const double angle = kGoldenAngle * static_cast<double>(index);
  return {static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)),
          static_cast<float>(z)};
}

// Point `index` of `count` that lie evenly on the unit disc.
std::array<double, 2> OnDisc(size_t index, size_t count) {
  const double r = std::sqrt((static_cast<double>(index) + 0.5) / static_cast<double>(count));
  const double angle = kGoldenAngle * static_cast<double>(index);
  return {r * std::cos(angle), r * std::sin(angle)};
}

Float3 Cross(const Float3& a, const Float3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace

Lights::Lights(const Float3& up) {
  constexpr size_t kSky = kSamples * kSkyPerSample;
  for (size_t i = 0; i < kSky; ++i) {
    const Float3 direction = OnSphere(i, kSky);
    const double height = (1 + static_cast<double>(Dot(direction, up))) / 2;
    const double brightness = kSkyBottom + (kSkyTop - kSkyBottom) * height;
    // 4 / rays: over the half that a surface faces, the cosines of evenly spread rays sum to a
    // quarter of all.
    sky_[i % kSamples][i / kSamples] = {
        direction, static_cast<float>(kSkyLight * brightness * 4 / kSkyPerSample)};
  }
  const Float3 towards = Normalized(kLampTowards);
  const Float3 side = Normalized(Cross(towards, {0, 1, 0}));
  const Float3 above = Cross(side, towards);
  for (size_t i = 0; i < kSamples; ++i) {
    const auto [x, y] = OnDisc(i, kSamples);
    lamp_[i] = {Normalized(towards + static_cast<float>(kLampRadius * x) * side +
                           static_cast<float>(kLampRadius * y) * above),
                static_cast<float>(kLampLight)};
  }
}

}  // namespace folprom::render
