// What the targets have in common.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>

#include "tests/fuzz/memory_rule.h"

namespace folprom::fuzz {

/// Ends the program where `fault_of` an input says that something is wrong.
template <class FaultOf>
int RunTarget(const uint8_t* data, size_t size, FaultOf fault_of) {
  const MemoryRule rule(size);
  const std::string fault = fault_of(std::span(data, size));
  if (fault.empty()) return 0;
  std::fprintf(stderr, "fault: %s\n", fault.c_str());
  std::abort();
}

}  // namespace folprom::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
