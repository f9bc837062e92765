#include "engine/geometry/lattice_coder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

FanFace FaceOf(const RingSpoke& a, const RingSpoke& b) {
  return {a.xy, b.xy, Pair{a.z_length[0], b.z_length[0]}};
}

/// A vertex to code: beside which, with what ring, how precisely.
struct Split {
  Int3 old, truth;
  RingShape ring;
  LatticePrecision precision;
};

struct Case {
  Int3 lo, hi;
  std::vector<Split> splits;
  LatticeSettings settings = {2, 1};
};

Case RandomCase(uint64_t seed, const Int3& lo, const Int3& hi, uint32_t most_shift) {
  std::mt19937_64 random(seed);
  Case result{lo, hi, {}};
  auto inside = [&](int32_t from, int32_t to) {
    return from + static_cast<int32_t>(random() % (static_cast<uint64_t>(to - from) + 1));
  };
  auto any = [&] { return Int3{inside(lo.x, hi.x), inside(lo.y, hi.y), inside(lo.z, hi.z)}; };
  auto beside = [&](const Int3& p, int32_t reach) {
    auto move = [&](int32_t at, int32_t from, int32_t to) {
      return std::clamp(at + inside(-reach, reach), from, to);
    };
    return Int3{move(p.x, lo.x, hi.x), move(p.y, lo.y, hi.y), move(p.z, lo.z, hi.z)};
  };
  for (int i = 0; i < 1500; ++i) {
    Split split;
    split.old = any();
    const int32_t reach = 1 << random() % 29;
    split.truth = i % 10 == 0 ? any() : (i % 17 == 0 ? split.old : beside(split.old, reach));
    std::vector<RingSpoke> ring;
    for (uint64_t n = i % 9 == 0 ? 40 : random() % 9; n > 0; --n) {
      const Int3 neighbour = i % 23 == 0 ? split.old : beside(split.old, reach);
      ring.push_back(SpokeBetween(LanePoint(split.old), LanePoint(neighbour)));
    }
    FanSums fan;
    for (size_t n = 0; n + 1 < ring.size(); ++n) {
      fan.AddFace(FaceOf(ring[n], ring[n + 1]));
    }
    split.ring = MeasureRing(ring, fan, static_cast<double>(reach));
    split.ring.is_open = i % 3 == 0;
    split.precision.tangential = static_cast<uint32_t>(random() % (most_shift + 1));
    split.precision.normal = static_cast<uint32_t>(random() % (most_shift + 1));
    result.splits.push_back(split);
  }
  return result;
}

/// Codes all vertices, then refines them by stages down to the lattice; positions of each stage.
template <class Coder>
std::vector<Int3> CodeAll(Coder& coder, const Case& input, uint64_t* cost) {
  LatticeCoder lattice(input.lo, input.hi, input.settings);
  lattice.AddExact();
  std::vector<Int3> known{input.lo}, all;
  for (const Split& split : input.splits) {
    const Int3 truth = Coder::kEncoding ? split.truth : Int3{};
    known.push_back(
        lattice.CodeNew(coder, split.old, split.ring, split.precision, truth, cost, cost));
  }
  all = known;
  for (uint32_t shift : {20u, 9u, 3u, 0u}) {
    const LatticePrecision precision{shift, shift / 2};
    for (uint32_t v = 1; v < known.size(); ++v) {
      const Split& split = input.splits[v - 1];
      if (lattice.IsCoarser(v, precision)) {
        known[v] = lattice.Refine(coder, v, known[v], split.ring, precision,
                                  Coder::kEncoding ? split.truth : Int3{});
      }
    }
    all.insert(all.end(), known.begin(), known.end());
  }
  EXPECT_FALSE(lattice.IsCoarser(0, {0, 0}));
  return all;
}

void ExpectRoundTrip(const Case& input) {
  uint64_t cost = 0;
  BitEncoder encoder;
  const std::vector<Int3> written = CodeAll(encoder, input, &cost);
  const std::vector<uint8_t> bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  const std::vector<Int3> read = CodeAll(decoder, input, nullptr);
  decoder.FinishSegment();
  ASSERT_EQ(written, read);
  for (const Int3& p : read) {
    ASSERT_TRUE(p.x >= input.lo.x && p.y >= input.lo.y && p.z >= input.lo.z);
    ASSERT_TRUE(p.x <= input.hi.x && p.y <= input.hi.y && p.z <= input.hi.z);
  }
  // At the end all is exact, and at first within the cells.
  const size_t count = input.splits.size(), last = read.size() - count;
  for (size_t i = 0; i < count; ++i) {
    const Split& split = input.splits[i];
    ASSERT_EQ(read[last + i], split.truth) << i;
    const uint32_t shift = std::max(split.precision.tangential, split.precision.normal);
    ASSERT_EQ(read[1 + i].x >> shift, split.truth.x >> shift);
    ASSERT_EQ(read[1 + i].y >> shift, split.truth.y >> shift);
    ASSERT_EQ(read[1 + i].z >> shift, split.truth.z >> shift);
  }
}

TEST(LatticeCoder, RandomVerticesComeBackAndEndExact) {
  constexpr int32_t kMost = (1 << 30) - 1;
  ExpectRoundTrip(RandomCase(1, {0, 0, 0}, {kMost, kMost, kMost}, 30));
  ExpectRoundTrip(RandomCase(2, {12345, 777, 5}, {1012345, 34567, 1003}, 12));
  ExpectRoundTrip(RandomCase(3, {1000, 1000, 1000}, {1007, 1003, 1001}, 5));
}

TEST(LatticeCoder, RandomVerticesComeBackWithEverySetting) {
  for (uint32_t step = 0; step <= 4; ++step) {
    for (uint32_t mixers : {1u, 2u, 3u}) {
      Case input = RandomCase(8, {12345, 777, 5}, {1012345, 34567, 1003}, 12);
      input.settings = {step, mixers};
      ExpectRoundTrip(input);
    }
  }
}

TEST(LatticeCoder, RandomVerticesComeBackWithLightModels) {
  constexpr int32_t kMost = (1 << 30) - 1;
  for (Case input : {RandomCase(9, {0, 0, 0}, {kMost, kMost, kMost}, 30),
                     RandomCase(10, {12345, 777, 5}, {1012345, 34567, 1003}, 12),
                     RandomCase(11, {1000, 1000, 1000}, {1007, 1003, 1001}, 5),
                     RandomCase(12, {5, 9, 13}, {100005, 9, 100013}, 20),
                     RandomCase(13, {5, 9, 13}, {5, 9, 13}, 30)}) {
    input.settings = {0, 1, true};
    ExpectRoundTrip(input);
  }
}

TEST(LatticeCoder, FlatBoxAndBoxOfOnePointComeBack) {
  ExpectRoundTrip(RandomCase(4, {5, 9, 13}, {100005, 9, 100013}, 20));
  ExpectRoundTrip(RandomCase(5, {5, 9, 13}, {5, 9, 13}, 30));
}

TEST(LatticeCoder, BoxOfOnePointCostsNothing) {
  uint64_t cost = 0;
  BitEncoder encoder;
  CodeAll(encoder, RandomCase(6, {5, 9, 13}, {5, 9, 13}, 0), &cost);
  EXPECT_EQ(encoder.decisions(), 0u);
  EXPECT_EQ(cost, 0u);
}

TEST(LatticeCoder, CoarserMeansOnAnyAxisThanTheFinerOfThePrecisions) {
  Case input = RandomCase(7, {0, 0, 0}, {1 << 20, 1 << 20, 1 << 20}, 10);
  LatticeCoder lattice(input.lo, input.hi, input.settings);
  uint64_t cost = 0;
  BitEncoder encoder;
  const Split& split = input.splits[0];
  lattice.CodeNew(encoder, split.old, split.ring, {8, 4}, split.truth, &cost, &cost);
  EXPECT_FALSE(lattice.IsCoarser(0, {9, 8}));
  EXPECT_TRUE(lattice.IsCoarser(0, {8, 4}));
  EXPECT_TRUE(lattice.IsCoarser(0, {7, 7}));
}

}  // namespace
}  // namespace folprom
