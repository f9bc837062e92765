// Which decimals float32 holds, so that no digit of a text file is lost and none is coded in vain.
#include "io/formats/text_number.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "tests/support/random.h"

namespace folprom::io {
namespace {

bool IsFloat(const std::string& word) {
  double value = 0;
  EXPECT_TRUE(ParseReal(word, &value)) << word;
  return IsFloat32Decimal(word, value);
}

TEST(TextNumber, FindsFloatsInWhateverIsPrintedFromThem) {
  support::Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const float value = std::bit_cast<float>(static_cast<uint32_t>(random.Next()));
    if (std::isnan(value)) continue;
    char text[512];
    *std::to_chars(text, text + sizeof text, value).ptr = '\0';
    ASSERT_TRUE(IsFloat(text)) << text;
    for (const char* form : {"%.9g", "%.6g", "%.3g", "%f", "%.17g", "%.12e", "%.30f", "%.2f"}) {
      std::snprintf(text, sizeof text, form, static_cast<double>(value));
      ASSERT_TRUE(IsFloat(text)) << text;
    }
  }
}

TEST(TextNumber, FindsDoublesThatFloatsWouldRound) {
  for (const char* word : {"0.123456789", "4512345.12", "1.00000005", "353535.123456", "16777217",
                           "1e300", "-1e-300", "0.1000000000", "3.141592653589793", "1e39"}) {
    EXPECT_FALSE(IsFloat(word)) << word;
  }
  support::Random random(4);
  for (int i = 0; i < 20000; ++i) {
    const double value = random.Between(-1e6, 1e6);
    char text[64];
    *std::to_chars(text, text + sizeof text, value).ptr = '\0';
    ASSERT_EQ(IsFloat(text), static_cast<double>(static_cast<float>(value)) == value) << text;
  }
}

TEST(TextNumber, FindsFloatsInShortDecimals) {
  for (const char* word : {"0.1", "-500.000000", "0.041657", "1e-3", "+7", "-0", "123456", "1e5",
                           "1.17549e-38", "0", "0e-999999999999999999", "inf", "-nan", "1e400"}) {
    EXPECT_TRUE(IsFloat(word)) << word;
  }
}

TEST(TextNumber, TakesWholeWordsOnly) {
  double real = 0;
  int64_t integer = 0;
  for (const char* word : {"", "+", "-", "++1", "+-1", "1,5", "1.5x", "0x10", "1e", "e5", "."}) {
    EXPECT_FALSE(ParseReal(word, &real)) << word;
    EXPECT_FALSE(ParseInteger(word, &integer)) << word;
  }
  EXPECT_FALSE(ParseInteger("9223372036854775808", &integer));
  EXPECT_TRUE(ParseInteger("+5", &integer));
  EXPECT_EQ(integer, 5);
  EXPECT_TRUE(ParseReal("-1e999", &real));
  EXPECT_EQ(real, -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace folprom::io
