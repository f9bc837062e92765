#include "apps/train/merge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "engine/entropy/initial_statistics.h"

namespace folprom::train {
namespace {

constexpr size_t kPlaces = static_cast<size_t>(InitialStatistics::kPlaces);
constexpr size_t kConfidences = InitialStatistics::kConfidences.size();

/// Parameters of the beta distribution that each place and confidence stand for.
struct Beta {
  double a = 0, b = 0, log_beta = 0;
};

double LogBeta(double a, double b) { return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b); }

std::array<Beta, kPlaces * kConfidences> Betas() {
  std::array<Beta, kPlaces * kConfidences> betas;
  for (size_t place = 0; place < kPlaces; ++place) {
    const double p = 1 / (1 + std::exp(-InitialStatistics::OddsAt(static_cast<int32_t>(place))));
    for (size_t c = 0; c < kConfidences; ++c) {
      // The coder's states move by 1 / (n + 1.6).
      const double n = InitialStatistics::kConfidences[c] + 0.6;
      Beta& beta = betas[place * kConfidences + c];
      beta = {p * n, (1 - p) * n, 0};
      beta.log_beta = LogBeta(beta.a, beta.b);
    }
  }
  return betas;
}

int16_t MergeDecision(const std::vector<WeightedLesson>& lessons, size_t i) {
  static const auto betas = Betas();
  /// How much likelier a confidence has to be than the one of half its size.
  constexpr double kCaution = 0.5;
  struct Count {
    double trues, falses, weight;
  };
  std::vector<Count> counts;
  double trues = 0, all = 0;
  for (const WeightedLesson& lesson : lessons) {
    const Piece& piece = lesson.pieces[i];
    if (piece.count < 1) continue;
    counts.push_back({piece.value * piece.count, (1 - piece.value) * piece.count, lesson.weight});
    trues += lesson.weight * piece.value * piece.count;
    all += lesson.weight * piece.count;
  }
  if (counts.empty()) return 0;
  // Only places near the mean can be the best.
  const double mean = std::clamp(trues / all, 1e-4, 1 - 1e-4);
  const auto middle = static_cast<int32_t>(std::log(mean / (1 - mean)) / 0.2 + 32);
  const int32_t low = std::clamp(middle - 8, 0, InitialStatistics::kPlaces - 1);
  const int32_t high = std::clamp(middle + 8, 0, InitialStatistics::kPlaces - 1);
  double best = -1e300;
  size_t code = 0;
  for (auto place = static_cast<size_t>(low); place <= static_cast<size_t>(high); ++place) {
    for (size_t c = 0; c < kConfidences; ++c) {
      const Beta& beta = betas[place * kConfidences + c];
      double likely = -kCaution * static_cast<double>(c);
      for (const Count& count : counts) {
        likely +=
            count.weight * (LogBeta(beta.a + count.trues, beta.b + count.falses) - beta.log_beta);
      }
      if (likely > best) {
        best = likely;
        code = place * kConfidences + c;
      }
    }
  }
  return static_cast<int16_t>(1 + code);
}

int16_t MergeMean(const std::vector<WeightedLesson>& lessons, size_t i, bool by_count) {
  double sum = 0, all = 0;
  for (const WeightedLesson& lesson : lessons) {
    const Piece& piece = lesson.pieces[i];
    const double weight = lesson.weight * (by_count ? std::min(piece.count, 40.0) : 1);
    sum += weight * piece.value;
    all += weight;
  }
  if (!(all > 0)) return 0;
  return static_cast<int16_t>(std::clamp(std::round(sum / all), -32000.0, 32000.0));
}

}  // namespace

std::vector<int16_t> Merge(const std::vector<WeightedLesson>& lessons) {
  std::vector<int16_t> codes;
  const std::vector<Piece>& first = lessons.at(0).pieces;
  for (size_t i = 0; i < first.size(); ++i) {
    switch (first[i].kind) {
      case Kind::kDecision:
        codes.push_back(MergeDecision(lessons, i));
        break;
      case Kind::kValue:
        codes.push_back(MergeMean(lessons, i, false));
        break;
      case Kind::kScale:
        codes.push_back(MergeMean(lessons, i, true));
        break;
    }
  }
  return codes;
}

}  // namespace folprom::train
