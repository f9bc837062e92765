#include "apps/folprom/options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace folprom::cli {
namespace {

struct Suffix {
  std::string_view text;  // lower case
  double factor;
};

constexpr double kKi = 1024;
constexpr Suffix kByteSuffixes[] = {{"", 1},
                                    {"b", 1},
                                    {"k", kKi},
                                    {"kib", kKi},
                                    {"m", kKi* kKi},
                                    {"mib", kKi* kKi},
                                    {"g", kKi* kKi* kKi},
                                    {"gib", kKi* kKi* kKi},
                                    {"t", kKi* kKi* kKi* kKi},
                                    {"tib", kKi* kKi* kKi* kKi},
                                    {"kb", 1e3},
                                    {"mb", 1e6},
                                    {"gb", 1e9},
                                    {"tb", 1e12}};
constexpr Suffix kCountSuffixes[] = {{"", 1}, {"k", 1e3}, {"m", 1e6}, {"g", 1e9}};

// Reads one number from the front of *text and cuts it off.
std::optional<double> TakeNumber(std::string_view* text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text->remove_prefix(static_cast<size_t>(end - text->data()));
  return value;
}

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

template <size_t N>
std::optional<uint64_t> ParseScaled(std::string_view text, const Suffix (&suffixes)[N]) {
  const std::optional<double> number = TakeNumber(&text);
  if (!number) return std::nullopt;
  const std::string unit = LowerCase(text);
  for (const Suffix& suffix : suffixes) {
    if (suffix.text != unit) continue;
    const double value = *number * suffix.factor;
    // 2^53: larger numbers would not be exact.
    if (value < 0 || value > 9007199254740992.0 || value != std::floor(value)) return std::nullopt;
    return static_cast<uint64_t>(value);
  }
  return std::nullopt;
}

Error Usage(std::string message) { return {ErrorKind::kUsage, std::move(message)}; }

template <class T>
T OfOption(const std::string& name, Result<T> parsed) {
  if (parsed) return std::move(parsed).value();
  throw Failure(ErrorKind::kUsage, name + ": " + parsed.error().message);
}

// "-M,--memory" -> "--memory"
std::string LongName(const std::string& names) {
  const size_t comma = names.rfind(',');
  return comma == std::string::npos ? names : names.substr(comma + 1);
}

}  // namespace

Result<uint64_t> ParseBytes(std::string_view text) {
  if (const auto value = ParseScaled(text, kByteSuffixes)) return *value;
  return Usage("'" + std::string(text) + "' is not a size; write for example 512MiB, 2G or 1e9");
}

Result<uint64_t> ParseCount(std::string_view text) {
  if (const auto value = ParseScaled(text, kCountSuffixes)) return *value;
  return Usage("'" + std::string(text) + "' is not a count; write for example 20k, 10M or 1e6");
}

Result<std::array<double, 6>> ParseRegion(std::string_view text) {
  const Error error =
      Usage("'" + std::string(text) + "' is not a box; write x0,y0,z0,x1,y1,z1 with x0 <= x1, ...");
  std::array<double, 6> box{};
  for (size_t i = 0; i < box.size(); ++i) {
    const auto number = TakeNumber(&text);
    if (!number) return error;
    box[i] = *number;
    const std::string_view separator = i + 1 < box.size() ? "," : "";
    if (text.substr(0, 1) != separator) return error;
    if (!text.empty()) text.remove_prefix(1);
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    if (box[axis] > box[axis + 3]) return error;
  }
  return box;
}

std::string BytesText(uint64_t bytes) {
  static constexpr const char* kUnits[] = {"TiB", "GiB", "MiB", "KiB"};
  int shift = 40;
  for (const char* unit : kUnits) {
    if (bytes != 0 && bytes % (uint64_t{1} << shift) == 0) {
      return std::to_string(bytes >> shift) + unit;
    }
    shift -= 10;
  }
  return std::to_string(bytes);
}

void AddCommonFlags(CLI::App* verb, CommonFlags* flags) {
  verb->add_flag("--json", flags->json, "Print one JSON object on standard output");
  CLI::Option* quiet = verb->add_flag("-q,--quiet", flags->quiet, "No progress, no summary");
  verb->add_flag("-v,--verbose", flags->verbose, "Say more on standard error")->excludes(quiet);
}

void AddProgressFlag(CLI::App* verb, CommonFlags* flags) {
  verb->add_option_function<std::string>(
          "--progress", [flags](const std::string& mode) { flags->progress_json = mode == "json"; },
          "text, or json: one object a line on standard error, also with -q and --json")
      ->check(CLI::IsMember({"text", "json"}))
      ->type_name("MODE");
}

CLI::Option* AddBytesOption(CLI::App* verb, const std::string& name, std::optional<uint64_t>* value,
                            const std::string& help) {
  return verb
      ->add_option_function<std::string>(
          name,
          [name, value](const std::string& text) {
            *value = OfOption(LongName(name), ParseBytes(text));
          },
          help)
      ->type_name("SIZE");
}

CLI::Option* AddCountOption(CLI::App* verb, const std::string& name, std::optional<uint64_t>* value,
                            const std::string& help) {
  return verb
      ->add_option_function<std::string>(
          name,
          [name, value](const std::string& text) {
            const uint64_t count = OfOption(LongName(name), ParseCount(text));
            if (count == 0) throw Failure(ErrorKind::kUsage, LongName(name) + ": must be above 0");
            *value = count;
          },
          help)
      ->type_name("N");
}

CLI::Option* AddPositiveOption(CLI::App* verb, const std::string& name,
                               std::optional<double>* value, const std::string& type,
                               const std::string& help) {
  return verb
      ->add_option_function<std::string>(
          name,
          [name, value](const std::string& text) {
            std::string_view rest = text;
            const auto number = TakeNumber(&rest);
            if (!number || !rest.empty() || !(*number > 0)) {
              throw Failure(ErrorKind::kUsage,
                            LongName(name) + ": '" + text + "' is not a number above 0");
            }
            *value = *number;
          },
          help)
      ->type_name(type);
}

void AddThreadFlags(CLI::App* verb, WorkFlags* flags) {
  verb->add_option("-T,--threads", flags->threads, "Threads; 0 (the default) for all")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  verb->add_option("--tmp", flags->temporary_folder,
                   "Folder for temporary files; else $TMPDIR or /tmp")
      ->type_name("DIR");
}

void AddWorkFlags(CLI::App* verb, WorkFlags* flags) {
  AddThreadFlags(verb, flags);
  AddBytesOption(verb, "-M,--memory", &flags->memory,
                 "Resident size to stay below, 512MiB or 2G; never alters the result");
}

void AddRunnerFlag(CLI::App* verb, WorkFlags* flags) {
  verb->add_option("--runner", flags->runner,
                   "Order of tasks: tbb, serial or shuffled:SEED; the result is the same")
      ->type_name("NAME")
      ->group("For tests");
}

std::unique_ptr<parallel::Runner> MakeRunner(const WorkFlags& flags, uint32_t threads) {
  if (flags.runner == "tbb") return parallel::MakeTbbRunner(static_cast<int>(threads));
  if (flags.runner == "serial") return parallel::MakeSerialRunner();
  constexpr std::string_view kShuffled = "shuffled:";
  if (flags.runner.starts_with(kShuffled)) {
    const char* const begin = flags.runner.data() + kShuffled.size();
    const char* const end = flags.runner.data() + flags.runner.size();
    uint64_t seed = 0;
    const auto parsed = std::from_chars(begin, end, seed);
    if (parsed.ec == std::errc() && parsed.ptr == end) return parallel::MakeShuffledRunner(seed);
  }
  throw Failure(ErrorKind::kUsage,
                "--runner: '" + flags.runner + "' is not tbb, serial or shuffled:SEED");
}

void CheckOutput(const std::string& input, const std::string& output, bool force) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (!input.empty() && fs::equivalent(input, output, ignored)) {
    throw Failure(ErrorKind::kUsage, output + ": is the input; choose another output");
  }
  if (!force && fs::exists(output, ignored)) {
    throw Failure(ErrorKind::kOutput, output + ": exists already; -f replaces it");
  }
}

}  // namespace folprom::cli
