// Every LOD of a file from two sides: which original vertices each LOD vertex stands for, known
// from encoding the scan once more, and the LOD itself as the decoder rebuilds it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/mesh.h"

namespace folprom::support {

/// Steps through the layers of a file.
class LodReplay {
 public:
  /// Throws Failure.
  LodReplay(const std::string& scan, const std::string& folp);
  ~LodReplay();

  size_t layers() const;
  size_t split_layers() const;  ///< later layers only move vertices
  size_t subtrees() const;
  double error_bound(size_t layer) const;  ///< model units, from the table
  /// Does some face have its corners in three subtrees.
  bool ThreeSubtreesMeet() const;

  /// Goes on by one layer. Throws std::runtime_error where the scan, encoded again, gives other
  /// bytes than the file has.
  void NextLayer();

  /// Vertices of the LOD, as decoded, subtree after subtree.
  const std::vector<Point>& positions() const { return positions_; }
  /// The LOD vertex of each original vertex, in the order of the scan.
  const std::vector<uint64_t>& representatives() const { return representatives_; }
  /// Faces as decoded.
  const std::vector<Triple>& faces() const { return faces_; }
  using Edge = std::array<uint64_t, 2>;
  /// Edges of all subtrees and seams, lower end first, in no order.
  const std::vector<Edge>& edges() const { return edges_; }

 private:
  struct Impl;
  void CollectDecoded();
  void CollectSeamEdges();
  void CollectRepresentatives();

  std::unique_ptr<Impl> impl_;
  std::vector<Point> positions_;
  std::vector<uint64_t> representatives_;
  std::vector<Triple> faces_;
  std::vector<Edge> edges_;
};

}  // namespace folprom::support
