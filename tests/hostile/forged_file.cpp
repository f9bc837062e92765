#include "tests/hostile/forged_file.h"

#include <algorithm>

#include "engine/codec/layer_reader.h"
#include "engine/codec/subtree_coder.h"
#include "engine/codec/tree_truth.h"
#include "engine/entropy/bit_coder.h"
#include "engine/hierarchy/lloyd_tree.h"
#include "engine/mesh/lattice.h"
#include "tests/support/coders.h"

namespace folprom::hostile {
namespace {

constexpr int32_t kSide = 1 << 13;

/// Answers as the honest truth does, except for the number of copies of each face.
class CopyingTruth final : public SubtreeTruth {
 public:
  CopyingTruth(TreeTruth& honest, uint32_t copies) : honest_(honest), copies_(copies) {}
  bool OnGrid() const override { return false; }
  const uint8_t* Attributes(uint32_t set) const override { return honest_.Attributes(set); }
  Int3 RootRepresentative() const override { return honest_.RootRepresentative(); }
  uint32_t ChildCount(uint32_t set) const override { return honest_.ChildCount(set); }
  double Distortion(uint32_t set) const override { return honest_.Distortion(set); }
  LatticePrecision Precision(const Complex& complex, std::span<const uint32_t> open,
                             uint32_t coarsest) const override {
    return honest_.Precision(complex, open, coarsest);
  }
  Int3 ChildRepresentative(uint32_t set, uint32_t child) const override {
    return honest_.ChildRepresentative(set, child);
  }
  void BeginSplit(uint32_t set, std::span<const uint32_t> order) override {
    honest_.BeginSplit(set, order);
  }
  void BeginBinarySplit(uint32_t set, std::span<const uint32_t> first,
                        std::span<const uint32_t> second) override {
    honest_.BeginBinarySplit(set, first, second);
  }
  bool FirstTouchesBorder() const override { return honest_.FirstTouchesBorder(); }
  bool SecondTouchesBorder() const override { return honest_.SecondTouchesBorder(); }
  void EndBinarySplit(uint32_t second_set) override { honest_.EndBinarySplit(second_set); }
  Int3 VertexPosition(uint32_t set) const override { return honest_.VertexPosition(set); }
  CoordinateRest Rest(uint32_t, size_t) const override { return {}; }
  FitShares Fit(const SubtreeLod& lod, std::span<const uint32_t> open,
                const FitShares& before) const override {
    return honest_.Fit(lod, open, before);
  }
  std::shared_ptr<const CoordinatePlanes> Planes() const override { return nullptr; }
  SplitOracle* oracle() override { return honest_.oracle(); }
  FaceCensus CountFaces(const Complex& complex) const override {
    FaceCensus census = honest_.CountFaces(complex);
    for (uint32_t& count : census.forward) count += copies_;
    return census;
  }

 private:
  TreeTruth& honest_;
  uint32_t copies_;
};

Bytes Forged(const std::vector<Int3>& positions, const std::vector<Face>& faces,
             const std::vector<CrossFace>& cross_faces, uint32_t copies, uint64_t announced_faces) {
  SubtreeChunk chunk{positions, faces, cross_faces, {}};
  CodecParameters parameters;
  parameters.settings = support::LloydSettings();
  parameters.extent = {kSide, kSide, kSide};
  parameters.schedule = LayerSchedule(parameters.extent, parameters.settings.steps_per_octave,
                                      parameters.settings.rounds_per_step, 3, 2);
  SetTree tree = BuildLloydTree(positions, MeasureSurface(positions, faces, cross_faces, 0), kSide,
                                parameters.settings);
  TreeTruth honest(chunk, 0, tree, parameters);
  CopyingTruth truth(honest, copies);
  const auto count = static_cast<uint32_t>(positions.size());
  SubtreeCoder coder(parameters, {count, {0, 0, 0}, parameters.extent, false});
  BitEncoder bits;
  CostMeters meters;
  Parts parts;
  parts.table.vertices = count;
  parts.table.faces = announced_faces;
  parts.table.coordinate_type = static_cast<uint8_t>(ScalarType::kFloat32);
  parts.table.extent = {kSide, kSide, kSide};
  parts.table.tolerance = 1;
  parts.table.codec = WriteParameters(parameters);
  parts.table.subtrees.push_back({count, {0, 0, 0}, {kSide, kSide, kSide}, {}});
  for (uint32_t layer = 0; layer < parameters.schedule.layers(); ++layer) {
    coder.CodeLayer(bits, &truth, &meters);
    parts.segments.push_back(bits.TakeSegment());
    parts.segments.emplace_back();
    parts.table.layers.push_back(
        {1, coder.positions().size(), std::min(coder.face_count(), announced_faces)});
  }
  return PutTogether(std::move(parts));
}

}  // namespace

Bytes CompleteGraphFile(uint32_t vertices, uint64_t announced_faces) {
  std::vector<Int3> positions;
  std::vector<CrossFace> cross_faces;
  for (uint32_t v = 0; v < vertices; ++v) {
    auto spread = [&](uint32_t factor) { return static_cast<int32_t>(v * factor % kSide); };
    positions.push_back({spread(2654435761u), spread(40503), spread(97)});
  }
  // A cross face leaves its inner edge behind, and no face.
  for (uint32_t a = 0; a < vertices; ++a) {
    for (uint32_t b = a + 1; b < vertices; ++b) {
      cross_faces.push_back({{{{0, a}, {0, b}, {1, 0}}}, {}});
    }
  }
  return Forged(positions, {}, cross_faces, 0, announced_faces);
}

Bytes CopiedFacesFile(uint32_t copies) {
  const TestMesh mesh = RoughTorus(10, 10);
  std::vector<Int3> positions;
  std::vector<Face> faces;
  const Lattice lattice{{-5, -5, -5}, 10.0 / kSide, {kSide, kSide, kSide}};
  for (size_t v = 0; v < 100; ++v) positions.push_back(lattice.FromModel(mesh.positions[v].data()));
  for (size_t f = 0; f < 200; ++f) faces.push_back(mesh.faces[f]);
  return Forged(positions, faces, {}, copies, faces.size());
}

}  // namespace folprom::hostile
