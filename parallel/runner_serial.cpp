// Tasks one after the other on the calling thread.
#include "parallel/runner.h"

namespace folprom::parallel {
namespace {

class SerialRunner final : public Runner {
 public:
  int threads() const override { return 1; }

  void ForEach(size_t count, const std::function<void(size_t)>& task) override {
    for (size_t i = 0; i < count; ++i) task(i);
  }

  void Ordered(size_t count, size_t /*window*/, const std::function<void(size_t)>& produce,
               const std::function<void(size_t)>& consume) override {
    for (size_t i = 0; i < count; ++i) {
      produce(i);
      consume(i);
    }
  }
};

}  // namespace

std::unique_ptr<Runner> MakeSerialRunner() { return std::make_unique<SerialRunner>(); }

}  // namespace folprom::parallel
