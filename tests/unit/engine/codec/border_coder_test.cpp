#include "engine/codec/border_coder.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

/// A vertex with so many edges, and faces between neighbours that follow each other.
uint32_t AddStar(Complex& complex, uint32_t edges, uint32_t faces) {
  const uint32_t centre = complex.AddVertex();
  for (uint32_t n = 0; n < edges; ++n) complex.AddEdge(centre, complex.AddVertex());
  for (uint32_t n = 0; n < faces; ++n) {
    complex.AddFace(centre, centre + 1 + n % edges, centre + 1 + (n + 1) % edges);
  }
  return centre;
}

TEST(GapsOf, TellsWhereTheSurfaceEnds) {
  Complex complex;
  const uint32_t more_faces = AddStar(complex, 3, 4), closed = AddStar(complex, 6, 6),
                 open = AddStar(complex, 6, 5), torn = AddStar(complex, 6, 3);
  const std::vector<uint32_t> stars{more_faces, closed, open, torn};
  for (uint32_t a = 0; a < stars.size(); ++a) {
    for (uint32_t b = 0; b < stars.size(); ++b) {
      EXPECT_EQ(GapsOf(complex, stars[a], stars[b]), 4 * a + b);
    }
  }
}

struct Coded {
  BorderSplit split;
  uint32_t set = 0, first = kNone, second = kNone;
};

/// Splits of border sets at which open children touch other subtrees, in all cases but one in
/// eight.
std::vector<Coded> RandomSplits() {
  std::mt19937 random(3);
  std::vector<Coded> splits(4000);
  for (Coded& coded : splits) {
    const bool first_open = random() % 2 != 0, second_open = !first_open || random() % 2 != 0;
    const bool odd = random() % 8 == 0;
    coded.split.gaps = (first_open ? 8 : 4) + (second_open ? 2 : 1);
    coded.split.degree = random() % (BorderCoder::kMostDegree + 1);
    coded.split.first_touches = first_open || odd;
    coded.split.second_touches = second_open;
  }
  return splits;
}

TEST(BorderCoder, BordersComeBackAndGapsTellMostOfThem) {
  std::vector<Coded> splits = RandomSplits();
  BitEncoder encoder;
  uint64_t meter = 0;
  encoder.SetMeter(&meter);
  BorderCoder written;
  written.AddRoot({0, 0, 0});
  std::mt19937 random(5);
  for (Coded& coded : splits) {
    coded.set = random() % written.set_count();
    coded.first = coded.set;
    written.CodeSplit(encoder, coded.split, &coded.first, &coded.second);
    EXPECT_EQ(coded.first != kNone, coded.split.first_touches);
    EXPECT_EQ(coded.second != kNone, coded.split.second_touches);
  }
  const double bits = static_cast<double>(meter) / 1024;
  EXPECT_LT(bits, 0.5 * static_cast<double>(splits.size()));

  const std::vector<uint8_t> bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  BorderCoder read;
  read.AddRoot({0, 0, 0});
  for (const Coded& coded : splits) {
    BorderSplit split = coded.split;
    split.first_touches = split.second_touches = false;
    uint32_t first = coded.set, second = kNone;
    read.CodeSplit(decoder, split, &first, &second);
    ASSERT_EQ(first, coded.first);
    ASSERT_EQ(second, coded.second);
  }
  decoder.FinishSegment();
}

}  // namespace
}  // namespace folprom
