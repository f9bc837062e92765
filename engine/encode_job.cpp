#include "engine/encode_job.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/attributes/value_spans.h"
#include "engine/codec/border_file.h"
#include "engine/encode_estimate.h"
#include "engine/exact_resolution.h"
#include "engine/kept_attributes.h"
#include "engine/rounded_source.h"
#include "engine/weld/soup.h"
#include "io/container/checksum.h"
#include "io/container/writer.h"
#include "parallel/memory_budget.h"

namespace folprom {
namespace {

/// What the program itself, its libraries and the tables take.
constexpr uint64_t kFixedBytes = uint64_t{96} << 20;

uint64_t WorkingBytes(uint64_t memory_bytes) {
  return memory_bytes > 2 * kFixedBytes ? memory_bytes - kFixedBytes : memory_bytes / 2;
}

/// Returns the size of each; *hash: of the file.
std::vector<uint32_t> SpillSegments(const io::SpillDirectory& spill, const std::string& name,
                                    const std::vector<std::vector<uint8_t>>& segments,
                                    uint64_t* hash) {
  std::vector<uint8_t> joined;
  std::vector<uint32_t> sizes;
  for (const auto& segment : segments) {
    joined.insert(joined.end(), segment.begin(), segment.end());
    sizes.push_back(static_cast<uint32_t>(segment.size()));
  }
  io::WriteSpillFile(spill, name, joined);
  *hash = io::XxHash64(joined);
  return sizes;
}

}  // namespace

EncodeJob::EncodeJob(const std::string& input, const EncodeOptions& options,
                     parallel::Runner& runner, parallel::Progress& progress)
    : options_(options), runner_(runner), progress_(progress) {
  CheckOptions(options).value();
  source_ = io::MeshSource::Open(input, options.limits).value();
  spill_ = std::make_unique<io::SpillDirectory>(options.temporary_folder);
  if (options.attribute_bits.empty() || !KeepsAttributes(options_)) return;
  RoundedSource rounded = RoundAttributes(std::move(source_), options.attribute_bits, progress);
  source_ = std::move(rounded.source);
  rounded_ = std::move(rounded.ranges);
  rounding_warnings_ = std::move(rounded.warnings);
}

void EncodeJob::Weld(const io::AtomicFile& out, const std::string& spill_name) {
  const WeldKind kind = WeldFor(*source_, options_);
  if (kind == WeldKind::kAsItIs) return;
  is_soup_ = kind == WeldKind::kSoup;
  std::unique_ptr<io::SpillDirectory> spill;
  if (!spill_name.empty()) {
    spill = io::SpillDirectory::OpenNamed(options_.temporary_folder, spill_name + "-weld");
  }
  // Where the same job runs at this moment.
  if (!spill) spill = std::make_unique<io::SpillDirectory>(options_.temporary_folder);
  spill->Clear();
  folprom::CheckRoom({spill->path(), io::VolumeOf(spill->path()), WeldSpillBytes(*source_)},
                     {out.folder(), io::VolumeOf(out.folder()), 0});
  WeldScan(std::move(spill));
}

void EncodeJob::WeldScan(std::unique_ptr<io::SpillDirectory> spill) {
  if (source_->vertex_count() == 0) return;
  auto welded =
      std::make_unique<WeldedSource>(std::move(source_), WorkingBytes(options_.limits.memory_bytes),
                                     std::move(spill), runner_, progress_);
  welded_ = welded.get();
  source_ = std::move(welded);
}

void EncodeJob::CheckRoom(const io::AtomicFile& out) const {
  const ExpectedScan scan{*source_, source_->vertex_count()};
  folprom::CheckRoom(
      {spill_->path(), io::VolumeOf(spill_->path()), EstimateSpillBytes(scan, options_)},
      {out.folder(), io::VolumeOf(out.folder()), EstimateFileBytes(scan, options_)});
}

void EncodeJob::MeasureScan() {
  if (options_.keep_order && source_->notes().polygons_dropped > 0) {
    throw Failure(ErrorKind::kInput,
                  source_->path() + ": " + std::to_string(source_->notes().polygons_dropped) +
                      " faces of fewer than three corners, which cannot keep their place; without "
                      "keep_order they are dropped");
  }
  if (options_.exact) {
    MeasureExactScan();
    return;
  }
  // A message names the vertex as the file counts.
  Bounds bounds = MeasureBounds(original(), runner_, progress_);
  try {
    resolution_ = ResolutionOf(bounds, source_->coordinate_type(), options_);
  } catch (const Failure& failure) {
    throw Failure(failure.error().kind, source_->path() + ": " + failure.error().message);
  }
}

void EncodeJob::MeasureExactScan() {
  const bool is_float = OutputType(source_->coordinate_type()) == ScalarType::kFloat32;
  resolution_.lattice =
      ExactLatticeFor(TakeCensus(*source_, is_float, runner_, progress_), is_float);
  resolution_.lattice.exact->step.has_rests =
      HasRests(*source_, resolution_.lattice, runner_, progress_);
}

void EncodeJob::Partition() {
  PartitionSettings settings;
  settings.subtree_vertices = options_.codec.subtree_vertices;
  settings.metric_a = options_.codec.metric_a;
  settings.metric_b = options_.codec.metric_b;
  settings.normal_metric = options_.codec.subtree_normals;
  if (source_->vertex_count() > 0) {
    scan_ = PartitionScan(*source_, resolution_.lattice, settings,
                          WorkingBytes(options_.limits.memory_bytes), runner_, *spill_, progress_,
                          KeepsAttributes(options_));
  }
  source_->DropResident();
  outcomes_.resize(scan_ ? scan_->subtree_count() : 0);
  const double typical_edge = TypicalEdge();
  SetParameters(typical_edge);
  if (journal_ && scan_) BeginJournal(typical_edge);
}

void EncodeJob::SetParameters(double typical_edge) {
  const auto& extent = resolution_.lattice.extent;
  parameters_.settings = options_.codec;
  parameters_.extent = {extent[0], extent[1], extent[2]};
  parameters_.exact = resolution_.lattice.exact;
  parameters_.attributes = SpansOfAttributes();
  const uint32_t per_octave = options_.codec.steps_per_octave;
  const Offsets offsets = options_.codec.offsets;
  const uint32_t first_steps =
      FirstStepsFor(parameters_.extent, typical_edge, source_->vertex_count(),
                    options_.codec.least_layer, per_octave);
  const PartedSteps parted = PartedStepsFor(parameters_.extent, typical_edge, first_steps,
                                            options_.codec, outcomes_.size());
  parameters_.schedule = LayerSchedule(
      parameters_.extent, per_octave, options_.codec.rounds_per_step,
      SplitLayersFor(parameters_.extent, typical_edge, per_octave, offsets, first_steps, parted),
      RefineLayersFor(parameters_.extent, typical_edge, per_octave, offsets), first_steps, parted);
}

std::vector<ValueSpan> EncodeJob::SpansOfAttributes() const {
  if (!KeepsAttributes(options_)) return {};
  const io::VertexSchema& schema = source_->vertex_schema();
  // A scan without vertices is not partitioned.
  if (!scan_) {
    return ValueSpansOf(schema, std::vector<io::AttributeRange>(schema.attributes.size()));
  }
  const std::span<const io::AttributeRange> measured = scan_->attribute_ranges();
  std::vector<io::AttributeRange> ranges(measured.begin(), measured.end());
  for (size_t a = 0; a < rounded_.size(); ++a) {
    if (rounded_[a].step > 0) ranges[a] = rounded_[a];
  }
  return ValueSpansOf(schema, ranges);
}

double EncodeJob::TypicalEdge() const {
  constexpr size_t kSample = 4096;  // faces of each subtree
  std::vector<uint64_t> lengths(outcomes_.size(), 0), counts(outcomes_.size(), 0);
  runner_.ForEach(outcomes_.size(), [&](size_t s) {
    SubtreeChunk chunk = scan_->Load(s);
    size_t sampled = std::min(chunk.faces.size(), kSample);
    for (const Face& face : chunk.faces.first(sampled)) {
      for (size_t i = 0; i < 3; ++i) {
        Vector3 d = Difference(chunk.positions[face[i]], chunk.positions[face[(i + 1) % 3]]);
        lengths[s] += static_cast<uint64_t>(std::sqrt(Dot(d, d)));
      }
    }
    counts[s] = 3 * sampled;
  });
  uint64_t length = std::accumulate(lengths.begin(), lengths.end(), uint64_t{0});
  uint64_t count = std::accumulate(counts.begin(), counts.end(), uint64_t{0});
  return count == 0 ? 0 : static_cast<double>(length) / static_cast<double>(count);
}

void EncodeJob::EncodeSubtrees(bool keep_order, const char* stage) {
  std::vector<size_t> order;
  uint64_t done = 0;
  first_vertex_.assign(1, 0);
  for (size_t s = 0; s < outcomes_.size(); ++s) {
    const uint32_t vertices = scan_->summary(s).vertices;
    first_vertex_.push_back(first_vertex_.back() + vertices);
    if (outcomes_[s].has_inner) {
      done += vertices;
    } else {
      order.push_back(s);
    }
  }
  // The largest first: the last tasks to end are then small. Results do not depend on it.
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return scan_->summary(a).vertices > scan_->summary(b).vertices;
  });
  if (keep_order) order_.emplace(*spill_, "order");
  if (Sections().any()) curve_.emplace(*spill_, "curve");
  progress_.StartStage(stage, source_->vertex_count(), "vertices");
  progress_.Advance(done);
  parallel::MemoryBudget budget(WorkingBytes(options_.limits.memory_bytes) * 3 / 4);
  runner_.ForEach(order.size(), [&](size_t i) {
    const SubtreeSummary& summary = scan_->summary(order[i]);
    auto lease = budget.Acquire(EncodeSubtreeBytes(summary, parameters_));
    progress_.ThrowIfCancelled();  // behind the wait: the job may have been cancelled meanwhile
    EncodeOne(order[i], keep_order);
  });
}

void EncodeJob::EncodeOne(size_t subtree, bool keep_order) {
  const SubtreeSummary& summary = scan_->summary(subtree);
  const auto number = static_cast<uint32_t>(subtree);
  SubtreeChunk chunk = scan_->Load(subtree);
  size_t seen = 0;
  // Layer by layer, for a subtree takes seconds.
  const auto advance = [&](const SubtreeCoder& coder) {
    progress_.Advance(coder.positions().size() - seen);
    seen = coder.positions().size();
  };
  EncodedSubtree encoded = EncodeSubtree(chunk, summary, number, parameters_, {}, advance);
  SubtreeOutcome& outcome = outcomes_[subtree].inner;
  outcome.inner_bytes =
      SpillSegments(*spill_, InnerName(subtree), encoded.segments, &outcome.inner_hash);
  outcome.distance = std::move(encoded.distance);
  outcome.vertices = std::move(encoded.vertices);
  outcome.faces = std::move(encoded.faces);
  outcome.active = std::move(encoded.active);
  outcome.digest = encoded.digest;
  outcome.meters = encoded.meters;
  if (!summary.neighbours.empty()) {
    outcome.border_hash = SpillBorder(*spill_, number, encoded.border, encoded.border_vertices);
  }
  if (keep_order) {
    order_->WriteRecords<uint32_t>(first_vertex_[subtree], encoded.final_vertices);
  }
  if (curve_) {
    curve_->WriteRecords<uint32_t>(first_vertex_[subtree],
                                   CurvePlaces(chunk.positions, encoded.final_vertices));
  }
  if (journal_) journal_->Add(number, outcome);
  outcomes_[subtree].has_inner = true;
}

std::vector<uint32_t> EncodeJob::SeamMembers(size_t owner) const {
  std::vector<uint32_t> members;
  for (uint32_t neighbour : scan_->summary(owner).neighbours) {
    if (neighbour < owner) members.push_back(neighbour);
  }
  return members;
}

void EncodeJob::EncodeSeams() {
  progress_.StartStage("seams", outcomes_.size());
  parallel::MemoryBudget budget(WorkingBytes(options_.limits.memory_bytes) * 3 / 4);
  runner_.ForEach(outcomes_.size(), [&](size_t owner) {
    if (!outcomes_[owner].has_seam && !SeamMembers(owner).empty()) {
      std::vector<uint32_t> members = SeamMembers(owner);
      members.push_back(static_cast<uint32_t>(owner));
      auto lease = budget.Acquire(
          EncodeSeamBytes(BorderBytes(*spill_, members), scan_->summary(owner).cross_faces));
      progress_.ThrowIfCancelled();
      EncodeOneSeam(owner, members);
    }
    progress_.Advance(1);
  });
}

void EncodeJob::EncodeOneSeam(size_t owner, const std::vector<uint32_t>& members) {
  std::vector<BorderFile> borders;
  for (uint32_t member : members) borders.push_back(LoadBorder(*spill_, member));
  SubtreeChunk chunk = scan_->Load(owner);
  EncodedSeam encoded = EncodeSeam(members, borders, chunk.cross_faces, parameters_);
  SeamOutcome& outcome = outcomes_[owner].seam;
  outcome.bytes = SpillSegments(*spill_, SeamName(owner), encoded.segments, &outcome.hash);
  outcome.faces = std::move(encoded.faces);
  outcome.active = std::move(encoded.active);
  outcome.face_digest = encoded.digest.faces;
  outcome.meter = encoded.meter;
  if (journal_) journal_->Add(static_cast<uint32_t>(owner), outcome);
  outcomes_[owner].has_seam = true;
}

SectionChoice EncodeJob::Sections() const {
  SectionChoice choice;
  choice.order = options_.keep_order;
  choice.is_soup = is_soup_;
  choice.polygons =
      options_.codec.offsets == Offsets::kLattice && source_->notes().polygons_triangulated > 0;
  choice.face_values =
      KeepsAttributes(options_) && !source_->face_schema().empty() && source_->triangle_count() > 0;
  return choice;
}

void EncodeJob::EncodeSections() {
  if (!Sections().any()) return;
  if (!scan_) {
    // Of no vertex at all there is nothing to tell.
    if (Sections().order) sections_.records[static_cast<size_t>(io::SectionKind::kOrder)].emplace();
    return;
  }
  sections_ = folprom::EncodeSections(Sections(), *source_, *scan_, curve_->Map(), *spill_,
                                      options_.limits.memory_bytes, progress_);
}

void EncodeJob::DropEmptyLayers() {
  // A layer in which nothing changes in any subtree can go where the schedule does not count on it:
  // the last split layers but one, and the first refinements.
  uint32_t split = parameters_.schedule.split_layers(), all = parameters_.schedule.layers();
  auto active = [&](uint32_t layer) {
    return std::any_of(outcomes_.begin(), outcomes_.end(),
                       [&](const Outcome& outcome) { return outcome.IsActive(layer); });
  };
  // The last split layer takes its precision from the layer before it.
  const bool lattice = options_.codec.offsets == Offsets::kLattice;
  const auto shift_after = [&](uint32_t layers) {
    return lattice && layers > 0 ? parameters_.schedule.LatticeShift(layers - 1) : 0;
  };
  uint32_t kept_split = split - 1;
  while (kept_split > 0 && !active(kept_split - 1) &&
         shift_after(kept_split - 1) == shift_after(split - 1)) {
    --kept_split;
  }
  uint32_t first_refine = split;
  while (first_refine < all && !active(first_refine)) ++first_refine;
  kept_layers_.clear();
  for (uint32_t layer = 0; layer < kept_split; ++layer) kept_layers_.push_back(layer);
  kept_layers_.push_back(split - 1);
  for (uint32_t layer = first_refine; layer < all; ++layer) kept_layers_.push_back(layer);
  parameters_.schedule =
      LayerSchedule(parameters_.extent, options_.codec.steps_per_octave,
                    options_.codec.rounds_per_step, kept_split + 1, all - first_refine,
                    parameters_.schedule.first_steps(), parameters_.schedule.parted());
}

io::FileTable EncodeJob::MakeTable() {
  DropEmptyLayers();
  io::FileTable table;
  table.vertices = source_->vertex_count();
  table.faces = source_->triangle_count();
  table.is_soup = is_soup_;
  table.coordinate_type = static_cast<uint8_t>(OutputType(source_->coordinate_type()));
  table.origin = resolution_.lattice.origin;
  table.unit = resolution_.lattice.unit;
  table.extent = resolution_.lattice.extent;
  table.tolerance = resolution_.tolerance;
  table.codec = WriteParameters(parameters_);
  if (KeepsAttributes(options_)) table.schema = source_->vertex_schema();
  if (options_.attributes) table.remarks = source_->remarks();
  if (Sections().face_values) table.face_schema = source_->face_schema();
  table.face_ranges = sections_.face_ranges;
  for (const ValueSpan& span : parameters_.attributes) {
    table.attribute_ranges.push_back({span.least, span.most, span.step, span.first});
  }
  costs_ = {};
  costs_.attributes.resize(parameters_.attributes.size(), 0);
  for (size_t s = 0; s < outcomes_.size(); ++s) {
    const Outcome& outcome = outcomes_[s];
    const SubtreeSummary& summary = scan_->summary(s);
    io::SubtreeRecord record;
    record.vertices = summary.vertices;
    record.box_lo = {summary.box_lo.x, summary.box_lo.y, summary.box_lo.z};
    record.box_hi = {summary.box_hi.x, summary.box_hi.y, summary.box_hi.z};
    record.lower_neighbours = SeamMembers(s);
    table.subtrees.push_back(std::move(record));
    table.digest.vertices += outcome.inner.digest.vertices;
    table.digest.faces += outcome.inner.digest.faces + outcome.seam.face_digest;
    costs_ += outcome.inner.meters;
    costs_.seams += outcome.seam.meter;
  }
  table.kind_bits = {costs_.split / 1024,
                     (costs_.root + costs_.offsets.Sum()) / 1024,
                     (costs_.refinement + costs_.rests) / 1024,
                     costs_.connectivity.Sum() / 1024,
                     costs_.exceptions / 1024,
                     costs_.seams / 1024};
  for (uint64_t cost : costs_.attributes) table.attribute_bits.push_back(cost / 1024);
  table.sections = sections_.records;
  table.polygons = sections_.polygons;
  table.largest_face = sections_.largest_face;
  for (uint32_t layer : kept_layers_) {
    io::LayerRecord record;
    double distance = 0;
    for (const Outcome& outcome : outcomes_) {
      distance = std::max(distance, outcome.inner.distance[layer]);
      record.vertices += outcome.inner.vertices[layer];
      record.faces += outcome.inner.faces[layer];
      if (outcome.has_seam) record.faces += outcome.seam.faces[layer];
      table.segment_bytes.push_back(outcome.inner.inner_bytes[layer]);
      table.segment_bytes.push_back(outcome.has_seam ? outcome.seam.bytes[layer] : 0);
    }
    // Half a lattice unit per axis for the rounding of the original, or a
    // whole one where rests follow in the last layer.
    double rounding = parameters_.exact ? 2 : 1;
    double bound = outcomes_.empty() ? 0 : (distance + rounding) * resolution_.lattice.unit;
    // Vertices that stand for others may be drawn off the mesh.
    if (parameters_.fits_lods() && record.vertices < table.vertices) bound /= 1 - kShiftPart;
    record.error_bound = io::NextErrorBound(bound);
    if (parameters_.exact && layer == kept_layers_.back()) record.error_bound = 0;
    table.layers.push_back(record);
  }
  return table;
}

uint64_t EncodeJob::WriteFile(const io::FileTable& table, io::AtomicFile& out) {
  // Positions of the kept layers inside the spilled segments of a subtree.
  auto begins = [](const std::vector<uint32_t>& sizes) {
    std::vector<uint64_t> begin(1, 0);
    for (uint32_t size : sizes) begin.push_back(begin.back() + size);
    return begin;
  };
  progress_.StartStage("write", table.layers.size());
  io::MappedFile mapped;
  size_t last_layer = 0;
  return io::WriteContainer(
      table,
      [&](size_t layer, size_t subtree, io::SegmentPart part) -> std::span<const uint8_t> {
        if (layer != last_layer) progress_.Advance(layer - last_layer);
        last_layer = layer;
        bool inner = part == io::SegmentPart::kInner;
        const Outcome& outcome = outcomes_[subtree];
        if (!inner && !outcome.has_seam) return {};
        const auto& sizes = inner ? outcome.inner.inner_bytes : outcome.seam.bytes;
        uint32_t stored = kept_layers_[layer];
        if (sizes[stored] == 0) return {};
        std::string name = inner ? InnerName(subtree) : SeamName(subtree);
        mapped = io::MapSpillFile(spill_->File(name));
        return mapped.bytes().subspan(begins(sizes)[stored], sizes[stored]);
      },
      out,
      [&](io::SectionKind kind) {
        const auto& section = table.Section(kind);
        mapped = section->bytes == 0 ? io::MappedFile() : SectionFile(*spill_, kind);
        return mapped.bytes();
      });
}

std::vector<std::string> EncodeJob::Warnings() const {
  std::vector<std::string> warnings;
  if (!resume_note_.empty()) warnings.push_back(resume_note_);
  warnings.insert(warnings.end(), rounding_warnings_.begin(), rounding_warnings_.end());
  const io::SourceNotes& notes = source_->notes();
  auto count = [](uint64_t n, const char* one, const char* many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
  };
  if (notes.polygons_triangulated > 0 && !Sections().polygons) {
    warnings.push_back(count(notes.polygons_triangulated, "polygon", "polygons") +
                       " cut into triangles");
  }
  if (notes.strips > 0) {
    warnings.push_back(count(notes.strips, "triangle strip", "triangle strips") + " unrolled");
  }
  if (notes.polygons_dropped > 0) {
    warnings.push_back(count(notes.polygons_dropped, "face", "faces") +
                       " of fewer than three corners dropped");
  }
  std::vector<std::string> ignored = notes.ignored_properties;
  if (!KeepsAttributes(options_)) {
    for (const io::VertexAttribute& attribute : source_->vertex_schema().attributes) {
      ignored.push_back("vertex." + attribute.name);
    }
    for (const io::FaceAttribute& attribute : source_->face_schema().attributes) {
      ignored.push_back("face." + attribute.name);
    }
  }
  if (!ignored.empty()) {
    std::string names;
    for (const std::string& name : ignored) names += (names.empty() ? "" : ", ") + name;
    warnings.push_back("properties not kept: " + names);
  }
  if (options_.attributes && notes.remarks_dropped > 0) {
    warnings.push_back(count(notes.remarks_dropped, "comment", "comments") +
                       " dropped: more than 64 KiB, or not of text");
  }
  return warnings;
}

}  // namespace folprom
