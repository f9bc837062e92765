#include "engine/codec/due_model.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

struct Asked {
  DueSigns signs;
  bool due;
};

/// Sets of an object with edges: due where the ring is bent, whatever the spacing.
std::vector<Asked> OnAnObject(size_t count) {
  std::mt19937_64 random(5);
  std::vector<Asked> asked(count);
  for (Asked& one : asked) {
    one.due = random() % 4 == 0;
    one.signs.spacing = 1 + static_cast<double>(random() % 8);
    one.signs.scale = 1 + static_cast<double>(random() % 8);
    one.signs.distortion = one.due ? 1.2 : 0.1;
    one.signs.asked = random() % 2 == 0;
    one.signs.waiting = static_cast<uint32_t>(random() % 6);
    one.signs.split = 6 - one.signs.waiting;
  }
  return asked;
}

TEST(DueModel, GivesEveryAnswerBackAndLearnsWhatRingsSay) {
  const std::vector<Asked> asked = OnAnObject(4000);
  DueModel written, read;
  BitEncoder encoder;
  for (const Asked& one : asked) written.Code(encoder, one.signs, one.due);
  const auto bytes = encoder.TakeSegment();
  EXPECT_LT(bytes.size() * 8, asked.size() / 4);
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (const Asked& one : asked) ASSERT_EQ(read.Code(decoder, one.signs, false), one.due);
}

TEST(DueModel, TakesSignsOfAnySize) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  DueModel written, read;
  BitEncoder encoder;
  const std::vector<DueSigns> extremes{{},
                                       {1e300, 1e-300, 1e300, true, 4000000000u, 4000000000u},
                                       {kInfinity, kInfinity, kInfinity, false, 4000000000u, 0},
                                       {1e-300, 0, 0, true, 0, 1}};
  for (const DueSigns& signs : extremes) written.Code(encoder, signs, true);
  const auto bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (const DueSigns& signs : extremes) EXPECT_TRUE(read.Code(decoder, signs, false));
}

}  // namespace
}  // namespace folprom
