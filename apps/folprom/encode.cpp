#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "apps/folprom/config.h"
#include "apps/folprom/limit_flags.h"
#include "apps/folprom/options.h"
#include "apps/folprom/report.h"
#include "apps/folprom/session.h"
#include "apps/folprom/verbs.h"
#include "folprom/folprom.h"

namespace folprom::cli {
namespace {

constexpr const char* kDescription =
    "Encode a mesh as one progressive, lossless file\n"
    "\n"
    "  folprom encode scan.ply -o scan.folp\n"
    "  folprom encode scan.ply -o scan.folp --bits 16 -T 8 -M 4GiB\n"
    "  folprom encode scan.ply -o scan.folp --config configs/paper.toml\n"
    "  folprom encode scan.ply -o scan.folp --exact --effort 9\n"
    "  folprom encode scan.ply --estimate\n"
    "  folprom encode --print-config > my.toml";

struct EncodeFlags {
  CommonFlags common;
  WorkFlags work;
  LimitFlags limits;
  std::string input;
  std::string output;
  std::string config;
  std::optional<uint32_t> effort;
  std::optional<uint32_t> bits;
  std::optional<double> tolerance;
  bool exact = false;
  bool no_attributes = false;
  std::vector<std::string> attribute_bits;
  bool keep_order = false;
  bool weld = false;
  std::optional<uint64_t> subtree_vertices;
  bool print_config = false;
  bool force = false;
  bool restart = false;
  bool estimate = false;
};

// Defaults, then the config file, then the flags.
EncodeConfig Settings(const EncodeFlags& flags) {
  EncodeConfig config;
  if (!flags.config.empty()) ReadConfig(flags.config, &config).value();
  EncodeOptions& options = config.options;
  if (flags.effort) options.codec = WithEffort(options.codec, *flags.effort);
  if (flags.bits) {
    options.bits = *flags.bits;
    options.tolerance = 0;
  }
  if (flags.tolerance) options.tolerance = *flags.tolerance;
  if (flags.bits || flags.tolerance) options.exact = false;
  if (flags.exact) options.exact = true;
  if (flags.no_attributes) options.attributes = false;
  if (!flags.attribute_bits.empty()) options.attribute_bits = flags.attribute_bits;
  if (flags.keep_order) options.keep_order = true;
  if (flags.weld) options.weld = true;
  if (flags.subtree_vertices) {
    // What does not fit is out of range in any case.
    options.codec.subtree_vertices =
        static_cast<uint32_t>(std::min<uint64_t>(*flags.subtree_vertices, UINT32_MAX));
  }
  if (flags.work.threads) config.threads = *flags.work.threads;
  flags.limits.ApplyTo(&options.limits);
  if (flags.work.memory) options.limits.memory_bytes = *flags.work.memory;
  if (flags.work.temporary_folder) options.temporary_folder = *flags.work.temporary_folder;
  options.overwrite = flags.force;
  CheckConfig(config).value();
  return config;
}

Json BitsJson(const BitCounts& bits) {
  return {{"split", bits.split},
          {"root", bits.root},
          {"theta", bits.theta},
          {"rho", bits.rho},
          {"z", bits.z},
          {"refinement", bits.refinement},
          {"connected", bits.connected},
          {"pivots", bits.pivots},
          {"sides", bits.sides},
          {"exceptions", bits.exceptions},
          {"seams", bits.seams},
          {"rests", bits.rests},
          {"attributes", bits.attributes}};
}

void PrintReport(const EncodeFlags& flags, const EncodeReport& report, double seconds) {
  const double bits_per_vertex = report.vertices == 0 ? 0
                                                      : 8 * static_cast<double>(report.bytes) /
                                                            static_cast<double>(report.vertices);
  if (flags.common.json) {
    PrintJson({{"output", flags.output},
               {"vertices", report.vertices},
               {"faces", report.faces},
               {"scan_vertices", report.scan_vertices},
               {"is_soup", report.is_soup},
               {"bytes", report.bytes},
               {"order_bytes", report.order_bytes},
               {"polygon_bytes", report.polygon_bytes},
               {"face_attribute_bytes", report.face_attribute_bytes},
               {"bits_per_vertex", bits_per_vertex},
               {"seconds", seconds},
               {"peak_rss_bytes", PeakResidentBytes()},
               {"subtrees", report.subtrees},
               {"layers", report.layers},
               {"spill_bytes", report.spill_bytes},
               {"resumed_subtrees", report.resumed_subtrees},
               {"bits", BitsJson(report.bits)},
               {"attributes", AttributesJson(report.attributes, report.vertices)},
               {"face_attributes", FaceAttributesJson(report.face_attributes)},
               {"warnings", report.warnings}});
  } else if (!flags.common.quiet) {
    Print(fmt::format(
        "{}: {} vertices, {} faces in {} bytes, {:.2f} bits per vertex\n"
        "{} layers, {} subtrees; {:.1f} s, {} memory, {} temporary disk\n",
        flags.output, Grouped(report.vertices), Grouped(report.faces), Grouped(report.bytes),
        bits_per_vertex, Grouped(report.layers), Grouped(report.subtrees), seconds,
        BytesShort(PeakResidentBytes()), BytesShort(report.spill_bytes)));
    if (report.is_soup) {
      Print(fmt::format("a soup: its {} vertices lie at these {} places\n",
                        Grouped(report.scan_vertices), Grouped(report.vertices)));
    } else if (report.scan_vertices != report.vertices) {
      Print(fmt::format("welded: the scan has {} vertices\n", Grouped(report.scan_vertices)));
    }
    if (report.resumed_subtrees > 0) {
      Print(fmt::format("{} subtrees were there from the interrupted encoding\n",
                        Grouped(report.resumed_subtrees)));
    }
  }
}

void PrintEstimate(const EncodeFlags& flags, const EncodeEstimate& estimate) {
  if (flags.common.json) {
    PrintJson({{"input", flags.input},
               {"vertices", estimate.vertices},
               {"faces", estimate.faces},
               {"memory_bytes", estimate.memory_bytes},
               {"spill_bytes", estimate.spill_bytes},
               {"file_bytes", estimate.file_bytes},
               {"seconds", estimate.seconds}});
  } else {
    Print(fmt::format(
        "{}: {} vertices, {} faces; about {} s, {} memory, {} temporary disk, {} output\n",
        flags.input, Grouped(estimate.vertices), Grouped(estimate.faces),
        Grouped(static_cast<uint64_t>(std::ceil(estimate.seconds))),
        BytesShort(estimate.memory_bytes), BytesShort(estimate.spill_bytes),
        BytesShort(estimate.file_bytes)));
  }
}

int Estimate(const EncodeFlags& flags, const EncodeConfig& config) {
  const auto runner = MakeRunner(flags.work, config.threads);
  Session session(flags.common);
  const EncodeEstimate estimate =
      EstimateEncode(flags.input, config.options, *runner, session.progress()).value();
  session.StopDisplay();
  PrintEstimate(flags, estimate);
  return 0;
}

int Run(const EncodeFlags& flags) {
  const EncodeConfig config = Settings(flags);
  if (flags.print_config) {
    Print(ConfigText(config));
    return 0;
  }
  if (flags.input.empty()) throw Failure(ErrorKind::kUsage, "encode needs SCAN, the mesh to read");
  if (flags.estimate) return Estimate(flags, config);
  if (flags.output.empty()) {
    throw Failure(ErrorKind::kUsage, "encode needs -o, the file to write");
  }
  CheckOutput(flags.input, flags.output, flags.force);
  const auto runner = MakeRunner(flags.work, config.threads);
  Session session(flags.common);
  spdlog::debug("{} threads, {} memory", runner->threads(),
                BytesShort(config.options.limits.memory_bytes));
  const EncodeReport report =
      EncodeFile(flags.input, flags.output, config.options, *runner, session.progress(),
                 flags.restart ? Resume::kRestart : Resume::kContinue)
          .value();
  session.StopDisplay();
  LogWarnings(report.warnings);
  PrintReport(flags, report, session.seconds());
  return 0;
}

}  // namespace

Verb AddEncode(CLI::App& program) {
  auto flags = std::make_shared<EncodeFlags>();
  CLI::App* verb = program.add_subcommand("encode", kDescription);
  verb->add_option("SCAN", flags->input, "Mesh to read: PLY, OBJ, STL or OFF")->type_name("");
  verb->add_option("-o,--output", flags->output, "File to write")->type_name("F.folp");
  verb->add_flag("-f,--force", flags->force, "May replace the output");
  verb->add_option("--config", flags->config, "Settings to start from; flags win")
      ->type_name("C.toml");
  CLI::Option* bits = verb->add_option("--bits", flags->bits,
                                       "Lattice of 2^N - 1 steps along the longest side; 1 .. 24")
                          ->check(CLI::Range(1, 24))
                          ->type_name("N");
  CLI::Option* tolerance = AddPositiveOption(verb, "--tolerance", &flags->tolerance, "LENGTH",
                                             "Largest error per axis, in model units");
  tolerance->excludes(bits);
  verb->add_flag("--exact", flags->exact, "Positions come back bit for bit, NaN and all")
      ->excludes(bits)
      ->excludes(tolerance);
  verb->add_flag(
      "--no-attributes", flags->no_attributes,
      "Without colours, normals and what else vertices and faces have, and without comments");
  verb->add_option("--attribute-bits", flags->attribute_bits,
                   "Rounds a float attribute to 2^N values over its range, normal=10; may be given "
                   "again")
      ->allow_extra_args(false)
      ->type_name("NAME=N");
  verb->add_flag("--keep-order", flags->keep_order,
                 "Vertices and faces come back in the scan's order");
  verb->add_flag("--weld", flags->weld,
                 "Vertices of equal coordinates become one: a surface of the soup that an STL is");
  verb->add_option("--effort", flags->effort,
                   "1 fastest .. 9 smallest file; wins over the settings, other flags over it")
      ->check(CLI::Range(1, 9))
      ->type_name("N");
  AddCountOption(verb, "--subtree-vertices", &flags->subtree_vertices,
                 "Largest subtree in vertices, 20k");
  verb->add_flag("--estimate", flags->estimate,
                 "Print time, memory, temporary disk and output it will take, and stop");
  verb->add_flag("--restart", flags->restart,
                 "Begin anew where an interrupted encoding could go on");
  verb->add_flag("--print-config", flags->print_config,
                 "Print the settings in force as a config file, and stop");
  AddWorkFlags(verb, &flags->work);
  AddLimitFlag(verb, &flags->limits);
  AddCommonFlags(verb, &flags->common);
  AddProgressFlag(verb, &flags->common);
  AddRunnerFlag(verb, &flags->work);
  return {verb, [flags] { return Run(*flags); }};
}

}  // namespace folprom::cli
