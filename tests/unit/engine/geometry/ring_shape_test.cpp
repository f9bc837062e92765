#include "engine/geometry/ring_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/entropy/fixed_math.h"

namespace folprom {
namespace {

const Int3 kVertex{1 << 20, 1 << 20, 1 << 20};

FanFace FaceOf(const RingSpoke& a, const RingSpoke& b) {
  return {a.xy, b.xy, Pair{a.z_length[0], b.z_length[0]}};
}

/// The ring and its closed fan around kVertex.
struct Ring {
  std::vector<RingSpoke> around;
  FanSums fan;
};

Ring RingOf(const std::vector<Int3>& offsets) {
  Ring ring;
  for (const Int3& d : offsets) {
    const Int3 neighbour{kVertex.x + d.x, kVertex.y + d.y, kVertex.z + d.z};
    ring.around.push_back(SpokeBetween(LanePoint(kVertex), LanePoint(neighbour)));
  }
  for (size_t i = 0; i < offsets.size(); ++i) {
    ring.fan.AddFace(FaceOf(ring.around[i], ring.around[(i + 1) % offsets.size()]));
  }
  return ring;
}

void ExpectFinite(const RingShape& shape) {
  std::vector<double> values{shape.spacing, shape.fit_error, shape.height_range};
  for (const Vector3* v : {&shape.mean, &shape.direction, &shape.area_centre, &shape.rim_centre,
                           &shape.reach, &shape.normal, &shape.tangent, &shape.bend}) {
    values.insert(values.end(), v->begin(), v->end());
  }
  values.insert(values.end(), shape.covariance.begin(), shape.covariance.end());
  for (double at : {-1e9, 0.0, 1e9}) values.push_back(shape.MeetQuadric({at, 1, -at}));
  for (size_t i = 0; i < values.size(); ++i) EXPECT_TRUE(std::isfinite(values[i])) << i;
  EXPECT_GT(shape.spacing, 0);
  EXPECT_NEAR(Dot(shape.normal, shape.normal), 1, 1e-12);
  EXPECT_NEAR(Dot(shape.tangent, shape.tangent), 1, 1e-12);
  EXPECT_NEAR(Dot(shape.normal, shape.tangent), 0, 1e-12);
  EXPECT_GT(std::fabs(shape.normal[shape.dominant]), 0.57);
}

TEST(RingShape, FlatRingHasItsSpacingAndNoBend) {
  const Ring ring = RingOf({{100, 0, 0}, {0, 100, 0}, {-100, 0, 0}, {0, -100, 0}});
  const RingShape shape = MeasureRing(ring.around, ring.fan, 1);
  ExpectFinite(shape);
  EXPECT_EQ(shape.count, 4u);
  EXPECT_DOUBLE_EQ(shape.spacing, 100);
  EXPECT_EQ(shape.normal, (Vector3{0, 0, 1}));
  EXPECT_EQ(shape.dominant, 2u);
  for (double bend : shape.bend) EXPECT_EQ(bend, 0);
  EXPECT_EQ(shape.fit_error, 0);
  EXPECT_EQ(shape.height_range, 0);
  for (size_t i = 0; i < 3; ++i) {
    for (const Vector3* centre :
         {&shape.mean, &shape.direction, &shape.area_centre, &shape.rim_centre, &shape.reach}) {
      EXPECT_NEAR((*centre)[i], 0, 1e-9);
    }
  }
  EXPECT_DOUBLE_EQ(shape.covariance[0], 5000);
  EXPECT_DOUBLE_EQ(shape.covariance[3], 5000);
  EXPECT_EQ(shape.covariance[5], 0);
  EXPECT_EQ(shape.MeetQuadric({30, 40, 0}), 0);
}

TEST(RingShape, TiltedRingIsMetInItsPlane) {
  // z = x / 2.
  const Ring ring = RingOf({{100, 0, 50}, {0, 100, 0}, {-100, 0, -50}, {0, -100, 0}});
  const RingShape shape = MeasureRing(ring.around, ring.fan, 1);
  ExpectFinite(shape);
  EXPECT_EQ(shape.dominant, 2u);
  EXPECT_NEAR(shape.MeetQuadric({40, 70, 0}), 20, 1e-9);
  EXPECT_NEAR(shape.fit_error, 0, 1e-9);
}

TEST(RingShape, ParaboloidIsMetClosely) {
  auto height = [](double x, double y) { return (x * x + 0.5 * y * y) / 5000; };
  std::vector<Int3> offsets;
  for (int i = 0; i < 8; ++i) {
    const double x = 1000 * std::cos(i * kPi / 4), y = 1000 * std::sin(i * kPi / 4);
    offsets.push_back({static_cast<int32_t>(std::lround(x)), static_cast<int32_t>(std::lround(y)),
                       static_cast<int32_t>(std::lround(height(x, y)))});
  }
  const Ring ring = RingOf(offsets);
  const RingShape shape = MeasureRing(ring.around, ring.fan, 1);
  ExpectFinite(shape);
  EXPECT_NEAR(shape.height_range, 200, 1);
  EXPECT_LT(shape.fit_error, 15);
  for (double x : {-700.0, 0.0, 500.0}) {
    for (double y : {-600.0, 100.0, 800.0}) {
      EXPECT_NEAR(shape.MeetQuadric({x, y, 1e6}), height(x, y), 20) << x << ' ' << y;
    }
  }
}

TEST(RingShape, WithoutNeighboursTheScaleStands) {
  const RingShape shape = MeasureRing({}, {}, 250);
  ExpectFinite(shape);
  EXPECT_EQ(shape.count, 0u);
  EXPECT_EQ(shape.spacing, 250);
  ExpectFinite(MeasureRing({}, {}, 0));
}

TEST(RingShape, CoincidentAndCollinearNeighboursStayFinite) {
  for (const std::vector<Int3>& offsets :
       std::vector<std::vector<Int3>>{{{0, 0, 0}},
                                      {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                                      {{5, 0, 0}},
                                      {{0, 0, 5}},
                                      {{0, 0, 5}, {0, 0, -5}},
                                      {{5, 0, 0}, {-5, 0, 0}},
                                      {{1, 2, 3}, {2, 4, 6}, {0, 0, 0}},
                                      {{0, 0, 0}, {1 << 29, 0, 1}, {1, 0, 0}},
                                      {{7, 7, 7}, {7, 7, 7}, {7, 7, 7}}}) {
    const Ring ring = RingOf(offsets);
    ExpectFinite(MeasureRing(ring.around, ring.fan, 10));
    ExpectFinite(MeasureRing(ring.around, {}, 10));
  }
}

TEST(RingShape, LooksAtTheFirstOfVeryManyNeighbours) {
  std::vector<Int3> offsets;
  for (int32_t i = 0; i < 1000; ++i) offsets.push_back({100 - i % 7, i, i % 5});
  const Ring ring = RingOf(offsets);
  const RingShape shape = MeasureRing(ring.around, ring.fan, 10);
  ExpectFinite(shape);
  EXPECT_EQ(shape.count, 1000u);
}

TEST(FanSums, SumAreasAndRims) {
  FanSums fan;
  fan.AddFace({Pair{3, 0}, Pair{0, 4}, Pair{0, 0}});
  EXPECT_EQ(fan.area_rim[0], 12);
  EXPECT_EQ(fan.area_rim[1], 5);
  EXPECT_EQ(fan.normal(), (Vector3{0, 0, 12}));
  EXPECT_EQ(fan.area_centre_xy[0], 12);
  EXPECT_EQ(fan.area_centre_xy[1], 16);
  EXPECT_EQ(fan.rim_centre_xy[0], 7.5);
  EXPECT_EQ(fan.rim_centre_xy[1], 10);
  EXPECT_EQ(fan.centre_z[0], 0);
  EXPECT_EQ(fan.centre_z[1], 0);
}

TEST(FanFace, CrossesItsSidesLaneByLane) {
  const Vector3 a{3, -7, 11}, b{-5, 13, 2};
  const FanFace face(Pair{a[0], a[1]}, Pair{b[0], b[1]}, Pair{a[2], b[2]});
  EXPECT_EQ((Vector3{face.cross_xy[0], face.cross_xy[1], face.cross_z}), Cross(a, b));
}

}  // namespace
}  // namespace folprom
