// The seam of a subtree: all edges and faces between it and the subtrees of lower number.
//
// A cross edge lies in the seam of its higher subtree, a cross face in that of its highest. The
// seam replays the border splits of the subtrees that take part and codes what each does to cross
// edges and faces, with the same coder as inside a subtree. No vertex is ever duplicated.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/codec/border_record.h"
#include "engine/codec/parameters.h"
#include "engine/connectivity/complex.h"
#include "engine/connectivity/face_exceptions.h"
#include "engine/connectivity/split_coder.h"
#include "engine/entropy/mixed_model.h"

namespace folprom {

/// A border set: its subtree and its number there (see BorderEvent).
struct BorderRef {
  uint32_t subtree = 0;
  uint32_t border = 0;
};
using SeamFace = std::array<BorderRef, 3>;

/// What the encoder answers.
class SeamTruth {
 public:
  virtual ~SeamTruth() = default;
  /// Is there a face between subtrees number a < b (of the participants) and the owner.
  virtual bool HasRootFace(uint32_t a, uint32_t b) const = 0;
  /// Do at least as many of these run a, b, owner as the other way round.
  virtual bool RootFaceForward(uint32_t a, uint32_t b) const = 0;
  virtual void Attach(const Complex& complex) = 0;
  /// The next split, event `event` of a participant, divides LOD vertex `vertex`.
  virtual void BeginSplit(uint32_t participant, uint32_t event, uint32_t vertex) = 0;
  virtual SplitOracle* oracle() = 0;
  virtual FaceCensus CountFaces(const Complex& complex) const = 0;
};

class SeamCoder {
 public:
  struct Participant {
    uint32_t subtree;
    const BorderRecord* border;  ///< must hold a layer's events before CodeLayer for it
  };
  /// Participants: the lower neighbours in ascending order, then the owner. mesh_faces: as in
  /// SubtreeShape.
  SeamCoder(const CodecParameters& parameters, std::vector<Participant> participants,
            uint64_t mesh_faces);

  template <class Coder>
  void CodeLayer(Coder& coder, SeamTruth* truth, uint64_t* meter);

  uint64_t face_count() const { return exceptions_.FaceCount(complex_); }
  void AppendFaces(std::vector<SeamFace>* faces) const;

 private:
  template <class Coder>
  void CodeRoots(Coder& coder, SeamTruth* truth);
  template <class Coder>
  void ReplayEvent(Coder& coder, uint32_t participant, uint32_t event, SeamTruth* truth,
                   uint64_t* meter);

  CodecParameters parameters_;
  uint64_t mesh_faces_;
  std::vector<Participant> participants_;
  uint32_t layer_ = 0;
  Complex complex_;
  std::vector<Int3> positions_;
  std::vector<BorderRef> name_;                          ///< per vertex of the complex
  std::vector<std::vector<uint32_t>> vertex_of_border_;  ///< per participant
  SplitCoder split_coder_;
  MixedModel<1> root_face_, root_face_forward_;
  FaceExceptions exceptions_;
};

}  // namespace folprom
