// Tasks one at a time in an order that nothing may rely on.
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "parallel/runner.h"

namespace folprom::parallel {
namespace {

// splitmix64: the same order for a seed with every standard library.
class Dice {
 public:
  explicit Dice(uint64_t seed) : state_(seed) {}

  /// In [0, sides). The small bias of the remainder does no harm here.
  size_t Throw(size_t sides) {
    state_ += 0x9E3779B97F4A7C15u;
    uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBu;
    return static_cast<size_t>((mixed ^ (mixed >> 31)) % sides);
  }

 private:
  uint64_t state_;
};

class ShuffledRunner final : public Runner {
 public:
  explicit ShuffledRunner(uint64_t seed) : dice_(seed) {}

  int threads() const override { return 1; }

  void ForEach(size_t count, const std::function<void(size_t)>& task) override {
    std::vector<size_t> order(count);
    std::iota(order.begin(), order.end(), size_t{0});
    for (size_t left = count; left > 1; --left)
      std::swap(order[left - 1], order[dice_.Throw(left)]);
    for (size_t i : order) task(i);
  }

  // Each index is consumed as late as the window allows, the next to produce is drawn from it.
  void Ordered(size_t count, size_t window, const std::function<void(size_t)>& produce,
               const std::function<void(size_t)>& consume) override {
    window = std::max<size_t>(window, 1);
    std::vector<size_t> waiting;  // inside the window, not produced
    size_t opened = 0;
    for (size_t next = 0; next < count; ++next) {
      for (; opened < count && opened - next < window; ++opened) waiting.push_back(opened);
      while (std::find(waiting.begin(), waiting.end(), next) != waiting.end()) {
        std::swap(waiting.back(), waiting[dice_.Throw(waiting.size())]);
        const size_t drawn = waiting.back();
        waiting.pop_back();
        produce(drawn);
      }
      consume(next);
    }
  }

 private:
  Dice dice_;
};

}  // namespace

std::unique_ptr<Runner> MakeShuffledRunner(uint64_t seed) {
  return std::make_unique<ShuffledRunner>(seed);
}

}  // namespace folprom::parallel
