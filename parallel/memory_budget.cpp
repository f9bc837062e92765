#include "parallel/memory_budget.h"

#include <utility>

namespace folprom::parallel {

MemoryBudget::Lease& MemoryBudget::Lease::operator=(Lease&& other) noexcept {
  if (this != &other) {
    Release();
    budget_ = std::exchange(other.budget_, nullptr);
    bytes_ = std::exchange(other.bytes_, 0);
  }
  return *this;
}

void MemoryBudget::Lease::Release() {
  if (budget_ == nullptr) return;
  {
    const std::lock_guard lock(budget_->mutex_);
    budget_->used_ -= bytes_;
  }
  budget_->freed_.notify_all();
  budget_ = nullptr;
  bytes_ = 0;
}

MemoryBudget::Lease MemoryBudget::Acquire(uint64_t bytes) {
  std::unique_lock lock(mutex_);
  // In the order of the requests, so that small ones cannot keep a large one waiting for ever.
  const uint64_t ticket = next_ticket_++;
  freed_.wait(lock, [&] {
    const bool fits = used_ == 0 || (used_ <= limit_ && bytes <= limit_ - used_);
    return ticket == served_ticket_ && fits;
  });
  ++served_ticket_;
  used_ += bytes;
  lock.unlock();
  freed_.notify_all();
  return Lease(this, bytes);
}

uint64_t MemoryBudget::in_use() const {
  const std::lock_guard lock(mutex_);
  return used_;
}

}  // namespace folprom::parallel
