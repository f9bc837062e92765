#include "apps/batch/plan_checks.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <string_view>

#include "apps/batch/glob.h"
#include "apps/batch/plan.h"

namespace folprom::batch {
namespace {

namespace fs = std::filesystem;

std::string Quoted(const std::string& text) { return "\"" + text + "\""; }

// The patterns of all jobs, to see whether an output would be taken for a scan.
class InputPatterns {
 public:
  explicit InputPatterns(const Plan& plan) : plan_(plan) {
    for (const Job& job : plan.file.jobs) {
      Patterns patterns;
      for (const std::string& text : job.input)
        patterns.input.emplace_back(plan.file.Resolve(text));
      for (const std::string& text : job.exclude) {
        patterns.exclude.emplace_back(plan.file.Resolve(text));
      }
      jobs_.push_back(patterns);
    }
    for (const Scan& scan : plan.scans) inputs_.try_emplace(scan.input, &scan);
  }

  // `by` makes the output.
  void Check(const std::string& output, const Job& by, bool decoded) const {
    if (inputs_.contains(output)) {
      by.Fail(ErrorKind::kUsage, "output",
              output + " would be written, but is an input" +
                  (decoded ? ": a circular decode; the scan would be replaced by its own decoding"
                           : "") +
                  "; choose another output folder or pattern");
    }
    for (size_t j = 0; j < jobs_.size(); ++j) {
      if (!jobs_[j].Match(output)) continue;
      const Job& taker = plan_.file.jobs[j];
      by.Fail(ErrorKind::kUsage, "output",
              "the next run would take the output " + output + " for a scan of " +
                  (&taker == &by ? "this job" : "job " + Quoted(taker.name)) +
                  "; exclude it, or choose an output folder that input does not match");
    }
  }

 private:
  struct Patterns {
    std::vector<Glob> input, exclude;
    bool Match(const std::string& path) const {
      const auto matches = [&](const Glob& glob) { return glob.Matches(path); };
      return std::any_of(input.begin(), input.end(), matches) &&
             std::none_of(exclude.begin(), exclude.end(), matches);
    }
  };

  const Plan& plan_;
  std::vector<Patterns> jobs_;
  std::map<std::string, const Scan*> inputs_;
};

[[noreturn]] void FailOnSameOutput(const Plan& plan, const std::string& output, const Task& first,
                                   const Task& second) {
  const Job& job = plan.JobOf(second);
  const Scan& first_scan = plan.scans[first.scan];
  const Scan& second_scan = plan.scans[second.scan];
  if (first.scan == second.scan) {
    job.Fail(ErrorKind::kUsage, "lods",
             "two entries of lods write " + output + "; give one of them a name of its own");
  }
  std::string advice = "choose another output folder for one of the jobs";
  for (const char* pattern :
       {"{name}", "{folder}/{stem}", "{job}/{stem}", "{folder}/{name}", "{job}/{folder}/{name}"}) {
    if (plan.StemOf(first_scan, pattern) == plan.StemOf(second_scan, pattern)) continue;
    advice = "pattern = " + Quoted(pattern) + " keeps them apart";
    break;
  }
  job.Fail(ErrorKind::kUsage, "pattern",
           first_scan.input + " and " + second_scan.input + " would both be written to " + output +
               "; " + advice);
}

void CheckExisting(const Plan& plan, const Task& task, const std::string& output) {
  const Job& job = plan.JobOf(task);
  std::error_code ignored;
  if (!fs::exists(output, ignored) || job.existing == "overwrite") return;
  if (job.existing == "fail") {
    job.Fail(ErrorKind::kOutput, "existing",
             output +
                 " exists already, and existing = \"fail\"; existing = \"skip\" leaves what is "
                 "up to date");
  }
  const Ledger& ledger = plan.ledgers.at(plan.OutputFolder(job));
  if (!ledger.Knows(task.key)) {
    job.Fail(ErrorKind::kOutput, "existing",
             output +
                 " exists already and was not made by a batch; remove it, choose another "
                 "output folder, or replace it with existing = \"overwrite\"");
  }
}

}  // namespace

void CheckFolder(const Job& job, const std::string& folder) {
  fs::path nearest = folder;
  std::error_code error;
  while (!fs::exists(nearest, error) && nearest.has_relative_path())
    nearest = nearest.parent_path();
  if (!fs::is_directory(nearest, error)) {
    job.Fail(ErrorKind::kOutput, "output", nearest.string() + " is not a folder");
  }
  if (::access(nearest.c_str(), W_OK | X_OK) != 0) {
    job.Fail(ErrorKind::kOutput, "output",
             nearest.string() + " cannot be written to: " + std::strerror(errno));
  }
}

void CheckOutputs(const Plan& plan) {
  const InputPatterns patterns(plan);
  std::map<std::string, const Task*> writers;
  for (const Task& task : plan.tasks) {
    for (const std::string& output : task.outputs) {
      const auto [writer, is_new] = writers.try_emplace(output, &task);
      if (!is_new) FailOnSameOutput(plan, output, *writer->second, task);
      patterns.Check(output, plan.JobOf(task), task.operation == Operation::kDecode);
    }
  }
  for (const char* name : {"/report.json", "/report.jsonl", "/report.html"}) {
    patterns.Check(plan.file.report + name, plan.file.jobs.front(), false);
  }
  for (const Task& task : plan.tasks) {
    for (const std::string& output : task.outputs) CheckExisting(plan, task, output);
  }
}

}  // namespace folprom::batch
