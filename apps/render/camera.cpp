#include "apps/render/camera.h"

#include <algorithm>
#include <numbers>

namespace folprom::render {
namespace {

using measure::Cross;
using measure::Dot;

// Half of the longer side of the picture, at the distance 1: an angle of 25 degrees from side to
// side. Wider ones bend what is near.
constexpr double kHalfWidth = 0.22;
constexpr double kUsed = 0.97;  ///< of the picture; the rest is its margin
// A line that is looked at along itself would have the eye upon it.
constexpr double kLeastDistance = 1.5;
// Land: lower than a third of its width and depth.
constexpr double kFlat = 1.0 / 3;
// Farther out Embree takes nothing.
constexpr double kFarthest = 1e17;

Vector3 Axis(size_t index, double sign) {
  Vector3 axis{};
  axis[index] = sign;
  return axis;
}

size_t UpAxis(const Vector3& extent) {
  return extent[2] < kFlat * std::min(extent[0], extent[1]) ? 2 : 1;
}

// Looks along the shorter of the two level axes, so that the longer lies across the picture.
Vector3 FrontAxis(const Vector3& extent, size_t up) {
  // By habit: x to the right, and the front is z where y is up, -y where z is up.
  if (up == 0) return extent[1] < extent[2] ? Axis(1, 1) : Axis(2, 1);
  const size_t level = up == 1 ? 2 : 1;
  if (extent[0] < extent[level]) return Axis(0, 1);
  return Axis(level, up == 1 ? 1 : -1);
}

Vector3 Sum(double s, const Vector3& a, double t, const Vector3& b) {
  return measure::Combination({}, s, a, t, b);
}

// right, up, backwards
std::array<Vector3, 3> AxesOf(const View& view, const Vector3& extent) {
  constexpr double kDegree = std::numbers::pi / 180;
  const size_t up_index = view.up.value_or(UpAxis(extent));
  const bool land =
      extent[up_index] < kFlat * std::min(extent[(up_index + 1) % 3], extent[(up_index + 2) % 3]);
  const double azimuth = view.azimuth * kDegree;
  const double elevation = view.elevation.value_or(land ? 45 : 20) * kDegree;
  const Vector3 up = Axis(up_index, 1);
  const Vector3 front = FrontAxis(extent, up_index);
  const Vector3 side = Cross(up, front);
  const Vector3 level = Sum(std::cos(azimuth), front, std::sin(azimuth), side);
  const Vector3 back = Sum(std::cos(elevation), level, std::sin(elevation), up);
  const Vector3 right = Cross(up, level);
  return {right, Cross(back, right), back};
}

// The eye from which all points at hand, in coordinates along the axes, are just seen: for each of
// right and up, |point - eye| <= slope x depth on both sides; the nearest eye on which both agree.
Vector3 EyeFor(const std::array<Vector3, 8>& points, const std::array<double, 2>& slopes) {
  Vector3 eye{};
  for (size_t axis = 0; axis < 2; ++axis) {
    double above = -kFarthest, below = -kFarthest;
    for (const Vector3& point : points) {
      above = std::max(above, point[2] + point[axis] / slopes[axis]);
      below = std::max(below, point[2] - point[axis] / slopes[axis]);
    }
    eye[axis] = slopes[axis] * (above - below) / 2;
    eye[2] = std::max(eye[2], (above + below) / 2);
  }
  eye[2] = std::max(eye[2], kLeastDistance);
  return eye;
}

}  // namespace

Camera::Camera(const Box& box, const View& view, uint32_t width, uint32_t height)
    : width_(width), height_(height) {
  const double longer = std::max(width, height);
  pixel_ = 2 * kHalfWidth / longer;
  for (size_t i = 0; i < 3; ++i) {
    middle_[i] = box.lo[i] / 2 + box.hi[i] / 2;
    extent_[i] = box.hi[i] - box.lo[i];
  }
  const double diagonal = std::hypot(extent_[0], extent_[1], extent_[2]);
  scale_ = diagonal > 0 ? diagonal : 1;
  for (double& edge : extent_) edge /= scale_;
  axes_ = AxesOf(view, extent_);
  std::array<Vector3, 8> corners;
  for (size_t corner = 0; corner < corners.size(); ++corner) {
    Vector3 from_middle;
    for (size_t i = 0; i < 3; ++i)
      from_middle[i] = extent_[i] * ((corner >> i & 1) != 0 ? 0.5 : -0.5);
    for (size_t i = 0; i < 3; ++i) corners[corner][i] = Dot(axes_[i], from_middle);
  }
  eye_ =
      EyeFor(corners, {kUsed * kHalfWidth * width / longer, kUsed * kHalfWidth * height / longer});
  const size_t up = view.up.value_or(UpAxis(extent_));
  up_ = {static_cast<float>(axes_[0][up]), static_cast<float>(axes_[1][up]),
         static_cast<float>(axes_[2][up])};
}

Float3 Camera::Inside(const Vector3& position) const {
  Vector3 from_middle;
  for (size_t i = 0; i < 3; ++i) from_middle[i] = (position[i] - middle_[i]) / scale_;
  std::array<float, 3> inside;
  for (size_t i = 0; i < 3; ++i) {
    inside[i] =
        static_cast<float>(std::clamp(Dot(axes_[i], from_middle) - eye_[i], -kFarthest, kFarthest));
  }
  return {inside[0], inside[1], inside[2]};
}

Float3 Camera::Direction(float x, float y) const {
  const auto pixel = static_cast<float>(pixel_);
  return {pixel * (x - 0.5F * static_cast<float>(width_)),
          pixel * (0.5F * static_cast<float>(height_) - y), -1};
}

std::array<float, 2> Camera::PixelOf(const Float3& point) const {
  const float depth = -point.z * static_cast<float>(pixel_);
  return {0.5F * static_cast<float>(width_) + point.x / depth,
          0.5F * static_cast<float>(height_) - point.y / depth};
}

}  // namespace folprom::render
