// Encoding, stage by stage.
#include "engine/encode_job.h"
#include "engine/run_guarded.h"
#include "folprom/folprom.h"

namespace folprom {
namespace {

BitCounts BitsOf(const CostMeters& costs) {
  auto bits = [](uint64_t cost) { return static_cast<double>(cost) / 1024; };
  BitCounts counts;
  counts.split = bits(costs.split);
  counts.root = bits(costs.root);
  counts.theta = bits(costs.offsets.theta);
  counts.rho = bits(costs.offsets.rho);
  counts.z = bits(costs.offsets.z);
  counts.refinement = bits(costs.refinement);
  counts.connected = bits(costs.connectivity.connected);
  counts.pivots = bits(costs.connectivity.pivots);
  counts.sides = bits(costs.connectivity.sides);
  counts.exceptions = bits(costs.exceptions);
  counts.seams = bits(costs.seams);
  counts.rests = bits(costs.rests);
  for (uint64_t cost : costs.attributes) counts.attributes += bits(cost);
  return counts;
}

EncodeReport Encode(EncodeJob& job, const std::string& output, const EncodeOptions& options,
                    Resume resume) {
  auto out = io::AtomicFile::Create(output, options.overwrite).value();
  // What the sections need of each subtree is not among what is kept.
  const bool is_kept = resume != Resume::kNever && !job.HasSections();
  job.Weld(*out, is_kept ? SpillName(job.source().path(), output) : "");
  if (!is_kept || !job.Resume(output, resume)) {
    job.CheckRoom(*out);
    job.MeasureScan();
    job.Partition();
  }
  job.EncodeSubtrees(false);
  job.EncodeSeams();
  job.EncodeSections();
  io::FileTable table = job.MakeTable();
  EncodeReport report;
  report.bytes = job.WriteFile(table, *out);
  report.spill_bytes = job.PeakSpillBytes();
  job.source().CheckUnchanged().value();
  report.resumed_subtrees = job.resumed_subtrees();
  out->Commit().value();
  const auto bytes_of = [&](io::SectionKind kind) {
    return table.Section(kind) ? table.Section(kind)->bytes : 0;
  };
  report.order_bytes = bytes_of(io::SectionKind::kOrder);
  report.polygon_bytes = bytes_of(io::SectionKind::kPolygons);
  report.face_attribute_bytes = bytes_of(io::SectionKind::kFaceValues);
  report.vertices = table.vertices;
  report.scan_vertices = job.original().vertex_count();
  report.is_soup = table.is_soup;
  report.faces = table.faces;
  report.subtrees = table.subtrees.size();
  report.layers = table.layers.size();
  report.bits = BitsOf(job.costs());
  for (size_t a = 0; a < table.schema.attributes.size(); ++a) {
    const io::VertexAttribute& attribute = table.schema.attributes[a];
    report.attributes.push_back({attribute.name, attribute.type,
                                 static_cast<double>(job.costs().attributes[a]) / 1024,
                                 table.attribute_ranges[a].step});
  }
  for (const io::FaceAttribute& attribute : table.face_schema.attributes) {
    report.face_attributes.push_back({attribute.name, attribute.type, attribute.per_corner});
  }
  report.warnings = job.Warnings();
  return report;
}

}  // namespace

Result<EncodeReport> EncodeFile(const std::string& input, const std::string& output,
                                const EncodeOptions& options, parallel::Runner& runner,
                                parallel::Progress& progress, Resume resume) {
  return RunGuarded<EncodeReport>([&] {
    EncodeJob job(input, options, runner, progress);
    try {
      return Encode(job, output, options, resume);
    } catch (const parallel::Cancelled&) {
      const std::string kept = job.KeepSpill();
      if (kept.empty()) throw;
      throw Failure(ErrorKind::kInterrupted,
                    "interrupted; the same command goes on from what is in " + kept);
    } catch (const Failure&) {
      // Passes that saw different scans fail anyhow and anywhere.
      job.source().CheckUnchanged().value();
      throw;
    }
  });
}

}  // namespace folprom
