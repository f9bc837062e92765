// The peer "simplify with meshoptimizer, then Draco": one file for one rate.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/bench/peers/mesh_file.h"

namespace folprom::peers {

class SimplifyDraco {
 public:
  /// `mesh` must outlive it and have faces.
  explicit SimplifyDraco(const Mesh& mesh);

  /// The mesh with about so many faces; where the simplifier cannot go as far, more. All of it, as
  /// it is, from the face count of the original on.
  Mesh Simplified(uint64_t faces) const;

 private:
  const Mesh& mesh_;
  std::vector<float> positions_;
};

/// What `draco_encoder -cl 10 -qp BITS` writes for the mesh. Throws Failure.
std::vector<char> EncodeDraco(const Mesh& mesh, int bits);
/// Throws Failure.
Mesh DecodeDraco(const std::vector<char>& bytes);

}  // namespace folprom::peers
