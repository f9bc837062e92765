// Is what comes back what went in: by the digest in the file, or vertex by vertex with the scan.
#include <optional>

#include "engine/folp_file.h"
#include "engine/mesh_sinks.h"
#include "engine/run_guarded.h"
#include "engine/verify_decoding.h"
#include "engine/verify_scan.h"
#include "engine/verify_sections.h"
#include "folprom/folprom.h"

namespace folprom {
namespace {

void CompareDigest(const FolpFile& file, const DecodeOptions& options, parallel::Runner& runner,
                   parallel::Progress& progress, VerifyReport* report) {
  const io::FileTable& table = file.table();
  DigestSink sink(file.lattice());
  std::optional<io::SpillDirectory> spill;
  std::optional<OrderedMesh> ordered;
  if (table.HasSections()) {
    spill.emplace(options.temporary_folder);
    ordered.emplace(file.container(), file.lattice(), *spill, options.limits.memory_bytes);
  }
  DecodeWhole(file, options, runner, progress, sink, ordered ? &*ordered : nullptr);
  if (sink.vertices() != table.vertices || sink.faces() != table.faces) {
    report->reason = "decoded counts differ from those of the table";
  } else if (IsDigestOf(file, sink.digest(), report) && ordered) {
    CheckSections(*ordered);
  }
}

}  // namespace

Result<VerifyReport> VerifyFile(const std::string& input, const std::string& original,
                                const DecodeOptions& options, parallel::Runner& runner,
                                parallel::Progress& progress) {
  return RunGuarded<VerifyReport>([&] {
    const FolpFile file(input);
    file.CheckLimits(options.limits);
    VerifyReport report;
    report.vertices = file.table().vertices;
    report.faces = file.table().faces;
    report.tolerance = file.table().tolerance;
    report.against = !original.empty();
    report.order_kept = file.table().Section(io::SectionKind::kOrder).has_value();
    size_t present = file.container().complete_layers(), all = file.container().layers_total();
    if (present < all) {
      report.reason = "the file is cut: " + std::to_string(present) + " of " + std::to_string(all) +
                      " layers are whole";
    } else if (file.table().HasSections() && !HasWholeSections(file.container())) {
      report.reason =
          "the file is cut: the scan's order, polygons and attributes of faces are not there";
    } else if (original.empty()) {
      CompareDigest(file, options, runner, progress, &report);
    } else {
      CompareWithScan(file, original, options, runner, progress, &report);
    }
    file.CheckUnchanged();
    report.lossless = report.reason.empty();
    return report;
  });
}

}  // namespace folprom
