#include "engine/entropy/mixed_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>
#include <vector>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

double EntropyOf(double p) { return -p * std::log2(p) - (1 - p) * std::log2(1 - p); }

/// Bits per decision after the model has seen `warm_up` of them.
template <size_t N, class Next>
double CostAfter(MixedModel<N>& model, int warm_up, int counted, Next next) {
  BitEncoder encoder;
  uint64_t before = 0, cost = 0;
  for (int i = 0; i < warm_up + counted; ++i) {
    encoder.SetMeter(i < warm_up ? &before : &cost);
    auto [contexts, set, bit] = next();
    model.Code(encoder, contexts, set, bit);
  }
  return static_cast<double>(cost) / 1024 / counted;
}

TEST(MixedModel, LearnsTheProbabilityOfOneContext) {
  for (double p : {0.02, 0.1, 0.3, 0.5, 0.9, 0.99}) {
    std::mt19937_64 random(1);
    std::bernoulli_distribution one(p);
    MixedModel<1> model({1});
    const double cost = CostAfter(model, 2000, 50000, [&] {
      return std::tuple(std::array<uint32_t, 1>{0}, 0u, one(random));
    });
    EXPECT_LT(cost, EntropyOf(p) * 1.02 + 0.01) << p;
  }
}

TEST(MixedModel, CostsNextToNothingForWhatIsAlwaysTheSame) {
  for (bool bit : {false, true}) {
    MixedModel<2> model({4, 4});
    const double cost = CostAfter(model, 1000, 10000, [&] {
      return std::tuple(std::array<uint32_t, 2>{1, 2}, 0u, bit);
    });
    EXPECT_LT(cost, 0.002);
  }
}

TEST(MixedModel, KeepsContextsApart) {
  std::mt19937_64 random(2);
  MixedModel<1> model({8});
  const double cost = CostAfter(model, 4000, 50000, [&] {
    uint32_t context = static_cast<uint32_t>(random() % 8);
    bool bit = std::bernoulli_distribution(context % 2 == 0 ? 0.05 : 0.95)(random);
    return std::tuple(std::array<uint32_t, 1>{context}, 0u, bit);
  });
  EXPECT_LT(cost, EntropyOf(0.05) * 1.03 + 0.01);
}

TEST(MixedModel, SecondMixerTrustsContextsThatHaveSeenMuch) {
  const auto cost_with = [](uint32_t mixers) {
    std::mt19937_64 random(5);
    MixedModel<2> model({4096, 1}, 1, mixers);
    return CostAfter(model, 500, 8000, [&] {
      // A few contexts tell, and are met often; what the others have seen once or twice is chance.
      const bool often = random() % 2 == 0;
      const auto context = static_cast<uint32_t>(often ? random() % 8 : 8 + random() % 4000);
      const double one = often ? (context % 2 == 0 ? 0.02 : 0.98) : 0.5;
      return std::tuple(std::array<uint32_t, 2>{context, 0}, 0u,
                        std::bernoulli_distribution(one)(random));
    });
  };
  EXPECT_LT(cost_with(2), 0.98 * cost_with(1));
}

TEST(MixedModel, ThirdMixerTrustsAContextWhereTheSecondOneSaysSo) {
  const auto cost_with = [](uint32_t mixers) {
    std::mt19937_64 random(6);
    MixedModel<3> model({16, 4, 16}, 1, mixers);
    return CostAfter(model, 2000, 30000, [&] {
      // The second context tells which of the two others tells.
      std::array<uint32_t, 3> contexts;
      for (uint32_t& context : contexts) context = static_cast<uint32_t>(random() % 16);
      contexts[1] %= 4;
      const bool one = (contexts[1] < 2 ? contexts[0] : contexts[2]) < 8;
      return std::tuple(contexts, 0u, std::bernoulli_distribution(one ? 0.95 : 0.05)(random));
    });
  };
  EXPECT_LT(cost_with(3), 0.95 * cost_with(2));
}

TEST(MixedModel, LearnsWhichContextToTrust) {
  std::mt19937_64 random(3);
  MixedModel<3> model({16, 16, 16});
  const double cost = CostAfter(model, 10000, 50000, [&] {
    const auto draw = [&] { return static_cast<uint32_t>(random() % 16); };
    std::array<uint32_t, 3> contexts{draw(), draw(), draw()};
    bool bit = std::bernoulli_distribution(contexts[1] < 8 ? 0.03 : 0.97)(random);
    return std::tuple(contexts, 0u, bit);
  });
  EXPECT_LT(cost, EntropyOf(0.03) * 1.1 + 0.02);
}

TEST(MixedModel, LearnsWhomToTrustPerSet) {
  std::mt19937_64 random(4);
  MixedModel<2> model({16, 16}, 2);
  const double cost = CostAfter(model, 10000, 50000, [&] {
    const auto draw = [&] { return static_cast<uint32_t>(random() % 16); };
    std::array<uint32_t, 2> contexts{draw(), draw()};
    uint32_t set = static_cast<uint32_t>(random() % 2);
    bool bit = std::bernoulli_distribution(contexts[set] < 8 ? 0.05 : 0.95)(random);
    return std::tuple(contexts, set, bit);
  });
  // A context is right in one set and noise in the other, so its own probability stays blurred.
  EXPECT_LT(cost, 0.75);
}

TEST(MixedModel, FollowsAChange) {
  std::mt19937_64 random(5);
  MixedModel<1> model({1});
  auto with = [&](double p) {
    return [&random, p] {
      return std::tuple(std::array<uint32_t, 1>{0}, 0u, std::bernoulli_distribution(p)(random));
    };
  };
  CostAfter(model, 0, 5000, with(0.05));
  EXPECT_LT(CostAfter(model, 2500, 20000, with(0.95)), EntropyOf(0.05) * 1.1 + 0.02);
}

TEST(MixedModel, DecoderLearnsTheSame) {
  std::mt19937_64 random(6);
  std::vector<std::tuple<std::array<uint32_t, 3>, uint32_t, bool>> decisions;
  for (int i = 0; i < 30000; ++i) {
    std::array<uint32_t, 3> contexts{static_cast<uint32_t>(random() % 5),
                                     static_cast<uint32_t>(random() % 50), 0};
    decisions.emplace_back(contexts, static_cast<uint32_t>(random() % 4),
                           random() % 50 < contexts[1]);
  }
  MixedModel<3> written({5, 50, 1}, 4), read({5, 50, 1}, 4);
  BitEncoder encoder;
  for (const auto& [contexts, set, bit] : decisions) written.Code(encoder, contexts, set, bit);
  const auto bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  for (const auto& [contexts, set, bit] : decisions) {
    ASSERT_EQ(read.Code(decoder, contexts, set, false), bit);
  }
}

}  // namespace
}  // namespace folprom
