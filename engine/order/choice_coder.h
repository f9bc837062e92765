// One of a few options, each seen under contexts that learn: the likeliest are asked for first.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/entropy/mixed_model.h"

namespace folprom {

/// What the model sees of an option: a value per context, below the sizes of the model.
template <size_t N>
struct Option {
  uint32_t number = 0;
  std::array<uint32_t, N> contexts{};
};

template <size_t N>
class ChoiceCoder {
 public:
  explicit ChoiceCoder(std::array<uint32_t, N> sizes) : decisions_(sizes, kRanks) {
    for (size_t i = 0; i < kRanking; ++i) chance_[i].assign(sizes[i], uint16_t{1} << 15);
  }

  /// Codes the number of the option that is chosen; at least one must be there. Reorders them.
  template <class Coder>
  uint32_t Code(Coder& coder, std::span<Option<N>> options, uint32_t chosen) {
    odds_.clear();
    for (const Option<N>& option : options) odds_.push_back(OddsOf(option));
    for (size_t rank = 0;; ++rank) {
      const auto best =
          std::max_element(odds_.begin() + static_cast<std::ptrdiff_t>(rank), odds_.end());
      const auto place = static_cast<size_t>(best - odds_.begin());
      std::swap(odds_[rank], odds_[place]);
      std::swap(options[rank], options[place]);
      const Option<N>& option = options[rank];
      bool is_it = true;  // as the last one is
      if (rank + 1 < options.size()) {
        const auto set = static_cast<uint32_t>(std::min<size_t>(rank, kRanks - 1));
        is_it = decisions_.Code(coder, option.contexts, set, option.number == chosen);
      }
      Learn(option, is_it);
      if (is_it) return option.number;
    }
  }

 private:
  /// Contexts by which options are ranked; ranks that decisions are told apart by.
  static constexpr size_t kRanking = N < 2 ? N : 2;
  static constexpr uint32_t kRanks = 6;

  int32_t OddsOf(const Option<N>& option) const {
    int32_t odds = 0;
    for (size_t i = 0; i < kRanking; ++i) {
      odds += detail::kStretch[chance_[i][option.contexts[i]] >> 4];
    }
    return odds;
  }
  void Learn(const Option<N>& option, bool is_it) {
    for (size_t i = 0; i < kRanking; ++i) {
      uint16_t& chance = chance_[i][option.contexts[i]];
      chance =
          static_cast<uint16_t>(is_it ? chance + ((65535 - chance) >> 5) : chance - (chance >> 5));
    }
  }

  MixedModel<N> decisions_;
  std::array<std::vector<uint16_t>, kRanking> chance_;
  std::vector<int32_t> odds_;
};

}  // namespace folprom
