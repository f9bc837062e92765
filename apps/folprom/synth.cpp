#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "apps/folprom/options.h"
#include "apps/folprom/report.h"
#include "apps/folprom/session.h"
#include "apps/folprom/synth_surface.h"
#include "apps/folprom/verbs.h"
#include "io/formats/mesh_writer.h"

namespace folprom::cli {
namespace {

constexpr const char* kDescription =
    "Make a scan-like mesh of any size, for tests\n"
    "\n"
    "  folprom synth --vertices 10M -o scan.ply\n"
    "  folprom synth --vertices 100k --seed 7 -o small.ply\n"
    "  folprom synth --kind range --vertices 1M -o depth_images.ply";

struct SynthFlags {
  CommonFlags common;
  std::string output;
  std::optional<uint64_t> vertices;
  SynthKind kind = SynthKind::kScan;
  uint64_t seed = 1;
  bool force = false;
};

class FileSink : public SurfaceSink {
 public:
  explicit FileSink(io::MeshWriter& writer) : writer_(writer) {}
  void AddVertices(std::span<const double> xyz) override { writer_.AppendVertices(xyz).value(); }
  void AddFaces(std::span<const io::Triangle> faces) override {
    writer_.AppendFaces(faces).value();
  }

 private:
  io::MeshWriter& writer_;
};

int Run(const SynthFlags& flags) {
  const uint64_t vertices = *flags.vertices;
  if (vertices < SynthSurface::kMinVertices || vertices > SynthSurface::kMaxVertices) {
    throw Failure(ErrorKind::kUsage,
                  fmt::format("--vertices: must be {} .. {}", SynthSurface::kMinVertices,
                              SynthSurface::kMaxVertices));
  }
  io::OutputFormat(flags.output).value();
  CheckOutput("", flags.output, flags.force);
  Session session(flags.common);
  const SynthSurface surface(flags.kind, vertices, flags.seed, session.progress());
  auto writer =
      io::MeshWriter::Create(flags.output,
                             {surface.vertex_count(), surface.face_count(), ScalarType::kFloat32},
                             flags.force)
          .value();
  FileSink sink(*writer);
  surface.Generate(sink, session.progress());
  writer->Commit().value();
  session.StopDisplay();
  LogWarnings(writer->Warnings());

  if (flags.common.json) {
    PrintJson({{"output", flags.output},
               {"vertices", surface.vertex_count()},
               {"faces", surface.face_count()},
               {"kind", flags.kind == SynthKind::kRange ? "range" : "scan"},
               {"seed", flags.seed},
               {"seconds", session.seconds()},
               {"peak_rss_bytes", PeakResidentBytes()}});
  } else if (!flags.common.quiet) {
    Print(fmt::format("{}: {} vertices, {} faces; {:.1f} s, {} memory\n", flags.output,
                      Grouped(surface.vertex_count()), Grouped(surface.face_count()),
                      session.seconds(), BytesShort(PeakResidentBytes())));
  }
  return 0;
}

}  // namespace

Verb AddSynth(CLI::App& program) {
  auto flags = std::make_shared<SynthFlags>();
  CLI::App* verb = program.add_subcommand("synth", kDescription);
  AddCountOption(verb, "--vertices", &flags->vertices, "How many vertices, 20k or 10M")->required();
  verb->add_option("--kind", flags->kind,
                   "scan: irregular; range: depth images, regular grids; default scan")
      ->transform(
          CLI::CheckedTransformer(std::map<std::string, SynthKind>{{"scan", SynthKind::kScan},
                                                                   {"range", SynthKind::kRange}},
                                  CLI::ignore_case))
      ->type_name("KIND");
  verb->add_option("--seed", flags->seed, "Another seed gives another surface; default 1")
      ->type_name("S");
  verb->add_option("-o,--output", flags->output, "Mesh to write: .ply, .obj, .stl or .off")
      ->type_name("SCAN")
      ->required();
  verb->add_flag("-f,--force", flags->force, "May replace the output");
  AddCommonFlags(verb, &flags->common);
  AddProgressFlag(verb, &flags->common);
  return {verb, [flags] { return Run(*flags); }};
}

}  // namespace folprom::cli
