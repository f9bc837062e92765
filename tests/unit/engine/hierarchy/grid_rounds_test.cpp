#include "engine/hierarchy/grid_rounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

namespace folprom {
namespace {

constexpr uint32_t kColumns = 40, kRows = 33;

struct Grid {
  std::vector<Int3> positions;
  std::vector<Face> faces;
  std::vector<uint32_t> place;  ///< row * kColumns + column, per vertex
};

/// Columns lie twice as far from each other as rows. Vertices and faces are in random order, the
/// corners of faces turned, and one cell is missing.
Grid MakeGrid() {
  std::mt19937 random(1);
  Grid grid;
  std::vector<uint32_t> number(kColumns * kRows);
  std::iota(number.begin(), number.end(), 0u);
  std::shuffle(number.begin(), number.end(), random);
  grid.positions.resize(number.size());
  grid.place.resize(number.size());
  for (uint32_t i = 0; i < number.size(); ++i) {
    const auto row = static_cast<int32_t>(i / kColumns),
               column = static_cast<int32_t>(i % kColumns);
    grid.positions[number[i]] = {200 * column, 100 * row, 5000};
    grid.place[number[i]] = i;
    if (column + 1 == kColumns || row + 1 == kRows || i == 500) continue;
    const uint32_t a = number[i], b = number[i + 1], c = number[i + kColumns];
    grid.faces.push_back({b, c, a});
    grid.faces.push_back({number[i + kColumns + 1], c, b});
  }
  std::shuffle(grid.faces.begin(), grid.faces.end(), random);
  return grid;
}

TEST(GridRounds, RemoveEverySecondRowThenColumnWhateverLiesCloser) {
  const Grid grid = MakeGrid();
  const auto rounds = PlanGridRounds(grid.positions, grid.faces, 3);
  ASSERT_EQ(rounds.size(), 3u);
  // Rows lie half as far from each other, so they go first, and of the rest the columns beside
  // them.
  const uint32_t row_step[] = {1, 2, 0}, column_step[] = {0, 0, 1};
  std::set<uint32_t> left;
  for (uint32_t v = 0; v < grid.place.size(); ++v) left.insert(v);
  for (size_t round = 0; round < 2; ++round) {
    std::set<uint32_t> removed;
    for (const GridStep& step : rounds[round]) {
      EXPECT_TRUE(left.count(step.vertex) == 1);
      removed.insert(step.vertex);
      for (uint32_t target : step.targets) {
        if (target == GridStep::kNoTarget) continue;
        const auto rows = static_cast<int32_t>(grid.place[step.vertex] / kColumns) -
                          static_cast<int32_t>(grid.place[target] / kColumns);
        const auto columns = static_cast<int32_t>(grid.place[step.vertex] % kColumns) -
                             static_cast<int32_t>(grid.place[target] % kColumns);
        if (round == 0) {
          EXPECT_EQ(static_cast<uint32_t>(std::abs(rows)), row_step[round]);
          EXPECT_EQ(static_cast<uint32_t>(std::abs(columns)), column_step[round]);
        }
        EXPECT_TRUE(removed.count(target) == 0) << "both ends go in one round";
      }
    }
    const double share = static_cast<double>(removed.size()) / static_cast<double>(left.size());
    EXPECT_NEAR(share, 0.5, 0.05);
    for (uint32_t v : removed) left.erase(v);
  }
}

TEST(GridRounds, LeaveOneVertexInSixtyFourAfterSix) {
  const Grid grid = MakeGrid();
  size_t left = grid.positions.size();
  for (const auto& round : PlanGridRounds(grid.positions, grid.faces, 6)) left -= round.size();
  EXPECT_LE(left, grid.positions.size() / 40);
}

TEST(GridRounds, AreNoneWhereDiagonalsChange) {
  Grid grid = MakeGrid();
  grid.faces.clear();
  std::vector<uint32_t> number(grid.place.size());
  for (uint32_t v = 0; v < grid.place.size(); ++v) number[grid.place[v]] = v;
  std::mt19937 random(2);
  for (uint32_t i = 0; i + kColumns < number.size(); ++i) {
    if (i % kColumns + 1 == kColumns) continue;
    const uint32_t a = number[i], b = number[i + 1];
    const uint32_t c = number[i + kColumns], d = number[i + kColumns + 1];
    if (random() % 4 == 0) {
      grid.faces.push_back({a, b, d});
      grid.faces.push_back({a, d, c});
    } else {
      grid.faces.push_back({a, b, c});
      grid.faces.push_back({b, d, c});
    }
  }
  EXPECT_TRUE(PlanGridRounds(grid.positions, grid.faces, 6).empty());
}

TEST(GridRounds, AreNoneWithoutFacesOrWithDegenerateOnes) {
  EXPECT_TRUE(PlanGridRounds({}, {}, 6).empty());
  const std::vector<Int3> positions(70, Int3{1, 2, 3});
  std::vector<Face> faces;
  EXPECT_TRUE(PlanGridRounds(positions, faces, 6).empty());
  for (uint32_t v = 0; v < 70; ++v) faces.insert(faces.end(), 6, {v, v, (v + 1) % 70});
  EXPECT_TRUE(PlanGridRounds(positions, faces, 6).empty());
}

}  // namespace
}  // namespace folprom
