// What a picture shows, of whole meshes and of hostile ones.
#include "apps/render/renderer.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "tests/support/random.h"
#include "tests/unit/render/pictures.h"

namespace folprom::render {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Random triangles, many of them there several times, so that rays meet faces at equal distances.
measure::TriangleMesh Tangle() {
  support::Random random(7);
  measure::TriangleMesh mesh;
  for (int i = 0; i < 300; ++i) {
    mesh.positions.push_back({random.Between(0, 1), random.Between(0, 1), random.Between(0, 1)});
  }
  for (int i = 0; i < 400; ++i) {
    const auto corner = [&] { return static_cast<uint32_t>(random.Below(300)); };
    const std::array<uint32_t, 3> face = {corner(), corner(), corner()};
    for (int copies = 0; copies <= i % 12; ++copies) mesh.faces.push_back(face);
  }
  return mesh;
}

TEST(Renderer, LightsABallInTheMiddleAndLeavesTheCornersWhite) {
  const Image image = PictureOf(Ball(2, 60));
  const Pixel middle = image.At(48, 36);
  EXPECT_GT(middle.grey, 90);
  EXPECT_LT(middle.grey, 250);
  for (const uint32_t x : {0U, 95U}) {
    for (const uint32_t y : {0U, 71U}) EXPECT_EQ(image.At(x, y), Pixel{});
  }
  // The lamp stands on the upper left.
  EXPECT_GT(image.At(40, 26).grey, image.At(58, 50).grey + 20);
  // Round: about pi/4 of the square around it, which is as high as the picture allows.
  EXPECT_NEAR(static_cast<double>(InkedPixels(image)), 1700, 700);
}

TEST(Renderer, DrawsTheSameForEveryRunner) {
  const measure::TriangleMesh mesh = Tangle();
  for (const bool wireframe : {false, true}) {
    const Style style{wireframe, false};
    const Image serial = PictureOf(mesh, style);
    EXPECT_GT(InkedPixels(serial), 1000u);
    for (const int threads : {1, 2, 3}) {
      const auto runner = parallel::MakeTbbRunner(threads);
      EXPECT_EQ(PictureOf(mesh, style, runner.get()).pixels(), serial.pixels()) << threads;
    }
    const auto shuffled = parallel::MakeShuffledRunner(5);
    EXPECT_EQ(PictureOf(mesh, style, shuffled.get()).pixels(), serial.pixels());
  }
}

TEST(Renderer, ShowsBothSidesOfAFace) {
  measure::TriangleMesh ball = Ball(1, 24);
  const Image image = PictureOf(ball);
  for (size_t i = 0; i < ball.faces.size(); i += 2) std::swap(ball.faces[i][0], ball.faces[i][1]);
  // Not equal bit by bit: Embree rounds by the order of the corners.
  EXPECT_LT(Difference(PictureOf(ball), image), 0.05);
}

TEST(Renderer, DrawsEdgesOnTop) {
  const measure::TriangleMesh ball = Ball(1, 8);
  const Image plain = PictureOf(ball);
  const Image wired = PictureOf(ball, {true, false});
  size_t darker = 0;
  for (size_t i = 0; i < plain.pixels().size(); ++i) {
    EXPECT_LE(wired.pixels()[i].grey, plain.pixels()[i].grey + 3);
    darker += wired.pixels()[i].grey + 40 < plain.pixels()[i].grey ? 1 : 0;
  }
  EXPECT_GT(darker, InkedPixels(plain) / 20);
  EXPECT_LT(darker, InkedPixels(plain) * 3 / 4);
}

TEST(Renderer, LeavesTheBackgroundOut) {
  const Image image = PictureOf(Ball(1, 30), {false, true});
  EXPECT_EQ(image.At(0, 0).alpha, 0);
  EXPECT_EQ(image.At(48, 36).alpha, 255);
  EXPECT_EQ(image.At(48, 36), PictureOf(Ball(1, 30)).At(48, 36));
}

TEST(Renderer, DrawsPointsWhereNoFaceHasAnArea) {
  measure::TriangleMesh points = Ball(1, 12);
  points.faces.clear();
  const Image image = PictureOf(points);
  EXPECT_GT(InkedPixels(image), 200u);
  EXPECT_EQ(image.At(0, 0), Pixel{});
  points.faces = {{0, 0, 0}, {1, 1, 2}, {5, 6, 5}};
  EXPECT_EQ(PictureOf(points).pixels(), image.pixels());
}

TEST(Renderer, DrawsOnePointInTheMiddle) {
  const Image image = PictureOf({{{5, -3, 1e6}}, {}});
  EXPECT_GT(InkedPixels(image), 0u);
  measure::TriangleMesh many{{{5, -3, 1e6}, {5, -3, 1e6}, {5, -3, 1e6}}, {{0, 1, 2}, {0, 0, 0}}};
  EXPECT_GT(InkedPixels(PictureOf(many)), 0u);
}

TEST(Renderer, LeavesAnEmptyMeshWhite) {
  EXPECT_EQ(InkedPixels(PictureOf({})), 0u);
  EXPECT_EQ(InkedPixels(PictureOf({{{kNan, 0, 0}, {0, kInfinity, 0}}, {{0, 1, 0}}})), 0u);
}

TEST(Renderer, LeavesOutWhatIsNotFinite) {
  const measure::TriangleMesh ball = Ball(1, 24);
  measure::TriangleMesh hurt = ball;
  const auto first = static_cast<uint32_t>(hurt.positions.size());
  hurt.positions.insert(hurt.positions.end(), {{kNan, 0, 0}, {0, -kInfinity, 0}});
  hurt.faces.insert(hurt.faces.begin(), {{0, 1, first}, {first + 1, 5, 6}});
  EXPECT_EQ(PictureOf(hurt).pixels(), PictureOf(ball).pixels());
}

TEST(Renderer, TakesAnySizeOfPicture) {
  for (const auto& [width, height] : {std::pair{1U, 1U}, {33U, 7U}, {5U, 64U}}) {
    const Image image = PictureOf(Ball(1, 12), {}, nullptr, width, height);
    EXPECT_EQ(image.width(), width);
    EXPECT_EQ(image.height(), height);
    EXPECT_GT(InkedPixels(image), 0u);
  }
}

TEST(Renderer, StopsWhenCancelled) {
  const auto runner = parallel::MakeTbbRunner(2);
  parallel::Progress progress;
  const Camera camera({{-1, -1, -1}, {1, 1, 1}}, {}, 64, 64);
  const Scene scene(Ball(1, 12), camera, *runner, progress);
  progress.Cancel();
  EXPECT_THROW(Render(scene, camera, {}, *runner, progress), parallel::Cancelled);
  EXPECT_THROW(Scene(Ball(1, 12), camera, *runner, progress), parallel::Cancelled);
}

}  // namespace
}  // namespace folprom::render
