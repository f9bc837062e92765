// What an encoding writes: its table, and the bits that were spilled.
#include <algorithm>
#include <numeric>

#include "engine/encode_job.h"
#include "engine/kept_attributes.h"
#include "io/container/writer.h"

namespace folprom {

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
  DescribeScan(&table);
  AddSubtrees(&table);
  AddCosts(&table);
  for (const uint32_t layer : kept_layers_) AddLayer(layer, &table);
  return table;
}

void EncodeJob::DescribeScan(io::FileTable* table) const {
  table->vertices = source_->vertex_count();
  table->faces = source_->triangle_count();
  table->is_soup = is_soup_;
  table->coordinate_type = static_cast<uint8_t>(OutputType(source_->coordinate_type()));
  table->origin = resolution_.lattice.origin;
  table->unit = resolution_.lattice.unit;
  table->extent = resolution_.lattice.extent;
  table->tolerance = resolution_.tolerance;
  table->codec = WriteParameters(parameters_);
  if (KeepsAttributes(options_)) table->schema = source_->vertex_schema();
  if (options_.attributes) table->remarks = source_->remarks();
  if (Sections().face_values) table->face_schema = source_->face_schema();
  table->face_ranges = sections_.face_ranges;
  for (const ValueSpan& span : parameters_.attributes) {
    table->attribute_ranges.push_back({span.least, span.most, span.step, span.first});
  }
  table->sections = sections_.records;
  table->polygons = sections_.polygons;
  table->largest_face = sections_.largest_face;
}

void EncodeJob::AddSubtrees(io::FileTable* table) {
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
    table->subtrees.push_back(std::move(record));
    table->digest.vertices += outcome.inner.digest.vertices;
    table->digest.faces += outcome.inner.digest.faces + outcome.seam.face_digest;
    costs_ += outcome.inner.meters;
    costs_.seams += outcome.seam.meter;
  }
}

void EncodeJob::AddCosts(io::FileTable* table) const {
  table->kind_bits = {costs_.split / 1024,
                      (costs_.root + costs_.offsets.Sum()) / 1024,
                      (costs_.refinement + costs_.rests) / 1024,
                      costs_.connectivity.Sum() / 1024,
                      costs_.exceptions / 1024,
                      costs_.seams / 1024};
  for (const uint64_t cost : costs_.attributes) table->attribute_bits.push_back(cost / 1024);
}

void EncodeJob::AddLayer(uint32_t layer, io::FileTable* table) const {
  io::LayerRecord record;
  double distance = 0;
  for (const Outcome& outcome : outcomes_) {
    distance = std::max(distance, outcome.inner.distance[layer]);
    record.vertices += outcome.inner.vertices[layer];
    record.faces += outcome.inner.faces[layer];
    if (outcome.has_seam) record.faces += outcome.seam.faces[layer];
    table->segment_bytes.push_back(outcome.inner.inner_bytes[layer]);
    table->segment_bytes.push_back(outcome.has_seam ? outcome.seam.bytes[layer] : 0);
  }
  // Half a lattice unit per axis for the rounding of the original, or a
  // whole one where rests follow in the last layer.
  const double rounding = parameters_.exact ? 2 : 1;
  double bound = outcomes_.empty() ? 0 : (distance + rounding) * resolution_.lattice.unit;
  // Vertices that stand for others may be drawn off the mesh.
  if (parameters_.fits_lods() && record.vertices < table->vertices) bound /= 1 - kShiftPart;
  record.error_bound = io::NextErrorBound(bound);
  if (parameters_.exact && layer == kept_layers_.back()) record.error_bound = 0;
  table->layers.push_back(record);
}

uint64_t EncodeJob::WriteFile(const io::FileTable& table, io::AtomicFile& out) {
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
        const uint64_t begin = std::accumulate(sizes.begin(), sizes.begin() + stored, uint64_t{0});
        return mapped.bytes().subspan(begin, sizes[stored]);
      },
      out,
      [&](io::SectionKind kind) {
        const auto& section = table.Section(kind);
        mapped = section->bytes == 0 ? io::MappedFile() : SectionFile(*spill_, kind);
        return mapped.bytes();
      });
}

}  // namespace folprom
