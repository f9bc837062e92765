// A camera holds the whole box, wherever and however large it is.
#include "apps/render/camera.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace folprom::render {
namespace {

// Of the box's corners in the picture: left, top, right, bottom.
std::array<float, 4> Extent(const Box& box, const Camera& camera) {
  std::array<float, 4> extent = {1e9F, 1e9F, -1e9F, -1e9F};
  for (int corner = 0; corner < 8; ++corner) {
    Vector3 p;
    for (size_t i = 0; i < 3; ++i) p[i] = (corner >> i & 1) != 0 ? box.hi[i] : box.lo[i];
    const Float3 inside = camera.Inside(p);
    EXPECT_LT(inside.z, 0);
    const auto pixel = camera.PixelOf(inside);
    for (size_t i = 0; i < 2; ++i) {
      extent[i] = std::min(extent[i], pixel[i]);
      extent[i + 2] = std::max(extent[i + 2], pixel[i]);
    }
  }
  return extent;
}

TEST(Camera, HoldsTheWholeBoxAndFillsThePicture) {
  const Box boxes[] = {{{0, 0, 0}, {1, 1, 1}},
                       {{-3, 2, 5}, {-2, 9, 5.5}},
                       {{4e5, 5e6, 100}, {4.1e5, 5.02e6, 130}},
                       {{1e15, 1e15, 1e15}, {1e15 + 8, 1e15 + 16, 1e15 + 4}},
                       {{0, 0, 0}, {1e-40, 2e-40, 1e-40}},
                       {{-1e300, -1e300, -1e300}, {1e300, 1e300, 1e300}}};
  for (const Box& box : boxes) {
    for (const double azimuth : {-30.0, 0.0, 45.0, 180.0}) {
      for (const double elevation : {-90.0, 20.0, 90.0}) {
        for (size_t up = 0; up < 3; ++up) {
          const Camera camera(box, {azimuth, elevation, up}, 200, 150);
          const auto [left, top, right, bottom] = Extent(box, camera);
          EXPECT_GE(left, 0);
          EXPECT_GE(top, 0);
          EXPECT_LE(right, 200);
          EXPECT_LE(bottom, 150);
          EXPECT_TRUE(right - left > 0.3F * 200 || bottom - top > 0.3F * 150);
        }
      }
    }
  }
}

TEST(Camera, LooksAtAPointFromAfar) {
  const Box box{{7, 7, 7}, {7, 7, 7}};
  const Camera camera(box, {}, 200, 150);
  const auto pixel = camera.PixelOf(camera.Inside(box.lo));
  EXPECT_NEAR(pixel[0], 100, 1e-3);
  EXPECT_NEAR(pixel[1], 75, 1e-3);
}

TEST(Camera, TurnsByItsAngles) {
  const Box box{{-1, -1, -1}, {1, 1, 1}};
  const auto pixel = [&](const View& view, const Vector3& p) {
    const Camera camera(box, view, 200, 200);
    return camera.PixelOf(camera.Inside(p));
  };
  // From the front, y up: x to the right.
  EXPECT_GT(pixel({0, 0, 1}, {1, 0, 0})[0], 120);
  EXPECT_LT(pixel({0, 0, 1}, {0, 1, 0})[1], 80);
  // From the right the front, +z, lies on the left.
  EXPECT_LT(pixel({90, 0, 1}, {0, 0, 1})[0], 80);
  // From above the front lies below.
  EXPECT_GT(pixel({0, 90, 1}, {0, 0, 1})[1], 120);
  EXPECT_LT(pixel({0, 0, 2}, {0, 0, 1})[1], 80);
  EXPECT_GT(pixel({0, 0, 2}, {1, 0, 0})[0], 120);
}

TEST(Camera, LooksDownOnLand) {
  const Box land{{0, 0, 0}, {100, 80, 5}};
  const auto pixel = [&](const Vector3& p) {
    const Camera camera(land, {}, 200, 200);
    return camera.PixelOf(camera.Inside(p));
  };
  EXPECT_LT(pixel({50, 80, 0})[1], pixel({50, 0, 0})[1] - 40);  // what is far lies above
  EXPECT_LT(pixel({50, 40, 5})[1], pixel({50, 40, 0})[1]);
}

TEST(Camera, DirectionsMeetWhatIsSeenThere) {
  const Camera camera({{-1, -2, -3}, {3, 2, 1}}, {}, 320, 240);
  const Float3 point = camera.Inside({0.5, 1, -2});
  const auto [x, y] = camera.PixelOf(point);
  const Float3 direction = camera.Direction(x, y);
  EXPECT_NEAR(-point.z * direction.x, point.x, 1e-5);
  EXPECT_NEAR(-point.z * direction.y, point.y, 1e-5);
}

}  // namespace
}  // namespace folprom::render
