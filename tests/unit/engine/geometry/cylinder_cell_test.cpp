#include "engine/geometry/cylinder_cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

namespace folprom {
namespace {

constexpr int32_t kMost = (1 << 30) - 1;
constexpr Int3 kExtent{kMost, kMost, kMost};

LocalFrame RandomFrame(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  auto unit = [](Vector3 v) {
    const double length = std::sqrt(Dot(v, v));
    return Vector3{v[0] / length, v[1] / length, v[2] / length};
  };
  LocalFrame frame;
  frame.origin = {1 << 29, 1 << 29, 1 << 29};
  frame.z = unit({normal(random), normal(random), normal(random)});
  frame.x = unit(Cross(frame.z, {normal(random), normal(random), normal(random)}));
  return frame;
}

CylinderCell RandomCell(std::mt19937_64& random) {
  std::uniform_real_distribution<double> part(0, 1);
  const double size = std::exp2(part(random) * 18 + 6);
  CylinderCell cell;
  cell.frame = RandomFrame(random);
  cell.width = {size * part(random), 2 * kPi / static_cast<double>(2 + random() % 60),
                size * part(random)};
  cell.centre = {cell.width.rho * (static_cast<double>(random() % 40) + 0.5),
                 cell.width.theta * static_cast<double>(random() % 60),
                 cell.width.z * (static_cast<double>(random() % 40) - 20)};
  while (cell.centre.theta >= 2 * kPi) cell.centre.theta -= 2 * kPi;
  return cell;
}

CylinderPoint PointIn(const CylinderCell& cell, std::mt19937_64& random) {
  std::uniform_real_distribution<double> half(-0.5, 0.5);
  CylinderPoint point{cell.centre.rho + half(random) * cell.width.rho,
                      cell.centre.theta + half(random) * cell.width.theta,
                      cell.centre.z + half(random) * cell.width.z};
  point.rho = std::max(point.rho, 0.0);
  if (point.theta < 0) point.theta += 2 * kPi;
  if (point.theta >= 2 * kPi) point.theta -= 2 * kPi;
  return point;
}

double Turn(double a, double b) {
  const double off = std::fabs(a - b);
  return std::min(off, 2 * kPi - off);
}

bool Contains(const CylinderCell& cell, const CylinderPoint& p) {
  constexpr double kSlack = 1 + 1e-9;
  return std::fabs(p.rho - cell.centre.rho) <= cell.width.rho / 2 * kSlack + 1e-9 &&
         Turn(p.theta, cell.centre.theta) <= cell.width.theta / 2 * kSlack + 1e-9 &&
         std::fabs(p.z - cell.centre.z) <= cell.width.z / 2 * kSlack + 1e-9;
}

Vector3 InSpace(const LocalFrame& frame, const CylinderPoint& p) {
  const double u = p.rho * std::cos(p.theta), v = p.rho * std::sin(p.theta);
  const Vector3 y = frame.y();
  return {u * frame.x[0] + v * y[0] + p.z * frame.z[0],
          u * frame.x[1] + v * y[1] + p.z * frame.z[1],
          u * frame.x[2] + v * y[2] + p.z * frame.z[2]};
}

TEST(CylinderCell, KeepsThePointInsideWhenHalved) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 2000; ++round) {
    CylinderCell cell = RandomCell(random);
    const CylinderPoint point = PointIn(cell, random);
    ASSERT_TRUE(Contains(cell, point));
    for (int i = 0; i < 40; ++i) {
      const auto dimension = cell.Longest();
      cell.Halve(dimension, cell.LiesInUpper(dimension, point));
      ASSERT_TRUE(Contains(cell, point)) << round << " after " << i + 1;
    }
  }
}

TEST(CylinderCell, KeepsAPointBesideTheFullTurnInside) {
  CylinderCell cell;
  cell.centre = {100, 0, 0};
  cell.width = {10, 1, 10};
  for (double theta : {0.0, 0.4, 2 * kPi - 0.4, 2 * kPi - 1e-9, 1e-9}) {
    CylinderCell halved = cell;
    const CylinderPoint point{101, theta, 1};
    for (int i = 0; i < 30; ++i) {
      halved.Halve(CylinderCell::kTheta, halved.LiesInUpper(CylinderCell::kTheta, point));
      ASSERT_TRUE(Contains(halved, point)) << theta;
    }
  }
}

TEST(CylinderCell, AxisBoundHoldsForEveryPointInside) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 3000; ++round) {
    CylinderCell cell = RandomCell(random);
    for (uint64_t halvings = random() % 30; halvings > 0; --halvings) {
      cell.Halve(static_cast<CylinderCell::Dimension>(random() % 3), random() % 2 == 0);
    }
    const Vector3 centre = InSpace(cell.frame, cell.centre);
    const double bound = cell.AxisBound();
    for (int i = 0; i < 60; ++i) {
      CylinderPoint point = PointIn(cell, random);
      if (i < 8) {  // the corners
        point = {cell.centre.rho + ((i & 1) != 0 ? 0.5 : -0.5) * cell.width.rho,
                 cell.centre.theta + ((i & 2) != 0 ? 0.5 : -0.5) * cell.width.theta,
                 cell.centre.z + ((i & 4) != 0 ? 0.5 : -0.5) * cell.width.z};
      }
      const Vector3 inside = InSpace(cell.frame, point);
      for (size_t k = 0; k < 3; ++k) {
        ASSERT_LE(std::fabs(inside[k] - centre[k]), bound * (1 + 1e-9) + 1e-6) << round;
      }
    }
  }
}

TEST(CylinderCell, BecomesAsSmallAsWantedByHalvingTheLongest) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 2000; ++round) {
    CylinderCell cell = RandomCell(random);
    const CylinderPoint point = PointIn(cell, random);
    int halvings = 0;
    while (cell.AxisBound() > 30.5) {
      const auto dimension = cell.Longest();
      cell.Halve(dimension, cell.LiesInUpper(dimension, point));
      ASSERT_LT(++halvings, 200);
    }
    const Vector3 inside = InSpace(cell.frame, point);
    const Int3 position = cell.Position(kExtent);
    const int32_t found[3] = {position.x, position.y, position.z};
    const int32_t origin[3] = {cell.frame.origin.x, cell.frame.origin.y, cell.frame.origin.z};
    for (size_t k = 0; k < 3; ++k) {
      const double wanted = origin[k] + inside[k];
      if (wanted < 0 || wanted > kMost) continue;
      EXPECT_LE(std::fabs(found[k] - wanted), 31.001);
    }
  }
}

TEST(CylinderCell, CartesianKeepsThePointInsideAndWithinItsBound) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> part(-0.5, 0.5);
  for (int round = 0; round < 2000; ++round) {
    CylinderCell cell;
    cell.frame = RandomFrame(random);
    cell.frame.cartesian = true;
    auto draw = [&] { return static_cast<double>(random() % 100000); };
    cell.width = {draw(), draw(), draw()};
    cell.centre = {draw() - 5e4, draw() - 5e4, draw() - 5e4};
    const CylinderPoint point{cell.centre.rho + part(random) * cell.width.rho,
                              cell.centre.theta + part(random) * cell.width.theta,
                              cell.centre.z + part(random) * cell.width.z};
    while (true) {
      const Vector3 off{point.rho - cell.centre.rho, point.theta - cell.centre.theta,
                        point.z - cell.centre.z};
      ASSERT_LE(std::fabs(off[0]), cell.width.rho / 2 * (1 + 1e-9) + 1e-9);
      ASSERT_LE(std::fabs(off[1]), cell.width.theta / 2 * (1 + 1e-9) + 1e-9);
      ASSERT_LE(std::fabs(off[2]), cell.width.z / 2 * (1 + 1e-9) + 1e-9);
      const Vector3 y = cell.frame.y();
      for (size_t k = 0; k < 3; ++k) {
        const double along = off[0] * cell.frame.x[k] + off[1] * y[k] + off[2] * cell.frame.z[k];
        ASSERT_LE(std::fabs(along), cell.AxisBound() * (1 + 1e-9) + 1e-6);
      }
      if (cell.AxisBound() <= 30.5) break;
      const auto dimension = cell.Longest();
      cell.Halve(dimension, cell.LiesInUpper(dimension, point));
    }
  }
}

TEST(CylinderCell, CartesianPointsGoThereAndBack) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 5000; ++round) {
    CylinderCell cell;
    cell.frame = RandomFrame(random);
    cell.frame.cartesian = true;
    auto draw = [&] { return static_cast<int32_t>(random() % kMost); };
    const Int3 point{draw(), draw(), draw()};
    cell.centre = ToCylinder(cell.frame, point);
    const Int3 back = cell.Position(kExtent);
    EXPECT_LE(std::max({std::abs(back.x - point.x), std::abs(back.y - point.y),
                        std::abs(back.z - point.z)}),
              1);
  }
}

TEST(CylinderCell, PositionStaysOnTheLattice) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 5000; ++round) {
    CylinderCell cell = RandomCell(random);
    const double blow = std::exp2(static_cast<double>(random() % 64));
    cell.centre.rho *= blow;
    cell.centre.z *= blow;
    const Int3 extent{static_cast<int32_t>(random() % kMost), 0, kMost};
    const Int3 p = cell.Position(extent);
    EXPECT_TRUE(p.x >= 0 && p.x <= extent.x && p.y == 0 && p.z >= 0 && p.z <= extent.z);
  }
}

TEST(CylinderCell, PointsGoToTheCylinderAndBack) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 5000; ++round) {
    const LocalFrame frame = RandomFrame(random);
    auto draw = [&] { return static_cast<int32_t>(random() % kMost); };
    const Int3 point{draw(), draw(), draw()};
    const CylinderPoint local = ToCylinder(frame, point);
    ASSERT_GE(local.theta, 0);
    ASSERT_LT(local.theta, 2 * kPi);
    CylinderCell cell;
    cell.frame = frame;
    cell.centre = local;
    const Int3 back = cell.Position(kExtent);
    EXPECT_LE(std::max({std::abs(back.x - point.x), std::abs(back.y - point.y),
                        std::abs(back.z - point.z)}),
              1);
  }
}

}  // namespace
}  // namespace folprom
