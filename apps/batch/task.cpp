#include "apps/batch/task.h"

#include <chrono>
#include <functional>
#include <new>

#include "apps/folprom/rd_curve.h"
#include "apps/folprom/session.h"
#include "folprom/folprom.h"
#include "folprom/measure.h"
#include "parallel/runner.h"

namespace folprom::batch {
namespace {

using Lookup = std::function<std::optional<KnownFile>(const std::string&)>;

Finding Run(std::string reason) { return {Verdict::kRun, std::move(reason), std::nullopt}; }

// Replaces *known by what `paths` hold now. What is wrong: empty where all hashes are the same,
// none where one is not known.
std::optional<std::string> Compare(const std::vector<std::string>& paths, const Lookup& lookup,
                                   const char* what, std::vector<KnownFile>* known) {
  if (paths.size() != known->size()) return std::string(what);
  for (size_t i = 0; i < paths.size(); ++i) {
    const std::optional<KnownFile> now = lookup(paths[i]);
    if (!now) return std::nullopt;
    if (now->hash != (*known)[i].hash) return std::string(what);
    (*known)[i] = *now;
  }
  return "";
}

Finding FindingBy(const Plan& plan, const Task& task, const Lookup& lookup) {
  const Job& job = plan.JobOf(task);
  if (job.existing == "overwrite") return Run("existing = \"overwrite\"");
  const Ledger& ledger = plan.ledgers.at(plan.OutputFolder(job));
  const Record* found = ledger.Find(task.key);
  if (found == nullptr) return Run(ledger.Knows(task.key) ? "was not finished" : "not made yet");
  for (const std::string& output : task.outputs) {
    if (!StampOf(output)) return Run("output is missing");
  }
  if (found->version != VersionText()) return Run("was made by " + found->version);
  if (found->settings != task.settings) return Run("settings changed");
  Record record = *found;
  const auto inputs = Compare(task.inputs, lookup, "input changed", &record.inputs);
  if (!inputs) return {};
  if (!inputs->empty()) return Run(*inputs);
  const auto outputs = Compare(task.outputs, lookup, "output changed", &record.outputs);
  if (!outputs) return {};
  if (!outputs->empty()) return Run(*outputs);
  return {Verdict::kUpToDate, "up to date", record};
}

// One operation on a scan, done by the engine.
class Operator {
 public:
  Operator(const Plan& plan, const Task& task, const Share& share, parallel::Progress& progress,
           OperationResult* result)
      : plan_(plan),
        job_(plan.JobOf(task)),
        scan_(plan.scans[task.scan]),
        task_(task),
        share_(share),
        runner_(parallel::MakeTbbRunner(static_cast<int>(share.threads))),
        progress_(progress),
        result_(result) {}

  void Run() {
    switch (task_.operation) {
      case Operation::kEncode:
        return Encode();
      case Operation::kDecode:
        return Decode();
      case Operation::kVerify:
        return Verify();
      case Operation::kRd:
        return MeasureCurve();
    }
  }

 private:
  bool MayReplace() const { return job_.existing != "fail"; }

  EncodeOptions Encoding() const {
    EncodeOptions options = job_.encode.options;
    options.limits.memory_bytes = share_.memory_bytes;
    options.temporary_folder = plan_.file.temporary_folder;
    options.overwrite = MayReplace();
    return options;
  }

  DecodeOptions Decoding() const {
    DecodeOptions options = task_.lod.Options();
    options.limits = job_.encode.options.limits;
    options.limits.memory_bytes = share_.memory_bytes;
    options.temporary_folder = plan_.file.temporary_folder;
    options.overwrite = MayReplace();
    return options;
  }

  void SetRate(uint64_t bytes) {
    if (result_->vertices == 0) return;
    result_->bits_per_vertex =
        8 * static_cast<double>(bytes) / static_cast<double>(result_->vertices);
  }

  void Encode() {
    const EncodeReport report =
        EncodeFile(scan_.input, scan_.folp, Encoding(), *runner_, progress_, Resume::kContinue)
            .value();
    result_->vertices = report.vertices;
    result_->faces = report.faces;
    result_->layers = report.layers;
    result_->warnings = report.warnings;
    SetRate(report.bytes);
  }

  void Decode() {
    const DecodeReport report =
        DecodeFile(scan_.folp, task_.outputs.front(), Decoding(), *runner_, progress_).value();
    result_->vertices = report.vertices;
    result_->faces = report.faces;
    result_->layers = report.layers;
    result_->error_bound = report.error_bound;
    result_->warnings = report.warnings;
  }

  void Verify() {
    const std::string original = job_.from_folp() ? "" : scan_.input;
    const VerifyReport report =
        VerifyFile(scan_.folp, original, Decoding(), *runner_, progress_).value();
    result_->vertices = report.vertices;
    result_->faces = report.faces;
    result_->verified = report.lossless;
    if (report.against) result_->max_position_error = report.max_position_error;
    if (!report.lossless) {
      throw Failure(ErrorKind::kCorrupt, scan_.folp + ": not lossless: " + report.reason);
    }
  }

  void MeasureCurve() {
    const auto begin = std::chrono::steady_clock::now();
    const EncodeOptions options = Encoding();
    const RateCurve curve =
        MeasureRates(scan_.input, options, job_.rates, job_.samples, *runner_, progress_).value();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    const cli::CurveOrigin origin{scan_.input, "", result_->settings, options};
    const std::string& json_path = task_.outputs.front();
    const std::string prefix = json_path.substr(0, json_path.size() - std::string(".json").size());
    cli::WriteCurve(prefix, origin, curve, cli::CurveJson(origin, curve, seconds.count()),
                    MayReplace());
    result_->vertices = curve.vertices;
    result_->faces = curve.faces;
    result_->warnings = curve.warnings;
    SetRate(curve.bytes);
    for (const RatePoint& point : curve.points) {
      const DistanceStatistics larger = cli::LargerOf(point.comparison);
      result_->points.push_back({point.requested, point.bits_per_vertex, point.bytes, point.layers,
                                 point.vertices, point.faces, larger.mean, larger.rms, larger.max,
                                 cli::Relative(larger.mean, point.comparison)});
    }
  }

  const Plan& plan_;
  const Job& job_;
  const Scan& scan_;
  const Task& task_;
  const Share& share_;
  const std::unique_ptr<parallel::Runner> runner_;
  parallel::Progress& progress_;
  OperationResult* result_;
};

void RunAndRecord(Plan* plan, const Task& task, const Share& share, parallel::Progress& progress,
                  Outcome* outcome) {
  Record record;
  record.version = VersionText();
  record.settings = task.settings;
  for (const std::string& input : task.inputs) {
    record.inputs.push_back(plan->hashes.Get(input, progress));
  }
  outcome->result.input_bytes = record.inputs.front().stamp.size;
  Operator(*plan, task, share, progress, &outcome->result).Run();
  for (const KnownFile& input : record.inputs) {
    if (StampOf(input.path) != input.stamp) {
      throw Failure(ErrorKind::kInput, input.path + ": changed while it was read");
    }
  }
  for (const std::string& output : task.outputs) {
    record.outputs.push_back(HashFile(output, progress));
    outcome->result.output_bytes += record.outputs.back().stamp.size;
  }
  outcome->result.status = Status::kDone;
  outcome->record = std::move(record);
}

void SetError(const Error& error, OperationResult* result) {
  result->status = error.kind == ErrorKind::kInterrupted ? Status::kInterrupted : Status::kFailed;
  result->exit_code = static_cast<int>(error.kind);
  result->error = error.message;
}

// Faults become the result's error.
template <class Work>
void Guarded(OperationResult* result, Work work) {
  try {
    work();
  } catch (const Failure& failure) {
    SetError(failure.error(), result);
  } catch (const parallel::Cancelled&) {
    SetError({ErrorKind::kInterrupted, "interrupted"}, result);
  } catch (const std::bad_alloc&) {
    SetError({ErrorKind::kLimit, "out of memory; a smaller -M or fewer threads may help"}, result);
  } catch (const std::exception& error) {
    SetError({ErrorKind::kInternal, std::string("internal error: ") + error.what()}, result);
  }
}

}  // namespace

Finding Look(const Plan& plan, const Task& task) {
  return FindingBy(plan, task, [&](const std::string& path) { return plan.hashes.Find(path); });
}

Finding Examine(Plan* plan, const Task& task, parallel::Progress& progress) {
  return FindingBy(*plan, task,
                   [&](const std::string& path) { return plan->hashes.Get(path, progress); });
}

Outcome UpToDate(const Plan& plan, const Task& task, const Finding& finding) {
  Outcome outcome{finding.record->result, finding.record};
  OperationResult& result = outcome.result;
  // The job file may have other names for it by now.
  const OperationResult now = plan.ResultOf(task);
  result.job = now.job;
  result.scan = now.scan;
  result.input = now.input;
  result.folp = now.folp;
  result.output = now.output;
  result.settings = now.settings;
  result.lod = now.lod;
  result.status = Status::kUpToDate;
  result.reason = finding.reason;
  return outcome;
}

Outcome RunTask(Plan* plan, const Task& task, const Share& share, parallel::Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  Outcome outcome{plan->ResultOf(task), std::nullopt};
  OperationResult& result = outcome.result;
  Guarded(&result, [&] {
    const Finding finding = Examine(plan, task, progress);
    if (finding.verdict == Verdict::kUpToDate) {
      outcome = UpToDate(*plan, task, finding);
      return;
    }
    result.reason = finding.reason;
    result.threads = share.threads;
    result.memory_bytes = share.memory_bytes;
    RunAndRecord(plan, task, share, progress, &outcome);
  });
  if (result.status == Status::kUpToDate) return outcome;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  result.seconds = seconds.count();
  result.peak_memory_bytes = cli::PeakResidentBytes();
  if (outcome.record) outcome.record->result = result;
  return outcome;
}

}  // namespace folprom::batch
