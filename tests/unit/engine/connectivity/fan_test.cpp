#include "engine/connectivity/fan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "engine/connectivity/fan_model.h"
#include "engine/connectivity/light_fan_model.h"
#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

/// A star of `neighbours` neighbours with the faces (vertex, from, to).
SplitStar StarOf(uint32_t neighbours, const std::vector<std::pair<uint32_t, uint32_t>>& faces) {
  SplitStar star;
  star.neighbours.resize(neighbours);
  for (const auto& [from, to] : faces) {
    SplitStar::StarFace face{};
    face.end[0] = from;
    face.end[1] = to;
    star.faces.push_back(face);
  }
  return star;
}

/// The ring 0, step, 2 step .. modulo `places`; without its last face: a path.
std::vector<std::pair<uint32_t, uint32_t>> Ring(uint32_t places, uint32_t step, bool open) {
  std::vector<std::pair<uint32_t, uint32_t>> faces;
  for (uint32_t k = 0; k + (open ? 1 : 0) < places; ++k) {
    faces.push_back({k * step % places, (k + 1) * step % places});
  }
  return faces;
}

TEST(Fan, FollowsTheFacesOfADisc) {
  for (uint32_t degree = 3; degree <= Fan::kMostPlaces; ++degree) {
    const uint32_t step = degree % 3 == 0 ? 1 : 3;
    const Fan fan = FindFan(StarOf(degree, Ring(degree, step, false)));
    ASSERT_EQ(fan.places, degree);
    EXPECT_FALSE(fan.open);
    for (uint32_t k = 0; k < degree; ++k) {
      EXPECT_EQ(fan.neighbour[k], k * step % degree);
      EXPECT_EQ(fan.face[k], k);
      EXPECT_FALSE(fan.IsOutside(k));
    }
  }
}

TEST(Fan, ClosesAHalfDiscByTheOutside) {
  for (uint32_t degree = 2; degree < Fan::kMostPlaces; ++degree) {
    const uint32_t step = degree % 3 == 0 ? 1 : 3;
    const Fan fan = FindFan(StarOf(degree, Ring(degree, step, true)));
    ASSERT_EQ(fan.places, degree + 1);
    EXPECT_TRUE(fan.open);
    EXPECT_TRUE(fan.IsOutside(degree));
    EXPECT_EQ(fan.face[degree], kNone);
    EXPECT_EQ(fan.face[degree - 1], kNone);
    for (uint32_t k = 0; k < degree; ++k) EXPECT_EQ(fan.neighbour[k], k * step % degree);
  }
}

TEST(Fan, IsNothingElse) {
  const auto places = [](const SplitStar& star) { return FindFan(star).places; };
  EXPECT_EQ(places(StarOf(0, {})), 0u);
  EXPECT_EQ(places(StarOf(1, {})), 0u);
  EXPECT_EQ(places(StarOf(2, {{0, 1}, {1, 0}})), 0u) << "two faces on the same three vertices";
  EXPECT_EQ(places(StarOf(3, {{0, 1}, {1, 2}, {0, 2}})), 0u) << "oriented against the others";
  EXPECT_EQ(places(StarOf(6, {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}})), 0u) << "two discs";
  EXPECT_EQ(places(StarOf(4, {{0, 1}, {1, 2}, {2, 0}})), 0u) << "a disc and a lone neighbour";
  EXPECT_EQ(places(StarOf(6, {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}})), 0u) << "disc, half disc";
  EXPECT_EQ(places(StarOf(4, {{0, 1}, {0, 2}, {0, 3}})), 0u) << "a book";
  EXPECT_EQ(places(StarOf(3, {{0, 1}, {1, kNone}})), 0u) << "a corner that is no neighbour";
  EXPECT_EQ(places(StarOf(21, Ring(21, 1, false))), 0u) << "too many";
}

TEST(Fan, PartsEveryPlaceToOneSideOfTheCut) {
  for (bool open : {false, true}) {
    SplitStar star = StarOf(6, Ring(6, 1, open));
    const Fan fan = FindFan(star);
    for (uint32_t begin = 0; begin < fan.places; ++begin) {
      for (uint32_t end = 0; end < fan.places; ++end) {
        if (begin == end) continue;
        PartFan(fan, {begin, end}, &star);
        bool second = true;
        for (uint32_t step = 0, k = begin; step < fan.places; ++step, k = fan.Next(k)) {
          if (k == end) second = false;
          const Side side = second ? kSecond : kFirst;
          if (fan.face[k] != kNone) {
            EXPECT_EQ(star.faces[fan.face[k]].side, side);
          }
          if (fan.IsOutside(k)) continue;
          const bool pivot = k == begin || k == end;
          EXPECT_EQ(star.neighbours[fan.neighbour[k]].side, pivot ? kBoth : side);
        }
      }
    }
  }
}

struct Sample {
  Fan fan;
  std::vector<FanSpoke> spokes;
  Vector3 second;
  FanCut cut;
};

/// A turned regular ring whose pivots lie left and right of the second child; with noise: anything.
Sample Draw(std::mt19937_64* random, bool noise) {
  const auto draw = [&](double most) { return std::uniform_real_distribution<>(0, most)(*random); };
  const uint32_t degree = noise ? 3 + static_cast<uint32_t>((*random)() % 14) : 6;
  const bool open = noise && (*random)() % 4 == 0;
  Sample sample{FindFan(StarOf(degree, Ring(degree, 1, open))), {}, {}, {}};
  const double turn = draw(6.28);
  for (uint32_t k = 0; k < degree; ++k) {
    const double angle = turn + 6.2831853 * k / degree;
    Vector3 place{100 * std::cos(angle), 100 * std::sin(angle), draw(1)};
    if (noise) place = {draw(90), draw(90), draw(9)};
    if (noise && (*random)() % 8 == 0) place = {0, 0, 0};
    const auto small = static_cast<uint32_t>((*random)() % 30);
    sample.spokes.push_back({place, small, draw(1), small % 2 == 0, small});
  }
  sample.second = {45 * std::cos(turn), 45 * std::sin(turn), 0};
  if (noise && (*random)() % 8 == 0) sample.second = {0, 0, 0};
  sample.cut = {degree - 1, 1};
  if (noise) {
    sample.cut.begin = static_cast<uint32_t>((*random)() % sample.fan.places);
    const auto ahead = 1 + static_cast<uint32_t>((*random)() % (sample.fan.places - 1));
    sample.cut.end = (sample.cut.begin + ahead) % sample.fan.places;
  }
  return sample;
}

template <class Model>
class AnyFanModel : public ::testing::Test {};
using FanModels = ::testing::Types<FanModel, LightFanModel>;
TYPED_TEST_SUITE(AnyFanModel, FanModels);

TYPED_TEST(AnyFanModel, GivesBackEveryCutOfAnyGeometry) {
  std::mt19937_64 random(5);
  std::vector<Sample> samples;
  for (int i = 0; i < 3000; ++i) samples.push_back(Draw(&random, i % 3 != 0));
  BitEncoder encoder;
  TypeParam writer, reader;
  for (const Sample& s : samples) writer.Code(encoder, s.fan, s.spokes, s.second, s.cut);
  const auto bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (const Sample& s : samples) {
    const FanCut cut = reader.Code(decoder, s.fan, s.spokes, s.second, {});
    ASSERT_EQ(cut.begin, s.cut.begin);
    ASSERT_EQ(cut.end, s.cut.end);
  }
  decoder.FinishSegment();
}

TYPED_TEST(AnyFanModel, LearnsWhereThePivotsLie) {
  std::mt19937_64 random(6);
  BitEncoder encoder;
  TypeParam model;
  uint64_t early = 0, late = 0;
  for (int i = 0; i < 1000; ++i) {
    const Sample s = Draw(&random, false);
    encoder.SetMeter(i < 500 ? &early : &late);
    model.Code(encoder, s.fan, s.spokes, s.second, s.cut);
  }
  EXPECT_LT(late, early);
  EXPECT_LT(late, 500u * 1024 / 5);  // a fifth of a bit each; there are 30 cuts
}

}  // namespace
}  // namespace folprom
