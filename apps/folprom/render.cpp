#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "apps/folprom/limit_flags.h"
#include "apps/folprom/lod_flags.h"
#include "apps/folprom/options.h"
#include "apps/folprom/rd_curve.h"
#include "apps/folprom/report.h"
#include "apps/folprom/session.h"
#include "apps/folprom/verbs.h"
#include "apps/render/picture.h"
#include "apps/render/png_code.h"
#include "apps/render/sheet.h"
#include "engine/measure/triangle_mesh.h"
#include "io/files/atomic_file.h"

namespace folprom::cli {
namespace {

constexpr const char* kDescription =
    "Draw a mesh, or levels of detail of a file, as a PNG picture\n"
    "\n"
    "  folprom render scan.ply -o scan.png\n"
    "  folprom render scan.folp -o coarse.png --bpv 1 --wireframe\n"
    "  folprom render scan.folp -o left.png --azimuth -70 --elevation 10 --up z\n"
    "  folprom render scan.folp -o lods.png --sheet\n"
    "  folprom render scan.folp -o lods.png --sheet --rates 0.5,1,2,4\n"
    "\n"
    "All levels of detail and the scan share one view. A mesh without faces is drawn as points.\n"
    "The mesh is held in memory, 36 bytes a vertex and 60 a face (a mesh without faces, 132 a\n"
    "vertex), and refused where that is more than -M allows, 2 GiB unless told.";

// Pixels of an edge of a picture.
constexpr uint32_t kSmallest = 16, kLargest = 8192;
constexpr size_t kMostRates = 11;

struct RenderFlags {
  CommonFlags common;
  WorkFlags work;
  LimitFlags limits;
  LodFlags lod;
  std::string input;
  std::string output;
  std::optional<std::string> size;
  std::string up;
  bool sheet = false;
  std::optional<std::string> rates;
  render::View view;
  render::Style style;
  bool force = false;
};

struct Size {
  uint32_t width = 0, height = 0;
};

// "1280x960"
Size ParseSize(const std::string& text) {
  const char* const end = text.data() + text.size();
  Size size;
  const auto width = std::from_chars(text.data(), end, size.width);
  bool good = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  if (good) {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    good = height.ec == std::errc() && height.ptr == end;
  }
  for (const uint32_t edge : {size.width, size.height}) {
    good = good && edge >= kSmallest && edge <= kLargest;
  }
  if (good) return size;
  throw Failure(ErrorKind::kUsage,
                fmt::format("--size: '{}' is not a size such as 1280x960, {} .. {} pixels each way",
                            text, kSmallest, kLargest));
}

std::vector<double> Rates(const RenderFlags& flags) {
  if (!flags.rates) return {};
  std::vector<double> rates = ParseRates(*flags.rates, "--rates");
  if (rates.size() <= kMostRates) return rates;
  throw Failure(ErrorKind::kUsage, fmt::format("--rates: {} rates; at most {} find room on a sheet",
                                               rates.size(), kMostRates));
}

render::PictureOptions Settings(const RenderFlags& flags) {
  render::PictureOptions options;
  if (flags.sheet) {
    options.width = 420;
    options.height = 360;
  }
  if (flags.size) {
    const Size size = ParseSize(*flags.size);
    options.width = size.width;
    options.height = size.height;
  }
  options.view = flags.view;
  if (!flags.up.empty()) options.view.up = static_cast<size_t>(flags.up.front() - 'x');
  options.style = flags.style;
  flags.lod.ApplyTo(&options.decode);
  flags.limits.ApplyTo(&options.decode.limits);
  options.decode.limits.memory_bytes =
      flags.work.memory.value_or(options.decode.limits.memory_bytes);
  options.decode.temporary_folder = flags.work.temporary_folder.value_or("");
  return options;
}

void CheckInput(const RenderFlags& flags) {
  const bool folp = measure::IsFolp(flags.input);
  if (folp || !(flags.lod.any() || flags.sheet)) return;
  throw Failure(ErrorKind::kUsage, flags.input +
                                       ": is no .folp file, so it has no levels of detail for "
                                       "--sheet, --bpv, --layers, --max-vertices or --max-error");
}

struct Outcome {
  render::Image image;
  uint64_t vertices = 0, faces = 0;         ///< of the finest mesh
  std::vector<render::SheetEntry> entries;  ///< of a sheet
  std::vector<std::string> warnings;
};

Outcome DrawOutcome(const RenderFlags& flags, const render::PictureOptions& options,
                    const std::vector<double>& rates, parallel::Runner& runner,
                    parallel::Progress& progress) {
  if (flags.sheet) {
    render::Sheet sheet = render::DrawSheet(flags.input, options, rates, runner, progress);
    const render::SheetEntry& finest = sheet.entries.back();
    return {std::move(sheet.image), finest.vertices, finest.faces, sheet.entries, sheet.warnings};
  }
  render::Picture picture = render::Draw(flags.input, options, runner, progress);
  return {std::move(picture.image), picture.vertices, picture.faces, {}, picture.warnings};
}

Json EntriesJson(const std::vector<render::SheetEntry>& entries) {
  Json list = Json::array();
  for (const render::SheetEntry& entry : entries) {
    list.push_back({{"layers", entry.layers},
                    {"vertices", entry.vertices},
                    {"faces", entry.faces},
                    {"bytes", entry.bytes},
                    {"bits_per_vertex", entry.bits_per_vertex}});
  }
  return list;
}

void PrintReport(const RenderFlags& flags, const Outcome& outcome, double seconds) {
  if (flags.common.json) {
    Json json = {{"output", flags.output},
                 {"width", outcome.image.width()},
                 {"height", outcome.image.height()},
                 {"vertices", outcome.vertices},
                 {"faces", outcome.faces}};
    if (flags.sheet) json["pictures"] = EntriesJson(outcome.entries);
    json.update({{"warnings", outcome.warnings},
                 {"seconds", seconds},
                 {"peak_rss_bytes", PeakResidentBytes()}});
    PrintJson(json);
  } else if (!flags.common.quiet) {
    Print(fmt::format("{}: {} x {} pixels, {} vertices, {} faces{}; {:.1f} s, {} memory\n",
                      flags.output, outcome.image.width(), outcome.image.height(),
                      Grouped(outcome.vertices), Grouped(outcome.faces),
                      flags.sheet ? fmt::format(", {} pictures", outcome.entries.size()) : "",
                      seconds, BytesShort(PeakResidentBytes())));
  }
}

int Run(const RenderFlags& flags) {
  const render::PictureOptions options = Settings(flags);
  const std::vector<double> rates = Rates(flags);
  CheckOutput(flags.input, flags.output, flags.force);
  CheckInput(flags);
  const auto runner = MakeRunner(flags.work, flags.work.threads.value_or(0));
  Session session(flags.common);
  // First of all: where nothing can be written, nothing need be drawn.
  const auto file = std::move(io::AtomicFile::Create(flags.output, flags.force).value());
  const Outcome outcome = DrawOutcome(flags, options, rates, *runner, session.progress());
  file->Append(render::PngOf(outcome.image)).value();
  file->Commit().value();
  session.StopDisplay();
  LogWarnings(outcome.warnings);
  PrintReport(flags, outcome, session.seconds());
  return 0;
}

// An option of degrees from -limit to limit.
void AddDegrees(CLI::App* verb, const std::string& name, double limit,
                const std::function<void(double)>& take, const std::string& help) {
  verb->add_option_function<double>(
          name,
          [name, limit, take](const double& degrees) {
            // A NaN is in no range.
            if (!(std::abs(degrees) <= limit)) {
              throw Failure(ErrorKind::kUsage, fmt::format("{}: {} is not in -{} .. {} degrees",
                                                           name, degrees, limit, limit));
            }
            take(degrees);
          },
          help)
      ->type_name("DEG");
}

void AddViewFlags(CLI::App* verb, RenderFlags* flags) {
  verb->add_option("--size", flags->size,
                   "Pixels; else 1280x960, of each picture of a sheet 420x360")
      ->type_name("WxH");
  AddDegrees(
      verb, "--azimuth", 360, [flags](double degrees) { flags->view.azimuth = degrees; },
      "Around the up axis: 0 from the front, 90 from the right; else -30");
  AddDegrees(
      verb, "--elevation", 90, [flags](double degrees) { flags->view.elevation = degrees; },
      "Above the horizon, -90 .. 90; else 20, of flat land 45");
  verb->add_option("--up", flags->up, "Axis x, y or z that points up; else y, of flat land z")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->type_name("AXIS");
  verb->add_flag("--wireframe", flags->style.wireframe, "Draw the edges of the faces too");
  verb->add_flag("--transparent", flags->style.transparent, "No background, instead of white");
}

void AddSheetFlags(CLI::App* verb, RenderFlags* flags) {
  const std::vector<CLI::Option*> bounds = AddLodFlags(verb, &flags->lod);
  CLI::Option* sheet = verb->add_flag(
      "--sheet", flags->sheet, "Several levels of detail beside the finest, with their figures");
  for (CLI::Option* bound : bounds) sheet->excludes(bound);
  verb->add_option("--rates", flags->rates,
                   "Of the sheet, in bits per vertex of the original; else five that spread evenly")
      ->type_name("R,R,...")
      ->needs(sheet);
}

}  // namespace

Verb AddRender(CLI::App& program) {
  auto flags = std::make_shared<RenderFlags>();
  CLI::App* verb = program.add_subcommand("render", kDescription);
  verb->add_option("FILE", flags->input, "Scan or .folp file to draw")->type_name("")->required();
  verb->add_option("-o,--output", flags->output, "Picture to write")
      ->type_name("OUT.png")
      ->required();
  verb->add_flag("-f,--force", flags->force, "May replace the output");
  AddSheetFlags(verb, flags.get());
  AddViewFlags(verb, flags.get());
  AddWorkFlags(verb, &flags->work);
  AddLimitFlag(verb, &flags->limits);
  AddCommonFlags(verb, &flags->common);
  AddProgressFlag(verb, &flags->common);
  AddRunnerFlag(verb, &flags->work);
  return {verb, [flags] { return Run(*flags); }};
}

}  // namespace folprom::cli
