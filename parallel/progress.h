// What a long job tells the outside, and the one way to stop it.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>

namespace folprom::parallel {

/// Thrown by Progress::Advance after Cancel(); leaves every file of the job unfinished and removed.
struct Cancelled : std::exception {
  const char* what() const noexcept override { return "cancelled"; }
};

/// Thread-safe. The worker calls StartStage and Advance; a display thread reads; anyone cancels
/// (Cancel is safe inside a signal handler).
class Progress {
 public:
  /// Both texts are string literals. `unit` names what is counted where a reader may want its rate.
  void StartStage(const char* name, uint64_t total, const char* unit = "") {
    done_.store(0);
    total_.store(total);
    unit_.store(unit);
    stage_.store(name);
  }
  /// Adds `units` of work done. Throws Cancelled when a stop was asked for.
  void Advance(uint64_t units) {
    done_.fetch_add(units, std::memory_order_relaxed);
    ThrowIfCancelled();
  }
  void ThrowIfCancelled() const {
    if (cancelled_.load(std::memory_order_relaxed)) throw Cancelled();
  }
  void Cancel() noexcept { cancelled_.store(true); }
  bool cancelled() const { return cancelled_.load(); }

  const char* stage() const { return stage_.load(); }
  const char* unit() const { return unit_.load(); }
  uint64_t done() const { return done_.load(); }
  uint64_t total() const { return total_.load(); }

 private:
  std::atomic<const char*> stage_{""};
  std::atomic<const char*> unit_{""};
  std::atomic<uint64_t> done_{0};
  std::atomic<uint64_t> total_{0};
  std::atomic<bool> cancelled_{false};
};

}  // namespace folprom::parallel
