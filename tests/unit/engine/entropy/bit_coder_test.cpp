#include "engine/entropy/bit_coder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace folprom {
namespace {

struct Decision {
  uint32_t probability;
  bool bit;
};

std::vector<Decision> RandomDecisions(uint64_t seed, size_t count) {
  std::mt19937_64 random(seed);
  std::vector<Decision> decisions;
  for (size_t i = 0; i < count; ++i) {
    constexpr uint32_t kExtremes[] = {1, 2, 32767, 32768, 65534, 65535};
    uint32_t probability =
        random() % 4 == 0 ? kExtremes[random() % 6] : 1 + static_cast<uint32_t>(random() % 65535);
    // Mostly what the probability says; sometimes against it.
    bool bit = random() % 65536 < probability;
    if (random() % 50 == 0) bit = !bit;
    decisions.push_back({probability, bit});
  }
  return decisions;
}

std::vector<uint8_t> Coded(const std::vector<Decision>& decisions) {
  BitEncoder encoder;
  for (const Decision& d : decisions) EXPECT_EQ(encoder.Code(d.probability, d.bit), d.bit);
  return encoder.TakeSegment();
}

void ExpectDecodes(const std::vector<uint8_t>& bytes, const std::vector<Decision>& decisions) {
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (size_t i = 0; i < decisions.size(); ++i) {
    ASSERT_EQ(decoder.Code(decisions[i].probability), decisions[i].bit) << "decision " << i;
  }
}

/// Bits that a coder without loss would take.
double Entropy(const std::vector<Decision>& decisions) {
  double bits = 0;
  for (const Decision& d : decisions) {
    double p = d.probability / 65536.0;
    bits -= std::log2(d.bit ? p : 1 - p);
  }
  return bits;
}

TEST(BitCoder, GivesBackDecisionsOfEveryProbability) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const auto decisions = RandomDecisions(seed, 20000);
    ExpectDecodes(Coded(decisions), decisions);
  }
}

TEST(BitCoder, GivesBackShortSegmentsOfEveryLength) {
  for (uint64_t seed = 0; seed < 3000; ++seed) {
    const auto decisions = RandomDecisions(seed, seed % 60);
    ExpectDecodes(Coded(decisions), decisions);
  }
}

TEST(BitCoder, GivesBackTheImprobableAndTheCertain) {
  for (bool bit : {false, true}) {
    for (uint32_t probability : {1u, 65535u}) {
      const std::vector<Decision> decisions(5000, {probability, bit});
      ExpectDecodes(Coded(decisions), decisions);
    }
  }
}

TEST(BitCoder, KeepsSegmentsApart) {
  BitEncoder encoder;
  std::vector<std::vector<Decision>> parts;
  std::vector<std::vector<uint8_t>> segments;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    parts.push_back(RandomDecisions(seed, seed % 7 == 0 ? 0 : seed));
    for (const Decision& d : parts.back()) encoder.Code(d.probability, d.bit);
    segments.push_back(encoder.TakeSegment());
  }
  BitDecoder decoder;
  for (size_t i = 0; i < parts.size(); ++i) {
    decoder.StartSegment(segments[i]);
    for (const Decision& d : parts[i]) ASSERT_EQ(decoder.Code(d.probability), d.bit);
  }
}

TEST(BitCoder, TakesAtMostTwoBytesMoreThanTheEntropy) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const auto decisions = RandomDecisions(seed, 5000);
    const double bytes = Entropy(decisions) / 8;
    // A 64-bit interval is never narrower than 2^48 when it is halved as 1/65536 says.
    EXPECT_LE(static_cast<double>(Coded(decisions).size()), bytes * 1.00001 + 2) << seed;
  }
}

TEST(BitCoder, TakesNoByteForNothingAndForWhatIsNearlyCertain) {
  EXPECT_EQ(Coded({}).size(), 0u);
  EXPECT_EQ(Coded({{65535, true}, {65535, true}}).size(), 0u);
  EXPECT_LE(Coded({{1, false}, {1, false}}).size(), 1u);
  EXPECT_LE(Coded({{32768, false}}).size(), 1u);
}

/// Other bytes may tell other decisions, but never the same ones.
TEST(BitCoder, RejectsASegmentThatIsLongerOrShorterThanItsContent) {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const auto decisions = RandomDecisions(seed, seed % 40);
    const std::vector<uint8_t> whole = Coded(decisions);
    const auto is_taken_for_it = [&](std::span<const uint8_t> segment) {
      BitDecoder decoder;
      decoder.StartSegment(segment);
      try {
        for (const Decision& d : decisions) {
          if (decoder.Code(d.probability) != d.bit) return false;
        }
        decoder.FinishSegment();
      } catch (const Failure&) {
        return false;
      }
      return true;
    };
    EXPECT_TRUE(is_taken_for_it(whole));
    for (size_t more = 1; more < 10; ++more) {
      for (int surplus : {0x00, 0x01, 0xa5, 0xff}) {
        std::vector<uint8_t> longer = whole;
        longer.resize(whole.size() + more, static_cast<uint8_t>(surplus));
        EXPECT_FALSE(is_taken_for_it(longer)) << seed << ' ' << more;
      }
    }
    if (whole.empty()) continue;
    EXPECT_FALSE(is_taken_for_it(std::span(whole).first(whole.size() - 1))) << seed;
  }
}

TEST(BitCoder, CountsDecisionsAlsoThoseWithoutBytes) {
  BitEncoder encoder;
  EXPECT_EQ(encoder.decisions(), 0u);
  encoder.Code(65535, true);
  EXPECT_EQ(encoder.TakeSegment().size(), 0u);
  EXPECT_EQ(encoder.decisions(), 1u);
}

TEST(BitCoder, MetersTheEntropyPerKind) {
  BitEncoder encoder;
  uint64_t meters[2] = {0, 0};
  std::vector<Decision> kinds[2];
  std::mt19937_64 random(5);
  for (int i = 0; i < 20000; ++i) {
    const size_t kind = random() % 2;
    const Decision d{1000 + static_cast<uint32_t>(random() % 60000), random() % 2 == 0};
    encoder.SetMeter(&meters[kind]);
    encoder.Code(d.probability, d.bit);
    kinds[kind].push_back(d);
  }
  for (size_t kind = 0; kind < 2; ++kind) {
    const double expected = Entropy(kinds[kind]);
    EXPECT_NEAR(static_cast<double>(meters[kind]) / 1024, expected, expected * 0.005);
  }
}

TEST(BitCoder, ThrowsWhenMoreIsAskedForThanTheSegmentHolds) {
  for (size_t size : {0u, 1u, 7u, 8u, 100u}) {
    const std::vector<uint8_t> bytes(size, 0x5a);
    BitDecoder decoder;
    decoder.StartSegment(bytes);
    try {
      for (size_t i = 0; i < (size + 9) * 8; ++i) decoder.Code(32768);
      FAIL() << size;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.error().kind, ErrorKind::kCorrupt);
    }
  }
}

TEST(BitCoder, DecodesAnyBytesToSomethingWithoutReadingBeyondThem) {
  std::mt19937_64 random(9);
  for (int i = 0; i < 500; ++i) {
    std::vector<uint8_t> bytes(random() % 40);
    for (auto& byte : bytes) byte = static_cast<uint8_t>(random());
    bytes.shrink_to_fit();
    BitDecoder decoder;
    decoder.StartSegment(bytes);
    try {
      for (int j = 0; j < 2000; ++j) decoder.Code(1 + static_cast<uint32_t>(random() % 65535));
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.error().kind, ErrorKind::kCorrupt);
    }
  }
}

}  // namespace
}  // namespace folprom
