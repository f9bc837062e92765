// The encoder's knowledge of the original mesh, asked split by split.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/connectivity/complex.h"
#include "engine/connectivity/face_exceptions.h"
#include "engine/connectivity/split_star.h"
#include "engine/mesh/types.h"

namespace folprom {

/// Knows which original vertices each vertex of the LOD stands for, and answers what a split does
/// to edges and faces. Work per split: the original faces around the smaller of the two new sets,
/// so n log n in total.
class SplitOracle {
 public:
  /// `faces` are original triples over `vertex_count` original vertices. A triple that repeats a
  /// vertex is no face and stands for its edge only. set_of_vertex: the LOD vertex in which each
  /// original starts; empty: all in vertex 0.
  SplitOracle(uint32_t vertex_count, std::vector<Face> faces,
              std::vector<uint32_t> set_of_vertex = {});

  /// Counts the originals behind each edge and face that the complex has before its first split.
  /// Needed for seams only; an inner complex starts as one vertex.
  void AttachInitial(const Complex& complex);

  /// The split of LOD vertex `vertex`: `moved` are the original vertices of one child, as ranges
  /// that the caller keeps; it should be the smaller one. `moved_is_second`: they form the second
  /// child.
  void Scan(uint32_t vertex, std::span<const std::span<const uint32_t>> moved,
            bool moved_is_second);

  bool connected() const { return child_edge_count_ > 0; }
  Side NeighbourSide(uint32_t half_edge, uint32_t neighbour) const;
  Side FaceSide(uint32_t face) const;
  /// Of a face whose side is both, before the split is applied: do more of a child's originals run
  /// against the face than along it.
  FaceTurns TurnsOf(const Complex& complex, uint32_t face);
  bool HasNewFace(uint32_t neighbour) const;
  /// Is the new face (first child, second child, neighbour), and not its reverse, the more common.
  bool NewFaceForward(uint32_t neighbour) const;

  /// The split was applied to the complex; star holds the new indices.
  void Commit(const SplitStar& star);

  /// After all splits: for each original face the face of the complex, kNone for degenerate ones.
  uint32_t FaceOf(uint32_t original_face) const {
    uint32_t label = face_label_[original_face];
    return label == kNone ? kNone : face_of_label_[label];
  }
  /// The LOD vertices that an original face lies on now.
  Face SetsOf(uint32_t original_face) const;
  uint32_t VertexOf(uint32_t original_vertex) const {
    return vertex_of_label_[vertex_label_[original_vertex]];
  }
  const std::vector<Face>& faces() const { return faces_; }

 private:
  /// As its vertex sees a face: what a scan reads lies in one row.
  struct Corner {
    uint32_t next, previous;  ///< vertices, in the order of the face's orientation
    uint32_t face;
  };
  struct PerNeighbour {
    uint32_t stamp = 0;
    uint32_t edges = 0;      ///< pairs of corners of one original: one moved, one here
    uint32_t new_faces = 0;  ///< originals (moved, other child, neighbour)
    int32_t forward = 0;     ///< of these, along (first, second, neighbour) minus against
    uint32_t new_face_label = kNone;
  };
  struct PerFace {
    uint32_t stamp = 0;
    uint32_t count = 0;  ///< originals with a moved corner
    int32_t along = 0;   ///< of these, along the face minus against; when it was asked for
    uint32_t new_label = kNone;
  };
  /// What is known of a face of the complex.
  struct FaceRecord {
    uint32_t count = 0;  ///< originals
    int32_t along = 0;   ///< of these, along the face minus against; never below 0
    uint32_t label = kNone;
  };
  struct OpenedFace {
    uint32_t face;   ///< original that becomes part of a new face
    uint32_t third;  ///< its vertex outside the two children
  };
  void ScanCorner(const Corner& corner);
  PerNeighbour& At(uint32_t neighbour);
  Side SideOf(uint32_t moved_count, uint32_t total) const;
  void CommitEdges(const SplitStar& star);
  void CommitFaces(const SplitStar& star);
  void CommitNewFaces(const SplitStar& star);
  /// along: of the originals, along the face or against it.
  void AddFaceRecord(uint32_t face, uint32_t count, int32_t along, uint32_t label);
  void CountAlong(const Complex& complex);

  std::vector<Face> faces_;
  std::vector<uint32_t> corner_begin_;  ///< per vertex, into corners_
  std::vector<Corner> corners_;
  // Originals carry labels, labels name the LOD's vertices and faces: when a set is halved only the
  // smaller half gets a new label.
  std::vector<uint32_t> vertex_label_, vertex_of_label_;
  std::vector<uint32_t> face_label_, face_of_label_;
  std::vector<uint32_t> edge_count_;  ///< pairs of corners per edge of the complex
  std::vector<FaceRecord> records_;   ///< per face of the complex

  std::vector<PerNeighbour> neighbour_;
  std::vector<PerFace> face_;
  std::vector<uint32_t> touched_faces_;
  std::vector<OpenedFace> opened_faces_;
  uint32_t stamp_ = 0;
  uint32_t moved_label_ = 0;
  uint32_t old_label_ = kNone;
  uint32_t child_edge_count_ = 0;
  bool moved_is_second_ = false;
  bool has_counted_along_ = false;  ///< of the faces that this split touches
};

/// Counts the first `real_faces` originals of the oracle on the elements of its finished complex.
FaceCensus TakeCensus(const Complex& complex, const SplitOracle& oracle, size_t real_faces);

}  // namespace folprom
