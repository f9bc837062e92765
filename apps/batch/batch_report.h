// What a batch did: one record per scan and operation, as JSON lines while it runs and as one
// object at the end. README.md in this folder is the schema.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "folprom/result.h"

namespace folprom::batch {

/// Keeps the keys in the order in which they were set.
using Json = nlohmann::ordered_json;

/// Raised when a field changes its meaning or goes; new fields leave it.
inline constexpr int kReportSchema = 1;

enum class Operation : uint8_t { kEncode, kDecode, kVerify, kRd };
/// As job files and reports write them, in the order of Operation.
inline constexpr std::array<std::string_view, 4> kOperationNames = {"encode", "decode", "verify",
                                                                    "rd"};

/// How an operation ended.
enum class Status : uint8_t {
  kDone,         ///< ran, and its output is new
  kUpToDate,     ///< nothing to do; the figures are those of the run that made the output
  kFailed,       ///< `error` says why
  kInterrupted,  ///< begun and stopped; nothing of it is left
  kNotRun        ///< never begun: interrupted or stopped before, or what it needs failed
};

std::string_view NameOf(Operation operation);
std::string_view NameOf(Status status);

/// Distance of a decoded part from its scan at one rate: the larger of the two directions.
struct RdPoint {
  double requested = 0;        ///< bits per vertex of the scan that were asked for
  double bits_per_vertex = 0;  ///< of the layers decoded
  uint64_t bytes = 0;
  uint64_t layers = 0;
  uint64_t vertices = 0;
  uint64_t faces = 0;
  double mean = 0, rms = 0, max = 0;    ///< model units
  std::optional<double> mean_relative;  ///< mean / diagonal of the scan's box; a point has none
};

/// One operation on one scan. What an operation does not have stays 0, empty or none.
struct OperationResult {
  std::string job;   ///< name of the [[job]] table
  std::string scan;  ///< unique in the job: path below the fixed part of its glob
  Operation operation = Operation::kEncode;
  Status status = Status::kNotRun;
  std::string reason;  ///< why it ran or did not: "output is missing", "input changed", ...

  std::string input;  ///< absolute path of the scan; of the .folp file where no scan is known
  std::string folp;   ///< absolute path of the encoded file; empty for a job of rd alone
  /// Absolute path of what was written: the .folp, the decoded .ply; of rd the .json, beside which
  /// stand .csv and .svg. Empty for verify.
  std::string output;
  std::string settings;  ///< for a reader: "exact", "12 bits", "tolerance 0.1", and "effort 5"
  std::string lod;       ///< decode: "bpv 2", "max_vertices 20000", ..., "whole"

  uint64_t input_bytes = 0;
  uint64_t output_bytes = 0;
  uint64_t vertices = 0;              ///< of the output; of the scan for encode, verify and rd
  uint64_t faces = 0;                 ///< as vertices
  double bits_per_vertex = 0;         ///< encode, rd: 8 x bytes of the .folp / vertices
  uint64_t layers = 0;                ///< encode: of the file; decode: decoded
  std::optional<double> error_bound;  ///< decode: model units

  double seconds = 0;              ///< wall clock
  uint64_t peak_memory_bytes = 0;  ///< largest resident size of the operation's process
  uint32_t threads = 0;            ///< that it was given
  uint64_t memory_bytes = 0;       ///< that it was given of the budget

  std::optional<bool> verified;              ///< verify: lossless
  std::optional<double> max_position_error;  ///< verify against a scan: model units
  int exit_code = 0;                         ///< of a failure: the code of its kind
  std::string error;                         ///< one sentence
  std::vector<std::string> warnings;
  std::vector<RdPoint> points;  ///< rd
};

/// All of a batch. Results stand in the order of the job file: job, scan, operation.
struct BatchReport {
  std::string program;  ///< "folprom 0.1.0"
  uint32_t format_version = 0;
  std::string job_file;  ///< absolute
  std::string started;   ///< UTC, ISO 8601
  double seconds = 0;
  uint32_t threads = 0;       ///< budget
  uint64_t memory_bytes = 0;  ///< budget
  int exit_code = 0;          ///< 0, 130, or the code of the first failure
  bool interrupted = false;
  uint64_t scans = 0;         ///< all of the job file
  uint64_t scans_done = 0;    ///< all of their operations done or up to date
  uint64_t scans_failed = 0;  ///< with a failed operation
  std::vector<OperationResult> results;
};

Json ToJson(const OperationResult& result);
Json ToJson(const BatchReport& report);
/// Reads what ToJson wrote; kInput where a field is missing or of another type.
Result<OperationResult> OperationFromJson(const Json& json);
Result<BatchReport> ReportFromJson(const Json& json);

}  // namespace folprom::batch
