// What lights a mesh: an overcast sky and a soft lamp. No random numbers: neighbouring pixels ask
// in the same directions, which leaves no noise.
#pragma once

#include <array>
#include <cstddef>

#include "apps/render/float3.h"

namespace folprom::render {

/// Rays of a pixel. Each looks at a part of the sky and of the lamp; together they see all.
inline constexpr size_t kSamples = 16;
inline constexpr size_t kSkyPerSample = 6;

class Lights {
 public:
  struct Ray {
    Float3 direction;  ///< of length 1, towards the light
    float weight = 0;  ///< a surface that faces it, and nothing between, has this brightness
  };

  /// `up`: of the model, in camera coordinates.
  explicit Lights(const Float3& up);

  const std::array<Ray, kSkyPerSample>& Sky(size_t sample) const { return sky_[sample]; }
  const Ray& Lamp(size_t sample) const { return lamp_[sample]; }

 private:
  std::array<std::array<Ray, kSkyPerSample>, kSamples> sky_;
  std::array<Ray, kSamples> lamp_;
};

}  // namespace folprom::render
