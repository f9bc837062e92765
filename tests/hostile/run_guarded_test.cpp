#include "engine/run_guarded.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace folprom {
namespace {

template <class Thrown>
Error ErrorOf(const Thrown& thrown) {
  return RunGuarded<int>([&]() -> int { throw thrown; }).error();
}

TEST(RunGuarded, LetsNoExceptionOut) {
  EXPECT_EQ(ErrorOf(Failure(ErrorKind::kCorrupt, "cut")).kind, ErrorKind::kCorrupt);
  EXPECT_EQ(ErrorOf(parallel::Cancelled()).kind, ErrorKind::kInterrupted);
  EXPECT_EQ(ErrorOf(std::bad_alloc()).kind, ErrorKind::kLimit);
  const Error error = ErrorOf(std::out_of_range("index 7"));
  EXPECT_EQ(error.kind, ErrorKind::kInternal);
  EXPECT_EQ(error.message, "index 7");
  EXPECT_EQ(RunGuarded<int>([] { return 3; }).value(), 3);
}

}  // namespace
}  // namespace folprom
