#include "apps/folprom/lod_flags.h"

#include <CLI/CLI.hpp>

#include "apps/folprom/options.h"

namespace folprom::cli {

void LodFlags::ApplyTo(DecodeOptions* options) const {
  options->bits_per_vertex = bits_per_vertex.value_or(0);
  options->max_error = max_error.value_or(0);
  options->max_vertices = max_vertices.value_or(0);
  options->layers = layers.value_or(0);
}

std::vector<CLI::Option*> AddLodFlags(CLI::App* verb, LodFlags* flags) {
  const std::vector<CLI::Option*> bounds = {
      AddPositiveOption(verb, "--bpv", &flags->bits_per_vertex, "R",
                        "As many layers as fit into R bits per vertex of the original"),
      AddPositiveOption(verb, "--max-error", &flags->max_error, "LENGTH",
                        "The first layer whose error bound is at most this, in model units"),
      AddCountOption(verb, "--max-vertices", &flags->max_vertices,
                     "The last layer of at most N vertices"),
      verb->add_option("--layers", flags->layers, "The first N layers")
          ->check(CLI::Range(uint32_t{1}, UINT32_MAX))
          ->type_name("N")};
  for (CLI::Option* bound : bounds) {
    for (CLI::Option* other : bounds) {
      if (bound != other) bound->excludes(other);
    }
  }
  return bounds;
}

}  // namespace folprom::cli
