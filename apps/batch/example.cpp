#include "apps/batch/example.h"

#include <spdlog/fmt/fmt.h>

#include "apps/batch/job_keys.h"
#include "apps/folprom/rd_curve.h"

namespace folprom::batch {
namespace {

constexpr const char* kHead =
    "# A job file of `folprom batch`. Made by `folprom batch --print-example`; a test keeps it "
    "so.\n"
    "# A key that begins with # stands at its default; take the # away to set it. Paths are "
    "relative\n"
    "# to this file.\n";

constexpr const char* kJobs =
    "\n# Each [[job]] has these two keys and any of [defaults], which here win over those there; "
    "but\n"
    "# threads, memory, tmp and report are of the whole batch.\n"
    "\n[[job]]\n";

constexpr const char* kFirstJob =
    "output = \"encoded\"\n"
    "pattern = \"{folder}/{stem}\"\n"
    "operations = [\"encode\", \"verify\"]\n"
    "exact = true\n";

constexpr const char* kSecondJob =
    "\n[[job]]\n"
    "name = \"previews\"\n"
    "input = [\"scans/**/*.ply\"]\n"
    "output = \"previews\"\n"
    "pattern = \"{folder}/{stem}\"\n"
    "operations = [\"encode\", \"decode\"]\n"
    "bits = 11\n";

std::string CommentedOut(const cli::Key& key) {
  const std::string value = ValueText(key);
  return fmt::format("\n{}#{} = {}\n", CommentText(key, value), key.name, value);
}

std::string DefaultsText() {
  std::string text = "\n[defaults]\n";
  JobFile file;
  for (const cli::Key& key : BatchKeys(file)) text += CommentedOut(key);
  Job job;
  job.rates = cli::ParseRates(cli::kDefaultRates);
  for (const cli::Key& key : JobKeys(job, kDefaults)) {
    // Its entries have keys of their own, see the second job.
    if (key.name != "lods") text += CommentedOut(key);
  }
  return text;
}

std::string LodsText() {
  Lod lod;
  Job job;
  std::string text;
  for (const cli::Key& key : JobKeys(job, kJob)) {
    if (key.name == "lods") text += fmt::format("\n{}", CommentText(key, ""));
  }
  for (const cli::Key& key : LodKeys(lod)) {
    const std::string range = RangeText(key);
    text += fmt::format("#   {}: {}", key.name, key.meaning);
    if (!key.unit.empty()) text += fmt::format("; unit: {}", key.unit);
    if (!range.empty()) text += fmt::format("; range: {}", range);
    text += fmt::format("; default: {}\n", ValueText(key));
  }
  return text + "lods = [{ bpv = 2 }, { max_vertices = \"20k\", name = \"preview\" }, {}]\n";
}

}  // namespace

std::string ExampleText() {
  Job job;
  job.name = "originals";
  job.input = {"scans/**/*.ply"};
  std::string text = kHead + DefaultsText() + kJobs;
  for (const cli::Key& key : JobKeys(job, kJob)) {
    if (key.name != "name" && key.name != "input") continue;
    text += fmt::format("\n{}{} = {}\n", CommentText(key, ""), key.name, ValueText(key));
  }
  return text + "\n" + kFirstJob + kSecondJob + LodsText();
}

}  // namespace folprom::batch
