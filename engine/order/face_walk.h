// The order of faces, and the corner that each begins with, where the order of vertices is known or
// follows from that of the faces.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/order/choice_coder.h"
#include "engine/order/order_mesh.h"
#include "engine/order/sweep.h"

namespace folprom {

/// Codes which face comes next, over and over: one that touches the last, one that goes on with
/// the steps of its forerunners, one where vertices begin or end to be used, or any.
class FaceWalk {
 public:
  /// sequence, place_of: of the vertices, as the VertexWalk leaves them. Of a soup they are
  /// written: a vertex, whose place is kNoNumber before, takes the next one with the first face
  /// that has it.
  FaceWalk(const OrderMesh& mesh, const Sweep& sweep, std::span<uint32_t> sequence,
           std::span<uint32_t> place_of, bool is_soup);

  /// Codes the next faces, with the numbers that vertices have in the mesh; read by an encoder,
  /// written by a decoder. Throws Failure kCorrupt.
  template <class Coder>
  void Code(Coder& coder, std::span<Face> faces);

 private:
  static constexpr size_t kContexts = 6, kTurnContexts = 4;
  static constexpr uint32_t kPatterns = 2;
  struct Found {
    uint32_t face;
    uint32_t patterns;     ///< a bit for each pattern that it goes on with
    uint32_t least, most;  ///< places of its vertices
  };

  void Collect();
  void Add(uint32_t face, uint32_t patterns);
  void AddStar(uint32_t vertex);
  void AddPatterns();
  bool HasFacesLeft(uint32_t place) const;
  /// The first of equal faces that is left.
  uint32_t FindLeft(Face face) const;
  /// The same among the faces of a vertex that are looked at; kNoNumber where none is.
  uint32_t FindNear(Face face) const;
  Option<kContexts> OptionOf(const Found& found) const;
  template <class Coder>
  uint32_t CodeNumber(Coder& coder, uint32_t number);
  template <class Coder>
  uint32_t CodeTurn(Coder& coder, const Face& face, uint32_t turn);
  void Advance(uint32_t number, const Face& face);
  /// Those that its vertices have, or would get now.
  Face PlacesOf(const Face& face) const;
  void GivePlaces(const Face& face);

  const OrderMesh& mesh_;
  std::span<uint32_t> sequence_, place_of_;
  uint32_t placed_;  ///< vertices that have a place
  Remaining remaining_;
  std::array<Face, 2 * kPatterns> last_{};     ///< the faces before, the last one first
  std::array<Face, kPatterns> pattern_{};      ///< places of what the patterns expect
  std::array<bool, kPatterns> has_pattern_{};  ///< are these vertices
  uint32_t done_ = 0, last_number_ = 0;
  uint32_t front_ = 0;   ///< the first place with faces left
  uint32_t newest_ = 0;  ///< the largest place that a face has had
  std::vector<Found> found_;
  std::vector<Option<kContexts>> options_;
  uint32_t history_ = 0;  ///< of the last faces: was it found near; a bit each
  uint32_t relation_ = 0, relation_before_ = 0;  ///< of the last face to that before; of that
  uint32_t first_corner_ = 0;  ///< of the last face: by place the first, second or third
  MixedModel<2> near_;
  ChoiceCoder<kContexts> choice_;
  ChoiceCoder<kTurnContexts> turns_;
};

}  // namespace folprom
