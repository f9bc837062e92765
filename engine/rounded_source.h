// A scan whose float attributes are rounded on request.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "folprom/settings.h"
#include "io/formats/mesh_source.h"
#include "parallel/progress.h"

namespace folprom {

struct RoundedSource {
  std::unique_ptr<io::MeshSource> source;
  /// Of each attribute of the vertices; a step of 0 where it is not rounded.
  std::vector<io::AttributeRange> ranges;
  std::vector<std::string> warnings;  ///< what is not rounded though asked for
};

/// The scan with each attribute rounded to 2^N values, evenly from its least to its largest, for
/// which `attribute_bits` has "NAME=N"; "normal" stands for nx, ny and nz. One with values that are
/// no numbers or infinite stays as it is, and so does one that has no more bits anyway.
RoundedSource RoundAttributes(std::unique_ptr<io::MeshSource> source,
                              const std::vector<std::string>& attribute_bits,
                              parallel::Progress& progress);

}  // namespace folprom
