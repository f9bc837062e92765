// Encoding, stage by stage.
#include "engine/encode_job.h"
#include "folprom/folprom.h"
#include "engine/run_guarded.h"

namespace folprom {

Result<EncodeReport> EncodeFile(const std::string& input, const std::string& output,
                                const EncodeOptions& options, parallel::Runner& runner,
                                parallel::Progress& progress) {
  return RunGuarded<EncodeReport>([&] {
    EncodeJob job(input, options, runner, progress);
    auto out = io::AtomicFile::Create(output, options.overwrite).value();
    job.MeasureScan();
    job.Partition();
    job.EncodeSubtrees(false);
    job.EncodeSeams();
    io::FileTable table = job.MakeTable();
    EncodeReport report;
    report.bytes = job.WriteFile(table, *out);
    out->Commit().value();
    report.vertices = table.vertices;
    report.faces = table.faces;
    report.subtrees = table.subtrees.size();
    report.layers = table.layers.size();
    report.spill_bytes = job.spill().SizeBytes();
    report.warnings = job.Warnings();
    return report;
  });
}

}  // namespace folprom
