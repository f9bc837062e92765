#include "apps/batch/plan.h"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>
#include <utility>

#include "apps/batch/glob.h"
#include "apps/batch/job_keys.h"
#include "apps/batch/name_pattern.h"
#include "apps/batch/plan_checks.h"
#include "apps/folprom/rd_curve.h"
#include "io/container/file_table.h"

namespace folprom::batch {
namespace {

namespace fs = std::filesystem;

std::string HashOfText(const std::string& text) {
  return fmt::format("{:016x}", XXH3_64bits(text.data(), text.size()));
}

// All settings of the coder, by name; not those that never alter a file.
std::string CodecText(const Job& job) {
  Job copy = job;
  std::string text;
  for (const cli::Key& key : cli::EncodeKeys(copy.encode)) {
    const bool alters = key.table == "codec" || key.name == "bits" || key.name == "tolerance" ||
                        key.name == "exact" || key.name == "attributes" ||
                        key.name == "attribute_bits" || key.name == "keep_order" ||
                        key.name == "weld";
    if (alters) text += std::string(key.name) + "=" + ValueText(key) + ";";
  }
  return text;
}

std::string RatesText(const Job& job) {
  return fmt::format("{};{}", fmt::join(job.rates, ","), job.samples);
}

class Planner {
 public:
  explicit Planner(JobFile file) { plan_.file = std::move(file); }

  Plan Make() {
    for (size_t j = 0; j < plan_.file.jobs.size(); ++j) FindScans(j);
    for (const Job& job : plan_.file.jobs) {
      const std::string folder = plan_.OutputFolder(job);
      CheckFolder(job, folder);
      plan_.ledgers.try_emplace(folder, folder);
    }
    CheckOutputs(plan_);
    for (const auto& [folder, ledger] : plan_.ledgers) ledger.RememberHashes(&plan_.hashes);
    return std::move(plan_);
  }

 private:
  void FindScans(size_t job_index) {
    const Job& job = plan_.file.jobs[job_index];
    std::vector<Glob> excluded;
    for (const std::string& pattern : job.exclude) {
      excluded.emplace_back(plan_.file.Resolve(pattern));
    }
    std::vector<Glob> globs;
    for (const std::string& pattern : job.input) globs.emplace_back(plan_.file.Resolve(pattern));
    const fs::path root = CommonRoot(globs);
    const size_t before = plan_.scans.size();
    std::set<std::string> found;
    for (size_t i = 0; i < globs.size(); ++i) {
      for (const std::string& file : FilesOf(job, job.input[i], globs[i])) {
        const bool excludes = std::any_of(excluded.begin(), excluded.end(),
                                          [&](const Glob& other) { return other.Matches(file); });
        if (!excludes && found.insert(file).second) AddScan(job_index, root, file);
      }
    }
    if (plan_.scans.size() == before) {
      job.Fail(ErrorKind::kInput, "exclude", "exclude leaves no scan of those that input names");
    }
  }

  // The folders that all of them begin with.
  static fs::path CommonRoot(const std::vector<Glob>& globs) {
    fs::path root = globs.front().root();
    for (const Glob& glob : globs) {
      const auto [end, ignored] =
          std::mismatch(root.begin(), root.end(), glob.root().begin(), glob.root().end());
      fs::path common;
      for (auto name = root.begin(); name != end; ++name) common /= *name;
      root = common;
    }
    return root;
  }

  static std::vector<std::string> FilesOf(const Job& job, const std::string& pattern,
                                          const Glob& glob) {
    std::vector<std::string> files = glob.Files();
    if (!files.empty()) return files;
    const std::string below = glob.root().string();
    if (!glob.has_wildcard()) {
      job.Fail(ErrorKind::kInput, "input", "input \"" + pattern + "\" is not a file in " + below);
    }
    const bool exists = fs::is_directory(glob.root());
    job.Fail(ErrorKind::kInput, "input",
             "input \"" + pattern + "\" matches no file; " + below +
                 (exists ? " holds none such" : " does not exist"));
  }

  void AddScan(size_t job_index, const fs::path& root, const std::string& file) {
    const Job& job = plan_.file.jobs[job_index];
    Scan scan;
    scan.job = job_index;
    scan.input = file;
    scan.name = fs::path(file).lexically_relative(root).string();
    if (const auto stamp = StampOf(file)) scan.bytes = stamp->size;
    const std::string stem = plan_.StemOf(scan, job.pattern);
    if (job.Does(Operation::kEncode)) scan.folp = stem + ".folp";
    if (job.from_folp()) scan.folp = file;
    plan_.scans.push_back(scan);
    AddTasks(job, stem);
  }

  void AddTasks(const Job& job, const std::string& stem) {
    const Scan& scan = plan_.scans.back();
    if (job.Does(Operation::kEncode)) {
      Add(Operation::kEncode, {scan.input}, {scan.folp}, CodecText(job));
    }
    if (job.Does(Operation::kVerify)) {
      std::vector<std::string> inputs = {scan.folp};
      if (!job.from_folp()) inputs.push_back(scan.input);
      Add(Operation::kVerify, inputs, {}, "");
    }
    if (job.Does(Operation::kDecode)) {
      const std::vector<Lod> lods = job.lods.empty() ? std::vector<Lod>(1) : job.lods;
      for (const Lod& lod : lods) {
        Add(Operation::kDecode, {scan.folp}, {stem + lod.Suffix()}, lod.Text());
        plan_.tasks.back().lod = lod;
      }
    }
    if (job.Does(Operation::kRd)) {
      std::vector<std::string> outputs;
      for (const char* suffix : cli::kCurveSuffixes) outputs.push_back(stem + ".rd" + suffix);
      Add(Operation::kRd, {scan.input}, outputs, CodecText(job) + RatesText(job));
    }
  }

  void Add(Operation operation, std::vector<std::string> inputs, std::vector<std::string> outputs,
           const std::string& settings) {
    Scan& scan = plan_.scans.back();
    const Job& job = plan_.file.jobs[scan.job];
    Task task;
    task.operation = operation;
    task.scan = plan_.scans.size() - 1;
    task.inputs = std::move(inputs);
    task.outputs = std::move(outputs);
    const std::string& named = task.outputs.empty() ? scan.folp : task.outputs.front();
    task.key = std::string(NameOf(operation)) + " " +
               fs::path(named).lexically_relative(plan_.OutputFolder(job)).string();
    task.settings = HashOfText(settings);
    scan.tasks.push_back(plan_.tasks.size());
    plan_.tasks.push_back(std::move(task));
  }

  Plan plan_;
};

}  // namespace

std::string Plan::OutputFolder(const Job& job) const {
  const fs::path folder = file.Resolve(job.output);
  std::error_code unknown;
  const fs::path canonical = fs::weakly_canonical(folder, unknown);
  const std::string name = (unknown ? folder : canonical).string();
  return name.size() > 1 && name.ends_with('/') ? name.substr(0, name.size() - 1) : name;
}

std::string Plan::StemOf(const Scan& scan, const std::string& pattern) const {
  const Job& job = file.jobs[scan.job];
  const fs::path name = scan.name;
  return OutputFolder(job) + "/" +
         ExpandPattern(pattern, {name.stem().string(), name.filename().string(),
                                 name.parent_path().string(), job.name});
}

OperationResult Plan::ResultOf(const Task& task) const {
  const Scan& scan = scans[task.scan];
  const Job& job = JobOf(task);
  OperationResult result;
  result.job = job.name;
  result.scan = scan.name;
  result.operation = task.operation;
  result.input = scan.input;
  result.folp = scan.folp;
  if (!task.outputs.empty()) result.output = task.outputs.front();
  if (!job.from_folp()) result.settings = job.SettingsText();
  if (task.operation == Operation::kDecode) result.lod = task.lod.Text();
  return result;
}

Plan MakePlan(JobFile file) { return Planner(std::move(file)).Make(); }

void OpenOutputs(Plan* plan) {
  std::set<fs::path> folders = {plan->file.report};
  for (const auto& [folder, ledger] : plan->ledgers) folders.insert(folder);
  for (const Task& task : plan->tasks) {
    for (const std::string& output : task.outputs) folders.insert(fs::path(output).parent_path());
  }
  for (const fs::path& folder : folders) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw Failure(ErrorKind::kOutput, folder.string() + ": " + error.message());
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
      io::ThrowSystemError(ErrorKind::kOutput, folder.string(), "cannot be written to");
    }
  }
  for (auto& [folder, ledger] : plan->ledgers) ledger.Open();
}

std::string VersionText() {
  return fmt::format("folprom " FOLPROM_VERSION ", format {}", io::kFormatVersion);
}

}  // namespace folprom::batch
