#include "apps/batch/batch_report.h"

#include "apps/folprom/report.h"

namespace folprom::batch {
namespace {

using cli::OrNull;

constexpr std::array<std::string_view, 5> kStatusNames = {"done", "up_to_date", "failed",
                                                          "interrupted", "not_run"};

template <class T>
void Read(const Json& json, const char* key, T* value) {
  *value = json.at(key).get<T>();
}

template <class T>
void Read(const Json& json, const char* key, std::optional<T>* value) {
  const Json& field = json.at(key);
  *value = field.is_null() ? std::nullopt : std::optional<T>(field.get<T>());
}

template <class Enum, size_t N>
void ReadName(const Json& json, const char* key, const std::array<std::string_view, N>& names,
              Enum* value) {
  const auto name = json.at(key).get<std::string>();
  for (size_t i = 0; i < N; ++i) {
    if (names[i] == name) {
      *value = static_cast<Enum>(i);
      return;
    }
  }
  throw Failure(ErrorKind::kInput, std::string(key) + " '" + name + "' is not known");
}

Json PointJson(const RdPoint& p) {
  return {{"requested", p.requested},
          {"bits_per_vertex", p.bits_per_vertex},
          {"bytes", p.bytes},
          {"layers", p.layers},
          {"vertices", p.vertices},
          {"faces", p.faces},
          {"mean", p.mean},
          {"rms", p.rms},
          {"max", p.max},
          {"mean_relative", OrNull(p.mean_relative)}};
}

RdPoint PointOf(const Json& json) {
  RdPoint p;
  Read(json, "requested", &p.requested);
  Read(json, "bits_per_vertex", &p.bits_per_vertex);
  Read(json, "bytes", &p.bytes);
  Read(json, "layers", &p.layers);
  Read(json, "vertices", &p.vertices);
  Read(json, "faces", &p.faces);
  Read(json, "mean", &p.mean);
  Read(json, "rms", &p.rms);
  Read(json, "max", &p.max);
  Read(json, "mean_relative", &p.mean_relative);
  return p;
}

OperationResult OperationOf(const Json& json) {
  OperationResult r;
  Read(json, "job", &r.job);
  Read(json, "scan", &r.scan);
  ReadName(json, "operation", kOperationNames, &r.operation);
  ReadName(json, "status", kStatusNames, &r.status);
  Read(json, "reason", &r.reason);
  Read(json, "input", &r.input);
  Read(json, "folp", &r.folp);
  Read(json, "output", &r.output);
  Read(json, "settings", &r.settings);
  Read(json, "lod", &r.lod);
  Read(json, "input_bytes", &r.input_bytes);
  Read(json, "output_bytes", &r.output_bytes);
  Read(json, "vertices", &r.vertices);
  Read(json, "faces", &r.faces);
  Read(json, "bits_per_vertex", &r.bits_per_vertex);
  Read(json, "layers", &r.layers);
  Read(json, "error_bound", &r.error_bound);
  Read(json, "seconds", &r.seconds);
  Read(json, "peak_memory_bytes", &r.peak_memory_bytes);
  Read(json, "threads", &r.threads);
  Read(json, "memory_bytes", &r.memory_bytes);
  Read(json, "verified", &r.verified);
  Read(json, "max_position_error", &r.max_position_error);
  Read(json, "exit_code", &r.exit_code);
  Read(json, "error", &r.error);
  Read(json, "warnings", &r.warnings);
  for (const Json& point : json.at("points")) r.points.push_back(PointOf(point));
  return r;
}

BatchReport ReportOf(const Json& json) {
  if (const int schema = json.at("schema").get<int>(); schema != kReportSchema) {
    throw Failure(ErrorKind::kInput, "schema " + std::to_string(schema) + " is not known");
  }
  BatchReport r;
  Read(json, "program", &r.program);
  Read(json, "format_version", &r.format_version);
  Read(json, "job_file", &r.job_file);
  Read(json, "started", &r.started);
  Read(json, "seconds", &r.seconds);
  Read(json, "threads", &r.threads);
  Read(json, "memory_bytes", &r.memory_bytes);
  Read(json, "exit_code", &r.exit_code);
  Read(json, "interrupted", &r.interrupted);
  Read(json, "scans", &r.scans);
  Read(json, "scans_done", &r.scans_done);
  Read(json, "scans_failed", &r.scans_failed);
  for (const Json& result : json.at("results")) r.results.push_back(OperationOf(result));
  return r;
}

template <class T, class Work>
Result<T> Reading(Work work) {
  try {
    return work();
  } catch (const Failure& failure) {
    return Error{failure.error().kind, "batch report: " + failure.error().message};
  } catch (const Json::exception& error) {
    return Error{ErrorKind::kInput, std::string("batch report: ") + error.what()};
  }
}

}  // namespace

std::string_view NameOf(Operation operation) {
  return kOperationNames[static_cast<size_t>(operation)];
}
std::string_view NameOf(Status status) { return kStatusNames[static_cast<size_t>(status)]; }

Json ToJson(const OperationResult& r) {
  Json points = Json::array();
  for (const RdPoint& point : r.points) points.push_back(PointJson(point));
  return {{"job", r.job},
          {"scan", r.scan},
          {"operation", NameOf(r.operation)},
          {"status", NameOf(r.status)},
          {"reason", r.reason},
          {"input", r.input},
          {"folp", r.folp},
          {"output", r.output},
          {"settings", r.settings},
          {"lod", r.lod},
          {"input_bytes", r.input_bytes},
          {"output_bytes", r.output_bytes},
          {"vertices", r.vertices},
          {"faces", r.faces},
          {"bits_per_vertex", r.bits_per_vertex},
          {"layers", r.layers},
          {"error_bound", OrNull(r.error_bound)},
          {"seconds", r.seconds},
          {"peak_memory_bytes", r.peak_memory_bytes},
          {"threads", r.threads},
          {"memory_bytes", r.memory_bytes},
          {"verified", OrNull(r.verified)},
          {"max_position_error", OrNull(r.max_position_error)},
          {"exit_code", r.exit_code},
          {"error", r.error},
          {"warnings", r.warnings},
          {"points", points}};
}

Json ToJson(const BatchReport& r) {
  Json results = Json::array();
  for (const OperationResult& result : r.results) results.push_back(ToJson(result));
  return {{"schema", kReportSchema},
          {"program", r.program},
          {"format_version", r.format_version},
          {"job_file", r.job_file},
          {"started", r.started},
          {"seconds", r.seconds},
          {"threads", r.threads},
          {"memory_bytes", r.memory_bytes},
          {"exit_code", r.exit_code},
          {"interrupted", r.interrupted},
          {"scans", r.scans},
          {"scans_done", r.scans_done},
          {"scans_failed", r.scans_failed},
          {"results", results}};
}

Result<OperationResult> OperationFromJson(const Json& json) {
  return Reading<OperationResult>([&] { return OperationOf(json); });
}

Result<BatchReport> ReportFromJson(const Json& json) {
  return Reading<BatchReport>([&] { return ReportOf(json); });
}

}  // namespace folprom::batch
