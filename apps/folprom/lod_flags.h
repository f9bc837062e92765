// Flags that choose a level of detail of a .folp file.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "folprom/settings.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace folprom::cli {

struct LodFlags {
  std::optional<double> bits_per_vertex;
  std::optional<double> max_error;
  std::optional<uint64_t> max_vertices;
  std::optional<uint32_t> layers;

  bool any() const { return bits_per_vertex || max_error || max_vertices || layers; }
  void ApplyTo(DecodeOptions* options) const;
};

/// --bpv --max-error --max-vertices --layers, at most one of them. Returns them.
std::vector<CLI::Option*> AddLodFlags(CLI::App* verb, LodFlags* flags);

}  // namespace folprom::cli
