#include "folprom/settings.h"

#include <gtest/gtest.h>

#include <limits>

namespace folprom {
namespace {

/// Message of the kUsage error; "" where there is none.
std::string UsageErrorOf(const EncodeOptions& options) {
  const Result<void> checked = CheckOptions(options);
  if (checked.ok()) return "";
  EXPECT_EQ(checked.error().kind, ErrorKind::kUsage);
  return checked.error().message;
}

TEST(CheckOptions, RefusesBitsOutOfRange) {
  for (uint32_t bits : {1u, 12u, 24u}) {
    EncodeOptions options;
    options.bits = bits;
    EXPECT_EQ(UsageErrorOf(options), "") << bits;
  }
  for (uint32_t bits : {0u, 25u, 64u, 0xffffffffu}) {
    EncodeOptions options;
    options.bits = bits;
    EXPECT_NE(UsageErrorOf(options).find("bits is " + std::to_string(bits)), std::string::npos);
  }
}

TEST(CheckOptions, RefusesTolerancesThatAreNone) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (double tolerance : {0.0, 5e-324, 1.0, kLargestTolerance}) {
    EncodeOptions options;
    options.tolerance = tolerance;
    EXPECT_EQ(UsageErrorOf(options), "") << tolerance;
  }
  for (double tolerance :
       {-1.0, 1e41, 1.7e308, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    EncodeOptions options;
    options.tolerance = tolerance;
    EXPECT_NE(UsageErrorOf(options).find("tolerance"), std::string::npos) << tolerance;
  }
}

TEST(CheckOptions, RefusesExactWithoutLatticeOffsets) {
  EncodeOptions options;
  options.exact = true;
  EXPECT_EQ(UsageErrorOf(options), "");
  options.codec.offsets = Offsets::kCylindrical;
  EXPECT_NE(UsageErrorOf(options).find("exact"), std::string::npos);
  options.codec.hierarchy = Hierarchy::kLloyd;
  EXPECT_NE(UsageErrorOf(options).find("exact"), std::string::npos);
}

}  // namespace
}  // namespace folprom
