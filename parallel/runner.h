// One interface for "do these tasks": serial, oneTBB, or shuffled to prove that order is no input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace folprom::parallel {

/// Runs independent tasks. No result may depend on the order in which they run. A task may call the
/// same runner again; such a nested call never starts another task of the outer one on its thread.
class Runner {
 public:
  virtual ~Runner() = default;

  /// Number of tasks that may run at the same time, at least 1.
  virtual int threads() const = 0;

  /// Calls task(i) once for each i in [0, count). Returns when all are done. When tasks throw, the
  /// tasks not yet started are skipped and the exception of the lowest failed index is rethrown.
  virtual void ForEach(size_t count, const std::function<void(size_t)>& task) = 0;

  /// Calls produce(i) for each i in [0, count) in any order and at the same time, and
  /// consume(i) one at a time in the order of i, after produce(i). At most `window` indices are
  /// produced or being produced and not yet consumed (at least 1). Exceptions as for ForEach, and
  /// nothing after the lowest failed index is consumed.
  virtual void Ordered(size_t count, size_t window, const std::function<void(size_t)>& produce,
                       const std::function<void(size_t)>& consume) = 0;
};

std::unique_ptr<Runner> MakeSerialRunner();
/// threads = 0: as many as the machine has. Starts the tasks in the order of their indices, so the
/// exception that leaves is the one that the serial runner would throw.
std::unique_ptr<Runner> MakeTbbRunner(int threads);
/// Serial, in an order drawn from the seed, for tests.
std::unique_ptr<Runner> MakeShuffledRunner(uint64_t seed);

}  // namespace folprom::parallel
