#include "tests/fuzz/memory_rule.h"

#include <sanitizer/allocator_interface.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace folprom::fuzz {
namespace {

constexpr size_t kAllowed = size_t{64} << 20, kAllowedTimes = 64;

std::atomic<size_t> live{0};
std::atomic<size_t> most{SIZE_MAX};

void CountAllocation(const volatile void*, size_t bytes) {
  if ((live += bytes) <= most) return;
  most = SIZE_MAX;
  std::fputs("memory rule: more than 64 MiB and 64 times the input\n", stderr);
  std::abort();
}

void CountRelease(const volatile void* memory) {
  if (memory == nullptr) return;
  const size_t bytes = __sanitizer_get_allocated_size(memory);
  // What was allocated before the hooks were there was not counted.
  live = live > bytes ? live - bytes : 0;
}

}  // namespace

MemoryRule::MemoryRule(size_t input_bytes) {
  static const int installed =
      __sanitizer_install_malloc_and_free_hooks(CountAllocation, CountRelease);
  if (installed == 0) std::abort();
  live = 0;
  most = kAllowed + kAllowedTimes * input_bytes;
}
MemoryRule::~MemoryRule() { most = SIZE_MAX; }

}  // namespace folprom::fuzz
