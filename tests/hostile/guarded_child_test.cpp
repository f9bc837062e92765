// The guard itself sees what it is there to see.
#include "tests/hostile/guarded_child.h"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>
#include <vector>

namespace folprom::hostile {
namespace {

TEST(GuardedChild, NamesEachCaseThatCrashesThrowsOrBreaksItsPromise) {
  const std::string faults = RunGuarded(6, 20, 0, [](size_t i) {
    if (i == 1) std::raise(SIGKILL);
    if (i == 2) throw std::runtime_error("thrown");
    return i != 4;
  });
  EXPECT_EQ(faults, "case 1 killed by signal 9\ncase 2 throws\ncase 4 breaks its promise\n");
}

TEST(GuardedChild, EndsACaseThatHangs) {
  volatile bool for_ever = true;
  const std::string faults = RunGuarded(2, 1, 0, [&](size_t i) {
    while (i == 0 && for_ever) {
    }
    return true;
  });
  EXPECT_EQ(faults, "case 0 still running after 1 s\n");
}

TEST(GuardedChild, SeesAFloodOfMemory) {
  if (!kMeasuresMemory) GTEST_SKIP() << "a sanitizer's own memory would be counted";
  const std::string faults = RunGuarded(2, 20, uint64_t{16} << 20, [](size_t i) {
    std::vector<char> flood(i == 0 ? size_t{64} << 20 : 1, 1);
    return flood.back() == 1;
  });
  EXPECT_EQ(faults.find("case 0 memory grows by "), 0u) << faults;
  EXPECT_EQ(faults.find("case 1"), std::string::npos) << faults;
}

}  // namespace
}  // namespace folprom::hostile
