#include <fcntl.h>
#include <spdlog/fmt/chrono.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>
#include <thread>

#include "apps/batch/batch_display.h"
#include "apps/batch/batch_page.h"
#include "apps/batch/batch_report.h"
#include "apps/batch/example.h"
#include "apps/batch/job_file.h"
#include "apps/batch/plan.h"
#include "apps/batch/run.h"
#include "apps/batch/task.h"
#include "apps/folprom/options.h"
#include "apps/folprom/report.h"
#include "apps/folprom/session.h"
#include "apps/folprom/verbs.h"
#include "io/container/file_table.h"
#include "io/files/atomic_file.h"
#include "io/files/posix.h"

namespace folprom::cli {
namespace {

using batch::BatchReport;
using batch::Operation;
using batch::OperationResult;
using batch::Plan;
using batch::Status;

constexpr const char* kDescription =
    "Encode, decode and verify many scans by one job file\n"
    "\n"
    "  folprom batch --print-example > scans.toml\n"
    "  folprom batch scans.toml --dry-run\n"
    "  folprom batch scans.toml -T 16 -M 32GiB\n"
    "\n"
    "The example explains every key. The same command goes on where it was interrupted, and later\n"
    "does only what is missing or out of date.";

struct BatchFlags {
  CommonFlags common;
  WorkFlags work;
  std::string job_file;
  bool dry_run = false;
  bool print_example = false;
  bool no_pictures = false;
};

batch::JobFile ReadJobs(const BatchFlags& flags) {
  batch::JobFile file = batch::ReadJobFile(flags.job_file);
  if (flags.work.threads) file.threads = *flags.work.threads;
  if (file.threads == 0) file.threads = std::max(std::thread::hardware_concurrency(), 1U);
  if (flags.work.memory) file.memory_bytes = *flags.work.memory;
  if (file.memory_bytes == 0) throw Failure(ErrorKind::kUsage, "--memory must be 1 or more");
  if (flags.work.temporary_folder) {
    file.temporary_folder = *flags.work.temporary_folder;
  } else if (!file.temporary_folder.empty()) {
    file.temporary_folder = file.Resolve(file.temporary_folder).string();
  }
  return file;
}

std::string TextOf(const OperationResult& result) {
  const std::string& name = result.output.empty() ? result.folp : result.output;
  std::string text = fmt::format("{} {}", NameOf(result.operation), result.input);
  if (name != result.input) text += " -> " + name;
  return text;
}

// Tells of failures at once, and writes each result down.
class Reporter final : public batch::Observer {
 public:
  Reporter(const BatchFlags& flags, const std::string& folder)
      : path_(folder + "/report.jsonl"),
        display_(flags.common.progress_json                ? batch::DisplayMode::kJson
                 : flags.common.quiet || flags.common.json ? batch::DisplayMode::kNone
                                                           : batch::DisplayMode::kText) {
    lines_ = io::Descriptor(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (!lines_.open()) io::ThrowSystemError(ErrorKind::kOutput, path_, "cannot open");
  }

  void Ended(const OperationResult& result) override {
    const std::string line =
        ToJson(result).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    io::WriteAll(lines_.get(), {reinterpret_cast<const uint8_t*>(line.data()), line.size()}, path_);
    if (result.status == Status::kFailed) {
      display_.Clear();
      spdlog::error("{} {}: {}", NameOf(result.operation), result.scan, result.error);
    }
    for (const std::string& warning : result.warnings) {
      if (result.status != Status::kDone) break;
      display_.Clear();
      spdlog::warn("{}: {}", result.scan, warning);
    }
    if (result.status == Status::kDone || result.status == Status::kUpToDate) {
      spdlog::debug("{}: {}", TextOf(result), result.reason);
    }
  }
  void Tick(const batch::BatchReading& reading) override { display_.Show(reading); }
  void StopDisplay() { display_.Clear(); }

 private:
  std::string path_;
  io::Descriptor lines_;
  batch::BatchDisplay display_;
};

BatchReport ReportOf(const Plan& plan, std::vector<OperationResult> results, std::time_t started,
                     double seconds) {
  BatchReport report;
  report.program = "folprom " FOLPROM_VERSION;
  report.format_version = io::kFormatVersion;
  report.job_file = plan.file.path.string();
  report.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(started));
  report.seconds = seconds;
  report.threads = plan.file.threads;
  report.memory_bytes = plan.file.memory_bytes;
  report.scans = plan.scans.size();
  const batch::ScanCounts counts = CountScans(plan, results);
  report.scans_done = counts.done;
  report.scans_failed = counts.failed;
  for (const OperationResult& result : results) {
    // Not 0 where an operation failed, or was interrupted from outside.
    if (report.exit_code == 0) report.exit_code = result.exit_code;
  }
  report.results = std::move(results);
  return report;
}

std::string Summary(const BatchReport& report, const std::string& report_path) {
  uint64_t ran = 0, up_to_date = 0, failed = 0, not_run = 0, before = 0, after = 0;
  for (const OperationResult& result : report.results) {
    ran += result.status == Status::kDone;
    up_to_date += result.status == Status::kUpToDate;
    failed += result.status == Status::kFailed;
    not_run += result.status == Status::kNotRun || result.status == Status::kInterrupted;
    const bool encoded = result.status == Status::kDone || result.status == Status::kUpToDate;
    if (result.operation != Operation::kEncode || !encoded) continue;
    before += result.input_bytes;
    after += result.output_bytes;
  }
  std::string text = fmt::format("{} of {} scans done", report.scans_done, report.scans);
  if (report.scans_failed > 0) text += fmt::format(", {} failed", report.scans_failed);
  text += fmt::format("; operations: {} run, {} up to date", ran, up_to_date);
  if (failed > 0) text += fmt::format(", {} failed", failed);
  if (not_run > 0) text += fmt::format(", {} left", not_run);
  if (before > 0) {
    text += fmt::format("\n{} of scans in {}, {:.1f} %", BytesShort(before), BytesShort(after),
                        100 * static_cast<double>(after) / static_cast<double>(before));
  }
  return text + fmt::format("; {:.1f} s; {}\n", report.seconds, report_path);
}

void WriteReport(const BatchReport& report, const std::string& path) {
  const std::string text = ToJson(report).dump(2, ' ', false, Json::error_handler_t::replace);
  io::WriteWholeFile(path, text + "\n", true).value();
}

void WritePage(const BatchFlags& flags, const BatchReport& report, Plan* plan,
               parallel::Progress& progress) {
  std::unique_ptr<ProgressDisplay> display;
  const bool wanted = flags.common.progress_json || !(flags.common.quiet || flags.common.json);
  // Without pictures there is nothing to wait for.
  if (wanted && !flags.no_pictures) {
    display = std::make_unique<ProgressDisplay>(progress, flags.common.verbose,
                                                flags.common.progress_json);
  }
  const auto runner = MakeRunner(flags.work, report.threads);
  batch::WriteBatchPage(report, plan->file.report, plan->file.temporary_folder, !flags.no_pictures,
                        &plan->hashes, *runner, progress);
}

// What each operation would do and why. Reads files, writes none.
std::vector<OperationResult> Rehearse(Plan* plan, parallel::Progress& progress) {
  std::vector<OperationResult> results;
  for (const batch::Task& task : plan->tasks) {
    OperationResult result = plan->ResultOf(task);
    const bool of_folp =
        task.operation == Operation::kDecode || task.operation == Operation::kVerify;
    const OperationResult* first = of_folp && !plan->JobOf(task).from_folp()
                                       ? &results[plan->scans[task.scan].tasks.front()]
                                       : nullptr;
    try {
      if (first != nullptr && first->status == Status::kNotRun) {
        result.reason = "the encoded file will be new";
      } else {
        const batch::Finding finding = Examine(plan, task, progress);
        result = finding.record ? UpToDate(*plan, task, finding).result : result;
        result.reason = finding.reason;
      }
    } catch (const Failure& failure) {
      result.reason = "would fail: " + failure.error().message;
    }
    results.push_back(result);
  }
  return results;
}

int DryRun(const BatchFlags& flags, Plan* plan, Session& session, std::time_t started) {
  const BatchReport report =
      ReportOf(*plan, Rehearse(plan, session.progress()), started, session.seconds());
  if (flags.common.json) {
    Json json = ToJson(report);
    json["dry_run"] = true;
    PrintJson(json);
    return 0;
  }
  if (flags.common.quiet) return 0;
  std::string text;
  uint64_t to_run = 0;
  for (const OperationResult& result : report.results) {
    to_run += result.status == Status::kNotRun;
    text += fmt::format("{}: {}: {}\n", result.status == Status::kNotRun ? "run" : "skip",
                        TextOf(result), result.reason);
  }
  Print(text + fmt::format("{} scans; {} operations to run, {} up to date; nothing was written\n",
                           report.scans, to_run, report.results.size() - to_run));
  return 0;
}

int Run(const BatchFlags& flags) {
  if (flags.print_example) {
    Print(batch::ExampleText());
    return 0;
  }
  if (flags.job_file.empty()) throw Failure(ErrorKind::kUsage, "batch needs JOB.toml");
  const std::time_t started = std::time(nullptr);
  Plan plan = batch::MakePlan(ReadJobs(flags));
  // Operations run in processes of their own, which are to be started from one without threads.
  CommonFlags no_display = flags.common;
  no_display.json = true;
  no_display.progress_json = false;
  Session session(no_display);
  if (flags.dry_run) return DryRun(flags, &plan, session, started);
  batch::OpenOutputs(&plan);
  Reporter reporter(flags, plan.file.report);
  const batch::Budget budget(plan.file.threads, plan.file.memory_bytes);
  std::vector<OperationResult> results =
      batch::RunPlan(&plan, budget, session.progress(), reporter);
  reporter.StopDisplay();
  BatchReport report = ReportOf(plan, std::move(results), started, session.seconds());
  report.interrupted = session.progress().cancelled();
  if (report.interrupted) report.exit_code = static_cast<int>(ErrorKind::kInterrupted);
  const std::string report_path = plan.file.report + "/report.json";
  WriteReport(report, report_path);
  WritePage(flags, report, &plan, session.progress());
  if (flags.common.json) {
    PrintJson(ToJson(report));
  } else if (!flags.common.quiet) {
    Print(Summary(report, report_path));
  }
  if (report.interrupted) throw parallel::Cancelled();
  return report.exit_code;
}

}  // namespace

Verb AddBatch(CLI::App& program) {
  auto flags = std::make_shared<BatchFlags>();
  CLI::App* verb = program.add_subcommand("batch", kDescription);
  verb->add_option("JOB.toml", flags->job_file, "What to do with which scans")->type_name("");
  verb->add_flag("--dry-run", flags->dry_run, "Tell what would be done and why, and do nothing");
  verb->add_flag("--print-example", flags->print_example,
                 "Print a job file that explains every key, and stop");
  verb->add_flag("--no-pictures", flags->no_pictures, "Draw no meshes for report.html");
  AddWorkFlags(verb, &flags->work);
  AddCommonFlags(verb, &flags->common);
  AddProgressFlag(verb, &flags->common);
  return {verb, [flags] { return Run(*flags); }};
}

}  // namespace folprom::cli
