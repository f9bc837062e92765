#include "tests/support/lod_replay.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <stdexcept>

#include "engine/codec/border_seam_truth.h"
#include "engine/codec/encode_subtree.h"
#include "engine/codec/layer_reader.h"
#include "engine/codec/tree_truth.h"
#include "engine/encode_job.h"
#include "engine/folp_file.h"

namespace folprom::support {
namespace {

void CheckSegment(const io::ContainerReader& container, size_t layer, size_t subtree,
                  io::SegmentPart part, BitEncoder* bits) {
  std::vector<uint8_t> again = bits->TakeSegment();
  std::span<const uint8_t> stored = container.Segment(layer, subtree, part).value();
  if (!std::equal(again.begin(), again.end(), stored.begin(), stored.end())) {
    throw std::runtime_error("encoding the scan again gives other bytes in layer " +
                             std::to_string(layer) + " of subtree " + std::to_string(subtree));
  }
}

/// One subtree encoded layer by layer, beside its decoder.
struct Subtree {
  Subtree(const EncodeJob& job, const FolpFile& file, uint32_t number, bool has_border)
      : chunk(job.scan().Load(number)),
        whole(EncodeSubtree(chunk, job.scan().summary(number), number, file.parameters())),
        tree(BuildSetTree(chunk, number, file.parameters())),
        truth(chunk, number, tree, file.parameters()),
        coder(file.parameters(), Shape(job.scan().summary(number))),
        reader(file.container(), file.parameters(), number, has_border) {}

  static SubtreeShape Shape(const SubtreeSummary& summary) {
    return {summary.vertices, summary.box_lo, summary.box_hi, !summary.neighbours.empty()};
  }

  SubtreeChunk chunk;
  EncodedSubtree whole;
  SetTree tree;
  TreeTruth truth;
  SubtreeCoder coder;
  BitEncoder bits;
  SubtreeReader reader;
};

/// Answers as the encoder does, and remembers the complex and what its vertices are.
class WatchedSeamTruth final : public SeamTruth {
 public:
  explicit WatchedSeamTruth(const std::vector<SeamMember>& members,
                            std::span<const CrossFace> cross_faces)
      : truth_(members, cross_faces), members_(members), border_sets_(members.size(), 1) {}

  bool HasRootFace(uint32_t a, uint32_t b) const override { return truth_.HasRootFace(a, b); }
  bool RootFaceForward(uint32_t a, uint32_t b) const override {
    return truth_.RootFaceForward(a, b);
  }
  void Attach(const Complex& complex) override {
    complex_ = &complex;
    for (const SeamMember& member : members_) names_.push_back({member.subtree, 0});
    truth_.Attach(complex);
  }
  void BeginSplit(uint32_t participant, uint32_t event, uint32_t vertex) override {
    names_.push_back({members_[participant].subtree, border_sets_[participant]++});
    truth_.BeginSplit(participant, event, vertex);
  }
  SplitOracle* oracle() override { return truth_.oracle(); }
  FaceCensus CountFaces(const Complex& complex) const override {
    return truth_.CountFaces(complex);
  }

  const Complex& complex() const { return *complex_; }
  const BorderRef& name(uint32_t vertex) const { return names_[vertex]; }

 private:
  BorderSeamTruth truth_;
  std::vector<SeamMember> members_;
  std::vector<uint32_t> border_sets_;  ///< so far, per member
  const Complex* complex_ = nullptr;
  std::vector<BorderRef> names_;
};

/// One seam encoded layer by layer, beside its decoder.
struct Seam {
  Seam(const FolpFile& file, uint32_t number, const std::deque<Subtree>& subtrees)
      : owner(number),
        truth(Members(file, number, subtrees), subtrees[number].chunk.cross_faces),
        coder(file.parameters(), Participants(file, number, subtrees, false), file.table().faces),
        reader(file.container(), file.parameters(), number,
               Participants(file, number, subtrees, true)) {}

  static std::vector<uint32_t> Numbers(const FolpFile& file, uint32_t owner) {
    std::vector<uint32_t> numbers = file.table().subtrees[owner].lower_neighbours;
    numbers.push_back(owner);
    return numbers;
  }
  static std::vector<SeamMember> Members(const FolpFile& file, uint32_t owner,
                                         const std::deque<Subtree>& subtrees) {
    std::vector<SeamMember> members;
    for (uint32_t s : Numbers(file, owner)) {
      const EncodedSubtree& whole = subtrees[s].whole;
      members.push_back({s, &whole.border, whole.border_vertices.original});
    }
    return members;
  }
  static std::vector<SeamCoder::Participant> Participants(const FolpFile& file, uint32_t owner,
                                                          const std::deque<Subtree>& subtrees,
                                                          bool decoded) {
    std::vector<SeamCoder::Participant> participants;
    for (uint32_t s : Numbers(file, owner)) {
      participants.push_back(
          {s, decoded ? &subtrees[s].reader.state().border() : &subtrees[s].whole.border});
    }
    return participants;
  }

  uint32_t owner;
  WatchedSeamTruth truth;
  SeamCoder coder;
  BitEncoder bits;
  SeamReader reader;
};

EncodeOptions OptionsOf(const FolpFile& file, const std::string& folp) {
  EncodeOptions options;
  options.codec = file.parameters().settings;
  options.temporary_folder = std::filesystem::path(folp).parent_path().string();
  return options;
}

}  // namespace

struct LodReplay::Impl {
  Impl(const std::string& scan, const std::string& folp)
      : file(folp),
        runner(parallel::MakeSerialRunner()),
        job(scan, OptionsOf(file, folp), *runner, progress) {
    job.UseResolution({file.lattice(), file.table().tolerance});
    job.Partition();
    std::vector<bool> border = SubtreesWithBorder(file.table());
    for (uint32_t s = 0; s < file.table().subtrees.size(); ++s) {
      subtrees.emplace_back(job, file, s, border[s]);
    }
    for (uint32_t s = 0; s < subtrees.size(); ++s) {
      if (!file.table().subtrees[s].lower_neighbours.empty()) seams.emplace_back(file, s, subtrees);
    }
  }

  uint64_t VertexOf(const BorderRef& ref) const {
    return base[ref.subtree] + border_vertices[ref.subtree][ref.border];
  }

  FolpFile file;
  std::unique_ptr<parallel::Runner> runner;
  parallel::Progress progress;
  EncodeJob job;
  std::deque<Subtree> subtrees;  // addresses stay: seams point into them
  std::deque<Seam> seams;
  size_t layer = 0;
  std::vector<uint64_t> base;  ///< first LOD vertex of each subtree
  std::vector<std::vector<uint32_t>> border_vertices;
};

LodReplay::LodReplay(const std::string& scan, const std::string& folp)
    : impl_(std::make_unique<Impl>(scan, folp)) {}
LodReplay::~LodReplay() = default;

size_t LodReplay::layers() const { return impl_->file.table().layers.size(); }
size_t LodReplay::split_layers() const { return impl_->file.parameters().schedule.split_layers(); }
size_t LodReplay::subtrees() const { return impl_->subtrees.size(); }
double LodReplay::error_bound(size_t layer) const {
  return static_cast<double>(impl_->file.table().layers[layer].error_bound);
}

bool LodReplay::ThreeSubtreesMeet() const {
  for (const Subtree& subtree : impl_->subtrees) {
    for (const CrossFace& f : subtree.chunk.cross_faces) {
      uint32_t a = f.vertex[0].subtree, b = f.vertex[1].subtree, c = f.vertex[2].subtree;
      if (a != b && b != c && a != c) return true;
    }
  }
  return false;
}

void LodReplay::NextLayer() {
  CostMeters meters;
  const io::ContainerReader& container = impl_->file.container();
  for (uint32_t s = 0; s < impl_->subtrees.size(); ++s) {
    Subtree& subtree = impl_->subtrees[s];
    subtree.coder.CodeLayer(subtree.bits, &subtree.truth, &meters);
    CheckSegment(container, impl_->layer, s, io::SegmentPart::kInner, &subtree.bits);
    subtree.reader.DecodeLayer();
  }
  for (Seam& seam : impl_->seams) {
    seam.coder.CodeLayer(seam.bits, &seam.truth, &meters.seams);
    CheckSegment(container, impl_->layer, seam.owner, io::SegmentPart::kSeam, &seam.bits);
    seam.reader.DecodeLayer();
  }
  ++impl_->layer;
  CollectDecoded();
  CollectSeamEdges();
  CollectRepresentatives();
}

void LodReplay::CollectDecoded() {
  positions_.clear();
  faces_.clear();
  edges_.clear();
  impl_->base.clear();
  impl_->border_vertices.clear();
  Lattice lattice = impl_->file.lattice();
  for (const Subtree& subtree : impl_->subtrees) {
    const SubtreeCoder& state = subtree.reader.state();
    uint64_t base = positions_.size();
    impl_->base.push_back(base);
    impl_->border_vertices.push_back(state.BorderVertices());
    const std::vector<ExactPosition> drawn =
        state.DrawnPositions(lattice, error_bound(impl_->layer - 1));
    positions_.insert(positions_.end(), drawn.begin(), drawn.end());
    for (const Int3& p : state.positions()) {
      if (drawn.empty()) positions_.push_back(lattice.ToModel(p));
    }
    std::vector<Face> faces;
    state.AppendFaces(&faces);
    for (const Face& f : faces) faces_.push_back({base + f[0], base + f[1], base + f[2]});
    for (uint32_t e = 0; e < state.complex().edge_count(); ++e) {
      auto [a, b] = state.complex().edge(e);
      edges_.push_back({base + std::min(a, b), base + std::max(a, b)});
    }
  }
  std::vector<SeamFace> cross;
  for (const Seam& seam : impl_->seams) seam.reader.state().AppendFaces(&cross);
  for (const SeamFace& f : cross) {
    faces_.push_back({impl_->VertexOf(f[0]), impl_->VertexOf(f[1]), impl_->VertexOf(f[2])});
  }
}

void LodReplay::CollectSeamEdges() {
  for (const Seam& seam : impl_->seams) {
    const Complex& complex = seam.truth.complex();
    for (uint32_t e = 0; e < complex.edge_count(); ++e) {
      auto [a, b] = complex.edge(e);
      uint64_t from = impl_->VertexOf(seam.truth.name(a)), to = impl_->VertexOf(seam.truth.name(b));
      edges_.push_back({std::min(from, to), std::max(from, to)});
    }
  }
}

void LodReplay::CollectRepresentatives() {
  representatives_.clear();
  if (impl_->subtrees.empty()) return;
  for (const VertexRef& ref : impl_->job.scan().vertex_map()) {
    const auto& truth = impl_->subtrees[ref.subtree].truth;
    representatives_.push_back(impl_->base[ref.subtree] + truth.VertexOf(ref.local));
  }
}

}  // namespace folprom::support
