// What the complex alone does not say of the faces: copies, of either orientation, and degenerate
// faces.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/connectivity/complex.h"
#include "engine/mesh/types.h"

namespace folprom {

/// The true number of faces per element of a complex, counted by the encoder.
struct FaceCensus {
  std::vector<uint32_t> forward;   ///< per face: originals of its orientation, at least 1
  std::vector<uint32_t> backward;  ///< per face: originals of the opposite orientation
  std::vector<std::array<uint32_t, 2>> on_edge;  ///< per edge (a, b): faces (a, a, b), (a, b, b)
  std::vector<uint32_t> on_vertex;               ///< per vertex: faces (a, a, a)
};

/// Counts the faces of `originals` (vertices of the complex, after all splits). face_of[i] is the
/// face of the complex on which original i lies, kNone when it is degenerate.
FaceCensus TakeCensus(const Complex& complex, const std::vector<Face>& originals,
                      const std::vector<uint32_t>& face_of);

/// Coded once, when every set is a single vertex.
class FaceExceptions {
 public:
  /// What a subtree or seam may hold: 3 GiB as they are written.
  static constexpr uint64_t kMostFaces = uint64_t{1} << 28;

  /// most_faces: more than this is kCorrupt, so that a few bytes cannot ask for endless copies.
  explicit FaceExceptions(uint64_t most_faces) : most_faces_(most_faces) {}

  /// census: encoder only.
  template <class Coder>
  void Code(Coder& coder, const Complex& complex, const FaceCensus* census);

  /// Faces in their final number. Before Code: those of the complex.
  uint64_t FaceCount(const Complex& complex) const { return complex.face_count() + extra_count_; }
  /// Throws Failure kLimit when they are more than kMostFaces.
  void AppendFaces(const Complex& complex, std::vector<Face>* faces) const;

 private:
  void Repeat(const Complex& complex, const Face& face, uint32_t count);
  uint64_t most_faces_;
  /// Further copies and degenerate faces, and how many of each: a few bits may announce millions.
  struct Repeated {
    Face face;
    uint32_t count;
  };
  std::vector<Repeated> extra_;
  uint64_t extra_count_ = 0;
};

}  // namespace folprom
