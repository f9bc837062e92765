// Keeps the worked example of FORMAT.md true.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "samples.h"

namespace folprom::io {
namespace {

/// The hex bytes of the ```hex block: each line up to its ';'.
std::vector<uint8_t> BytesOfTheExample() {
  std::ifstream page(FOLPROM_SOURCE_DIR "/io/container/FORMAT.md");
  std::vector<uint8_t> bytes;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("```")) {
      inside = line == "```hex";
      continue;
    }
    if (!inside) continue;
    std::istringstream words(line.substr(0, line.find(';')));
    for (std::string word; words >> word;) {
      bytes.push_back(static_cast<uint8_t>(std::stoul(word, nullptr, 16)));
    }
  }
  return bytes;
}

std::string Hex(std::span<const uint8_t> bytes) {
  std::ostringstream text;
  for (size_t i = 0; i < bytes.size(); ++i) {
    static const char* const digits = "0123456789abcdef";
    text << digits[bytes[i] >> 4] << digits[bytes[i] & 15] << (i % 16 == 15 ? '\n' : ' ');
  }
  return text.str();
}

TEST(FormatPage, ItsExampleIsWhatTheWriterWrites) {
  const auto file = SampleFile(ExampleTable());
  const auto example = BytesOfTheExample();
  ASSERT_FALSE(example.empty());
  EXPECT_EQ(Hex(example), Hex(std::span(file).first(example.size())));
}

}  // namespace
}  // namespace folprom::io
