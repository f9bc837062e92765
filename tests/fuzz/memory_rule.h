// The rule that an input takes at most 64 MiB and 64 times its size, kept by the sanitizer's hooks.
#pragma once

#include <cstddef>

namespace folprom::fuzz {

/// As long as it lives, the program ends with abort() as soon as more is allocated than an input of
/// `input_bytes` may take. One at a time, and only with the address sanitizer.
class MemoryRule {
 public:
  explicit MemoryRule(size_t input_bytes);
  ~MemoryRule();
  MemoryRule(const MemoryRule&) = delete;
  MemoryRule& operator=(const MemoryRule&) = delete;
};

}  // namespace folprom::fuzz
