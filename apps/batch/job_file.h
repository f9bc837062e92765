// A job file as it was read: what to do with which scans.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "apps/batch/batch_report.h"
#include "apps/folprom/config.h"
#include "apps/folprom/config_keys.h"
#include "folprom/settings.h"

namespace folprom::batch {

/// What to decode: at most one of the bounds; none: everything.
struct Lod {
  std::string name;  ///< of the output, between its stem and ".ply"; empty: from the bound
  double bpv = 0;
  double max_error = 0;
  uint64_t max_vertices = 0;
  uint32_t layers = 0;
  std::string region;

  /// "bpv 2", "whole", with ", region ..." where there is one.
  std::string Text() const;
  /// What follows the stem of the output: ".bpv2.ply", ".ply" for everything.
  std::string Suffix() const;
  DecodeOptions Options() const;
};

/// A [[job]], with what [defaults] gave.
struct Job {
  std::string name;
  std::vector<std::string> input;
  std::vector<std::string> exclude;
  std::string output;  ///< folder
  std::string pattern = "{stem}";
  std::string config;
  std::vector<std::string> operations = {"encode"};
  std::string existing = "skip";
  std::string on_error = "continue";
  std::vector<Lod> lods;
  std::vector<double> rates;
  uint64_t samples = 0;
  cli::EncodeConfig encode;

  bool Does(Operation operation) const;
  /// Starts from encoded files, not from scans.
  bool from_folp() const { return !Does(Operation::kEncode) && !Does(Operation::kRd); }
  /// For a reader: "12 bits, effort 5".
  std::string SettingsText() const;

  std::string file;                  ///< the job file, as it was named
  std::map<std::string, int> lines;  ///< of the keys in the own table, 1 ..; "": of the table
  /// Failure "file:line: message" at the key, or at the table where it does not give the key.
  [[noreturn]] void Fail(ErrorKind kind, const std::string& key, const std::string& message) const;
};

struct JobFile {
  std::filesystem::path path;  ///< absolute
  std::vector<Job> jobs;
  // Of the whole batch.
  uint32_t threads = 0;
  uint64_t memory_bytes = EncodeOptions().limits.memory_bytes;
  std::string temporary_folder;
  std::string report;  ///< folder, absolute

  /// A path of the file: relative ones start at its folder. Absolute and normal.
  std::filesystem::path Resolve(const std::string& path) const;
};

/// Reads and checks all that can be told without a look at the scans. Throws Failure "file:line:
/// message": kUsage; kInput where the file or one that `config` names cannot be read.
JobFile ReadJobFile(const std::string& path);

}  // namespace folprom::batch
