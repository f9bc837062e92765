// Cases run in a process of their own: a crash, a hang or a flood of memory names its case.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace folprom::hostile {

/// False under a sanitizer, whose own memory would be counted.
extern const bool kMeasuresMemory;

/// Runs work(i) for each i in [0, cases) in child processes. A case may take `cpu_seconds` and let
/// the resident size grow by `growth_bytes` (0: any). Returns what went wrong, a line per case;
/// empty when nothing did. work returns false, or throws, where its promise is broken.
std::string RunGuarded(size_t cases, unsigned cpu_seconds, uint64_t growth_bytes,
                       const std::function<bool(size_t)>& work);

}  // namespace folprom::hostile
