// Working memory of the blocks in flight, used again from block to block.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace folprom::partition {

/// Lends one T per block. Holds as many as were ever in flight at once. Thread-safe for different
/// blocks. A T comes back from an earlier block as that block left it.
template <class T>
class BlockPool {
 public:
  T& Begin(size_t block) {
    const std::lock_guard lock(mutex_);
    std::unique_ptr<T>& slot = busy_[block];
    if (free_.empty()) {
      slot = std::make_unique<T>();
    } else {
      slot = std::move(free_.back());
      free_.pop_back();
    }
    return *slot;
  }

  T& At(size_t block) {
    const std::lock_guard lock(mutex_);
    return *busy_.at(block);
  }

  void End(size_t block) {
    const std::lock_guard lock(mutex_);
    const auto found = busy_.find(block);
    free_.push_back(std::move(found->second));
    busy_.erase(found);
  }

 private:
  std::mutex mutex_;
  std::map<size_t, std::unique_ptr<T>> busy_;
  std::vector<std::unique_ptr<T>> free_;
};

}  // namespace folprom::partition
