#include "engine/codec/leaf_model.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

struct Asked {
  LeafSigns signs;
  bool leaf;
};

/// Sets of a mesh whose edges are 10 long: leaves where the spacing says so.
std::vector<Asked> Regular(size_t count) {
  std::mt19937_64 random(5);
  std::vector<Asked> asked(count);
  for (Asked& one : asked) {
    one.leaf = random() % 2 == 0;
    one.signs.spacing = one.leaf ? 10 + static_cast<double>(random() % 3) : 17;
    one.signs.leaves = static_cast<uint32_t>(random() % 4);
    one.signs.others = 6 - one.signs.leaves;
    one.signs.leaf_spacing = one.signs.leaves > 0 ? 11 : 0;
    one.signs.leaf_distance = one.signs.leaves > 0 ? 12 : 0;
    one.signs.scale = 14;
  }
  return asked;
}

/// Light or not.
class LeafModelOf : public testing::TestWithParam<bool> {};

TEST_P(LeafModelOf, GivesEveryAnswerBackAndLearnsWhatSpacingsSay) {
  const std::vector<Asked> asked = Regular(4000);
  LeafModel written(GetParam()), read(GetParam());
  BitEncoder encoder;
  for (const Asked& one : asked) written.Code(encoder, one.signs, one.leaf);
  const auto bytes = encoder.TakeSegment();
  EXPECT_LT(bytes.size() * 8, asked.size() / 4);
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (const Asked& one : asked) ASSERT_EQ(read.Code(decoder, one.signs, false), one.leaf);
}

TEST_P(LeafModelOf, TakesSignsOfAnySize) {
  LeafModel written(GetParam()), read(GetParam());
  BitEncoder encoder;
  const std::vector<LeafSigns> extremes{
      {},
      {1e300, 1e-300, 1e300, 3e38, 1e-30, 4000000000u, 4000000000u},
      {0, 0, 0, 0, 0, 1, 0},
      {1e-300, 1e300, 0, 1e-300, 1e300, 0, 1}};
  for (const LeafSigns& signs : extremes) written.Code(encoder, signs, true);
  const auto bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (const LeafSigns& signs : extremes) EXPECT_TRUE(read.Code(decoder, signs, false));
}

INSTANTIATE_TEST_SUITE_P(FullAndLight, LeafModelOf, testing::Bool());

}  // namespace
}  // namespace folprom
