#include "engine/codec/rest_coder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

struct Given final : RestTruth {
  ExactLattice lattice;
  std::vector<ExactPosition> exact;
  std::vector<Int3> positions;

  Given(uint32_t radix, int32_t exponent, std::vector<ExactPosition> coordinates)
      : lattice{{radix, exponent, false, true}, {-1000000, -1000000, -1000000}},
        exact(std::move(coordinates)) {
    for (size_t v = 0; v < exact.size(); ++v) {
      positions.push_back({At(v, 0).k, At(v, 1).k, At(v, 2).k});
    }
  }
  ExactLattice::Coordinate At(size_t vertex, size_t axis) const {
    return lattice.Split(axis, 1 << 29, exact[vertex][axis]);
  }
  CoordinateRest Rest(uint32_t set, size_t axis) const override { return At(set, axis).rest; }
};

/// Codes there and back; returns the bytes.
size_t ExpectBack(const Given& given) {
  BitEncoder encoder;
  RestCoder(given.lattice).Code(encoder, given.positions, &given);
  const std::vector<uint8_t> bytes = encoder.TakeSegment();
  BitDecoder decoder;
  decoder.StartSegment(bytes);
  const auto decoded = RestCoder(given.lattice).Code(decoder, given.positions, nullptr);
  decoder.FinishSegment();
  EXPECT_EQ(decoded.size(), given.exact.size());
  EXPECT_EQ(std::memcmp(decoded.data(), given.exact.data(), decoded.size() * sizeof decoded[0]), 0);
  return bytes.size();
}

std::vector<ExactPosition> Coordinates(size_t count, double (*make)(std::mt19937_64&)) {
  std::mt19937_64 random(1);
  std::vector<ExactPosition> all(count);
  for (ExactPosition& position : all) position = {make(random), make(random), make(random)};
  return all;
}

TEST(RestCoder, CostsNothingOnTheLattice) {
  const auto on = [](std::mt19937_64& random) {
    return static_cast<double>(random() % 1000) / 100;
  };
  EXPECT_LE(ExpectBack({10, 2, Coordinates(5000, on)}), 60u);
}

TEST(RestCoder, CostsADecimalForADecimal) {
  // One further digit below 1, none from there on, as "%g" prints.
  const auto printed = [](std::mt19937_64& random) {
    return random() % 2 == 0 ? static_cast<double>(random() % 900 + 100) / 100
                             : static_cast<double>(random() % 900 + 100) / 1000;
  };
  const double bits = 8.0 * static_cast<double>(ExpectBack({10, 2, Coordinates(5000, printed)}));
  EXPECT_LT(bits / 15000, 0.5 * 3.33 + 0.3);
}

TEST(RestCoder, CostsTheBitsThatAFloatHasMore) {
  // 53 bits each, of which the lattice has the first 10 or so.
  const auto noise = [](std::mt19937_64& random) {
    return static_cast<double>(random() >> 11 | uint64_t{1} << 52) * 0x1p-53;
  };
  const double bits = 8.0 * static_cast<double>(ExpectBack({2, 10, Coordinates(5000, noise)}));
  EXPECT_LT(bits / 15000, 43.3);
}

TEST(RestCoder, GivesBackAnyBits) {
  const auto any = [](std::mt19937_64& random) { return std::bit_cast<double>(random()); };
  for (uint32_t radix : {2u, 10u}) ExpectBack({radix, 3, Coordinates(1000, any)});
}

TEST(RestCoder, RefusesOrDecodesWhateverItIsGiven) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 300; ++round) {
    std::vector<uint8_t> bytes(random() % 400);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random() & random());
    const uint32_t radix = round % 2 == 0 ? 2 : 10;
    const Given given(radix, 4, Coordinates(50, [](std::mt19937_64& r) {
                        return static_cast<double>(r() % 100) - 50;
                      }));
    BitDecoder decoder;
    decoder.StartSegment(bytes);
    try {
      RestCoder(given.lattice).Code(decoder, given.positions, nullptr);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.error().kind, ErrorKind::kCorrupt);
    }
  }
}

}  // namespace
}  // namespace folprom
