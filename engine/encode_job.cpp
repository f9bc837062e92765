#include "engine/encode_job.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/attributes/value_spans.h"
#include "engine/encode_estimate.h"
#include "engine/exact_resolution.h"
#include "engine/kept_attributes.h"
#include "engine/rounded_source.h"
#include "engine/weld/soup.h"

namespace folprom {

EncodeJob::EncodeJob(const std::string& input, const EncodeOptions& options,
                     parallel::Runner& runner, parallel::Progress& progress)
    : options_(options), runner_(runner), progress_(progress) {
  CheckOptions(options).value();
  source_ = io::MeshSource::Open(input, options.limits).value();
  if (options.attribute_bits.empty() || !KeepsAttributes(options_)) return;
  RoundedSource rounded = RoundAttributes(std::move(source_), options.attribute_bits, progress);
  source_ = std::move(rounded.source);
  rounded_ = std::move(rounded.ranges);
  rounding_warnings_ = std::move(rounded.warnings);
}

uint64_t EncodeJob::WorkingBytes() const {
  constexpr uint64_t kFixedBytes = uint64_t{96} << 20;  // the program, its libraries, the tables
  const uint64_t memory = options_.limits.memory_bytes;
  return memory > 2 * kFixedBytes ? memory - kFixedBytes : memory / 2;
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
  auto welded = std::make_unique<WeldedSource>(std::move(source_), WorkingBytes(), std::move(spill),
                                               runner_, progress_);
  welded_ = welded.get();
  source_ = std::move(welded);
}

const io::SpillDirectory& EncodeJob::spill() {
  if (!spill_) spill_ = std::make_unique<io::SpillDirectory>(options_.temporary_folder);
  return *spill_;
}

void EncodeJob::CheckRoom(const io::AtomicFile& out) {
  const ExpectedScan scan{*source_, source_->vertex_count()};
  folprom::CheckRoom(
      {spill().path(), io::VolumeOf(spill().path()), EstimateSpillBytes(scan, options_)},
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
  const io::SpillDirectory& folder = spill();
  PartitionSettings settings;
  settings.subtree_vertices = options_.codec.subtree_vertices;
  settings.metric_a = options_.codec.metric_a;
  settings.metric_b = options_.codec.metric_b;
  settings.normal_metric = options_.codec.subtree_normals;
  if (source_->vertex_count() > 0) {
    scan_ = PartitionScan(*source_, resolution_.lattice, settings, WorkingBytes(), runner_, folder,
                          progress_, KeepsAttributes(options_));
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
    if (Sections().order) sections_.Section(io::SectionKind::kOrder).emplace();
    return;
  }
  sections_ = folprom::EncodeSections(Sections(), *source_, *scan_, curve_->Map(), *spill_,
                                      options_.limits.memory_bytes, progress_);
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
