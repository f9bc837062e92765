// Where a mesh is looked at from.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "apps/render/float3.h"
#include "engine/measure/vector3.h"

namespace folprom::render {

using measure::Vector3;

/// Model units. lo <= hi, finite, and so is hi - lo.
struct Box {
  Vector3 lo{}, hi{};
};

/// Angles in degrees.
struct View {
  double azimuth = -30;             ///< 0: from the front; 90: from the right, -90: from the left
  std::optional<double> elevation;  ///< -90 .. 90 above the horizon; else 20, of flat land 45
  std::optional<size_t> up;         ///< axis 0 .. 2; else z for flat land, y for all else
};

/// A perspective view that holds a whole box. Camera coordinates: x to the right, y up, the eye in
/// the origin and what is seen at z < 0; 1 is the diagonal of the box.
class Camera {
 public:
  /// `width`, `height`: pixels, at least 1.
  Camera(const Box& box, const View& view, uint32_t width, uint32_t height);

  Float3 Inside(const Vector3& position) const;
  /// From the eye through a point of the picture, pixels from its upper left corner. Its z is -1.
  Float3 Direction(float x, float y) const;
  /// Pixels from the upper left corner of what lies at z < 0.
  std::array<float, 2> PixelOf(const Float3& point) const;

  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  /// Edge of a pixel at the distance 1.
  double pixel() const { return pixel_; }
  /// Of the middle of the box from the eye.
  double distance() const { return eye_[2]; }
  /// Edges of the box along x, y and z of the model.
  const Vector3& extent() const { return extent_; }
  /// The up axis of the model.
  Float3 up() const { return up_; }

 private:
  uint32_t width_, height_;
  double pixel_ = 0;
  Vector3 middle_{}, extent_{};
  double scale_ = 1;               ///< length of the diagonal in model units
  std::array<Vector3, 3> axes_{};  ///< right, up and backwards in the model
  Vector3 eye_{};                  ///< from the middle of the box, along the axes
  Float3 up_{};
};

}  // namespace folprom::render
