#include "engine/order/unused_set.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "tests/support/random.h"

namespace folprom {
namespace {

TEST(UnusedSet, CountsAndFindsAsAPlainSetDoes) {
  for (const uint32_t count : {0u, 1u, 63u, 64u, 511u, 512u, 513u, 5000u}) {
    UnusedSet unused(count);
    std::set<uint32_t> plain;
    for (uint32_t i = 0; i < count; ++i) plain.insert(i);
    support::Random random(count);
    for (int step = 0; step < 300 && !plain.empty(); ++step) {
      const auto number = static_cast<uint32_t>(random.Below(count));
      if (unused.Has(number)) {
        unused.Remove(number);
        plain.erase(number);
      } else if (random.Below(3) == 0) {
        unused.PutBack(number);
        plain.insert(number);
      }
      ASSERT_EQ(unused.left(), plain.size());
      const auto place = static_cast<uint32_t>(random.Below(count));
      const auto rank = std::distance(plain.begin(), plain.lower_bound(place));
      ASSERT_EQ(unused.Rank(place), static_cast<uint32_t>(rank));
      ASSERT_EQ(unused.Has(place), plain.count(place) == 1);
      if (plain.empty()) break;
      const auto nth = static_cast<uint32_t>(random.Below(plain.size()));
      ASSERT_EQ(unused.Select(nth), *std::next(plain.begin(), nth));
    }
  }
}

}  // namespace
}  // namespace folprom
