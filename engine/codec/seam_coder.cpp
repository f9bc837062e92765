#include "engine/codec/seam_coder.h"

#include <utility>

#include "engine/entropy/bit_coder.h"

namespace folprom {

SeamCoder::SeamCoder(const CodecParameters& parameters, std::vector<Participant> participants,
                     uint64_t mesh_faces)
    : parameters_(parameters),
      mesh_faces_(mesh_faces),
      participants_(std::move(participants)),
      vertex_of_border_(participants_.size()),
      split_coder_(parameters.connectivity()),
      root_face_({1}),
      root_face_forward_({1}),
      exceptions_(mesh_faces) {}

template <class Coder>
void SeamCoder::CodeLayer(Coder& coder, SeamTruth* truth, uint64_t* meter) {
  uint64_t unmetered = 0;
  if (meter == nullptr) meter = &unmetered;
  coder.SetMeter(meter);
  if (layer_ == 0) CodeRoots(coder, truth);
  for (uint32_t p = 0; p < participants_.size(); ++p) {
    const BorderRecord& border = *participants_[p].border;
    for (uint32_t e = border.LayerBegin(layer_); e < border.LayerEnd(layer_); ++e) {
      ReplayEvent(coder, p, e, truth, meter);
    }
  }
  if (parameters_.schedule.IsLastSplitLayer(layer_)) {
    FaceCensus census;
    if constexpr (Coder::kEncoding) census = truth->CountFaces(complex_);
    exceptions_.Code(coder, complex_, Coder::kEncoding ? &census : nullptr);
  }
  ++layer_;
}

template <class Coder>
void SeamCoder::CodeRoots(Coder& coder, SeamTruth* truth) {
  uint32_t owner = static_cast<uint32_t>(participants_.size()) - 1;
  for (uint32_t p = 0; p <= owner; ++p) {
    vertex_of_border_[p].push_back(complex_.AddVertex());
    positions_.push_back(participants_[p].border->root_position);
    name_.push_back({participants_[p].subtree, 0});
  }
  for (uint32_t p = 0; p < owner; ++p) complex_.AddEdge(p, owner);
  for (uint32_t a = 0; a < owner; ++a) {
    for (uint32_t b = a + 1; b < owner; ++b) {
      bool exists = false, forward = false;
      if constexpr (Coder::kEncoding) {
        exists = truth->HasRootFace(a, b);
        forward = exists && truth->RootFaceForward(a, b);
      }
      if (!root_face_.Code(coder, {0}, 0, exists)) continue;
      forward = root_face_forward_.Code(coder, {0}, 0, forward);
      complex_.AddFace(forward ? a : b, forward ? b : a, owner);
    }
  }
  if constexpr (Coder::kEncoding) truth->Attach(complex_);
}

template <class Coder>
void SeamCoder::ReplayEvent(Coder& coder, uint32_t participant, uint32_t index, SeamTruth* truth,
                            uint64_t* meter) {
  const BorderEvent& event = participants_[participant].border->events[index];
  uint32_t vertex = vertex_of_border_[participant][event.border];
  if (event.both != 0) {
    SplitCoder::Known known;
    known.first = event.first_position;
    known.second = event.second_position;
    known.code_connected = false;
    known.connected = event.connected != 0;
    SplitOracle* oracle = nullptr;
    if constexpr (Coder::kEncoding) {
      truth->BeginSplit(participant, index, vertex);
      oracle = truth->oracle();
    }
    SplitMeters costs;
    uint32_t added =
        split_coder_.Code(coder, complex_, positions_, vertex, known, oracle, &costs, meter);
    coder.SetMeter(meter);  // costs ends with this block
    *meter += costs.Sum();
    CheckSize(complex_, mesh_faces_);
    positions_.push_back(event.second_position);
    name_.push_back({participants_[participant].subtree,
                     static_cast<uint32_t>(vertex_of_border_[participant].size())});
    vertex_of_border_[participant].push_back(added);
  }
  positions_[vertex] = event.first_position;
}

void SeamCoder::AppendFaces(std::vector<SeamFace>* faces) const {
  std::vector<Face> own;
  exceptions_.AppendFaces(complex_, &own);
  for (const Face& face : own) faces->push_back({name_[face[0]], name_[face[1]], name_[face[2]]});
}

template void SeamCoder::CodeLayer<BitEncoder>(BitEncoder&, SeamTruth*, uint64_t*);
template void SeamCoder::CodeLayer<BitDecoder>(BitDecoder&, SeamTruth*, uint64_t*);

}  // namespace folprom
