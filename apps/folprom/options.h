// Flags that several verbs share, and how their texts are read.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "folprom/result.h"
#include "parallel/runner.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace folprom::cli {

/// A number of bytes: "512MiB", "2GiB", "2G" (powers of 1024), "2GB" (of 1000), "1e9".
Result<uint64_t> ParseBytes(std::string_view text);
/// A number of things: "20k", "10M", "1G" (powers of 1000), "1e6".
Result<uint64_t> ParseCount(std::string_view text);
/// "x0,y0,z0,x1,y1,z1" with x0 <= x1 and so on.
Result<std::array<double, 6>> ParseRegion(std::string_view text);
/// Writes bytes so that ParseBytes reads the same number: "2GiB", or the plain number.
std::string BytesText(uint64_t bytes);

struct CommonFlags {
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool progress_json = false;  ///< progress as JSON lines on standard error
};

struct WorkFlags {
  std::optional<uint32_t> threads;
  std::optional<uint64_t> memory;
  std::optional<std::string> temporary_folder;
  std::string runner = "tbb";  ///< tbb, serial, shuffled:SEED
};

/// --json -q -v
void AddCommonFlags(CLI::App* verb, CommonFlags* flags);
/// --progress, for verbs that work for a while.
void AddProgressFlag(CLI::App* verb, CommonFlags* flags);
/// -T --tmp, for verbs that hold whole meshes and so keep no memory limit.
void AddThreadFlags(CLI::App* verb, WorkFlags* flags);
/// -T --tmp -M
void AddWorkFlags(CLI::App* verb, WorkFlags* flags);
/// --runner, which only tests need.
void AddRunnerFlag(CLI::App* verb, WorkFlags* flags);
/// Options whose text is a size, a count or a number above 0.
CLI::Option* AddBytesOption(CLI::App* verb, const std::string& name, std::optional<uint64_t>* value,
                            const std::string& help);
CLI::Option* AddCountOption(CLI::App* verb, const std::string& name, std::optional<uint64_t>* value,
                            const std::string& help);
CLI::Option* AddPositiveOption(CLI::App* verb, const std::string& name,
                               std::optional<double>* value, const std::string& type,
                               const std::string& help);

/// The runner that --runner names; kUsage for an unknown name.
std::unique_ptr<parallel::Runner> MakeRunner(const WorkFlags& flags, uint32_t threads);

/// Failure where the output stands already and may not be replaced (kOutput), or is the input
/// itself (kUsage), before any work is done.
void CheckOutput(const std::string& input, const std::string& output, bool force);

}  // namespace folprom::cli
