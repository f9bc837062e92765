#include "engine/entropy/initial_statistics.h"

#include "engine/entropy/fixed_math.h"

namespace folprom {
namespace {

/// Codes, of which 0 is followed by how many of them there are.
constexpr int16_t kTrained[] = {
#include "engine/entropy/trained_statistics.inc"
};

/// Probabilities of the places in 1/2^22.
constexpr auto kProbability = [] {
  std::array<uint32_t, InitialStatistics::kPlaces> table{};
  for (int32_t i = 0; i < InitialStatistics::kPlaces; ++i) {
    const double p = 1 / (1 + ExpExact(-InitialStatistics::OddsAt(i)));
    table[static_cast<size_t>(i)] = static_cast<uint32_t>(p * (1 << 22));
  }
  return table;
}();

std::vector<int16_t> Unpacked() {
  std::vector<int16_t> codes;
  for (size_t i = 0; i < std::size(kTrained); ++i) {
    if (kTrained[i] != 0) {
      codes.push_back(kTrained[i]);
    } else {
      codes.resize(codes.size() + static_cast<size_t>(kTrained[++i]), 0);
    }
  }
  return codes;
}

}  // namespace

const InitialStatistics& InitialStatistics::Trained() {
  static const InitialStatistics trained{Unpacked()};
  return trained;
}

void StatisticsLoader::Decisions(std::span<uint32_t> states) {
  for (uint32_t& state : states) {
    const int16_t code = Next();
    if (code == 0) continue;
    const auto place = static_cast<size_t>(code - 1) / 8,
               confidence = static_cast<size_t>(code - 1) % 8;
    state = kProbability[place] << 10 | InitialStatistics::kConfidences[confidence];
  }
}

void StatisticsLoader::Values(std::span<int32_t> values, int32_t step) {
  for (int32_t& value : values) value += Next() * step;
}

void StatisticsLoader::Values(std::span<float> values, float step) {
  for (float& value : values) value += static_cast<float>(Next()) * step;
}

void StatisticsLoader::Values(std::span<double> values, double step) {
  for (double& value : values) value += Next() * step;
}

void StatisticsLoader::Scales(std::span<LearnedScale> scales) {
  for (LearnedScale& scale : scales) {
    const int16_t code = Next();
    if (code == 0) continue;
    scale.mean += code * InitialStatistics::kScaleStep;
    scale.count = InitialStatistics::kScaleConfidence;
  }
}

}  // namespace folprom
