// A number of bytes that tasks share. It bounds how many run at once and never what they compute.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace folprom::parallel {

/// Thread-safe. A task holds a Lease for what it is about to allocate.
class MemoryBudget {
 public:
  explicit MemoryBudget(uint64_t limit_bytes) : limit_(limit_bytes) {}

  class Lease {
   public:
    Lease() = default;
    Lease(MemoryBudget* budget, uint64_t bytes) : budget_(budget), bytes_(bytes) {}
    Lease(Lease&& other) noexcept { *this = static_cast<Lease&&>(other); }
    Lease& operator=(Lease&& other) noexcept;
    ~Lease() { Release(); }
    void Release();

   private:
    MemoryBudget* budget_ = nullptr;
    uint64_t bytes_ = 0;
  };

  /// Waits until the bytes are free; requests are served in the order in which they come. A request
  /// above the limit waits until nothing else is out, so that one task can always run. A task must
  /// not ask again while it holds a Lease, and in Runner::Ordered a Lease must end with produce():
  /// held until consume() it could keep a lower index, and so itself, waiting for ever.
  Lease Acquire(uint64_t bytes);
  uint64_t in_use() const;

 private:
  friend class Lease;
  mutable std::mutex mutex_;
  std::condition_variable freed_;
  uint64_t limit_;
  uint64_t used_ = 0;
  uint64_t next_ticket_ = 0;
  uint64_t served_ticket_ = 0;
};

}  // namespace folprom::parallel
