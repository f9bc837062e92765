// The encoder's answers for one seam, from the cross faces and the border records.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/codec/seam_coder.h"
#include "engine/connectivity/split_oracle.h"
#include "engine/mesh/types.h"

namespace folprom {

/// One subtree of a seam as the encoder knows it.
struct SeamMember {
  uint32_t subtree = 0;
  const BorderRecord* border = nullptr;          ///< complete
  std::span<const uint32_t> original_of_border;  ///< original vertex (local) per final border set
};

class BorderSeamTruth final : public SeamTruth {
 public:
  /// members as the participants of the SeamCoder; cross_faces: those of the owner's chunk.
  BorderSeamTruth(const std::vector<SeamMember>& members, std::span<const CrossFace> cross_faces);

  bool HasRootFace(uint32_t a, uint32_t b) const override { return !RootFaces(a, b).empty(); }
  bool RootFaceForward(uint32_t a, uint32_t b) const override;
  void Attach(const Complex& complex) override { oracle_.AttachInitial(complex); }
  void BeginSplit(uint32_t participant, uint32_t event, uint32_t vertex) override;
  SplitOracle* oracle() override { return &oracle_; }
  FaceCensus CountFaces(const Complex& complex) const override;

 private:
  /// A face between two of the participants and the owner.
  struct RootFace {
    uint32_t lower, higher;
    bool forward;  ///< it runs lower, higher, owner
    auto operator<=>(const RootFace&) const = default;
  };
  struct Input {
    uint32_t vertices = 0;
    size_t real_faces = 0;
    std::vector<Face> triples;
    std::vector<uint32_t> participant_of_vertex;
    std::vector<RootFace> root_faces;
  };
  static Input Collect(const std::vector<SeamMember>& members,
                       std::span<const CrossFace> cross_faces);
  BorderSeamTruth(const std::vector<SeamMember>& members, Input input);

  /// Sets of border vertices as ranges: at each event the set of `border` loses its last vertices.
  struct Replay {
    std::vector<uint32_t> leaves;       ///< oracle vertices, every set of every time contiguous
    std::vector<uint32_t> begin, end;   ///< current range per border set
    std::vector<uint32_t> second_size;  ///< per event
  };
  std::span<const RootFace> RootFaces(uint32_t a, uint32_t b) const;
  static Replay PlanReplay(const BorderRecord& border, uint32_t offset);

  size_t real_faces_;
  std::vector<RootFace> root_faces_;  ///< ascending
  std::vector<Replay> replays_;
  std::vector<const BorderRecord*> borders_;
  SplitOracle oracle_;
};

}  // namespace folprom
