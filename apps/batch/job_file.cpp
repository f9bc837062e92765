#include "apps/batch/job_file.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>
#include <utility>

#include "apps/batch/job_keys.h"
#include "apps/batch/name_pattern.h"
#include "apps/folprom/key_reader.h"
#include "apps/folprom/options.h"
#include "apps/folprom/rd_curve.h"

namespace folprom::batch {
namespace {

namespace fs = std::filesystem;

class JobReader {
 public:
  explicit JobReader(const std::string& path) : path_(path), toml_(path) {
    file_.path = fs::absolute(path).lexically_normal();
  }

  JobFile Read() {
    CheckTables();
    Job defaults;
    defaults.file = path_;
    defaults.rates = cli::ParseRates(cli::kDefaultRates);
    if (const toml::table* table = toml_.root()["defaults"].as_table()) {
      ReadTable(*table, kDefaults, &defaults);
    }
    defaults.lines.clear();
    if (file_.report.empty()) file_.report = file_.path.stem().string() + ".report";
    file_.report = file_.Resolve(file_.report).string();
    const toml::array* jobs = toml_.root()["job"].as_array();
    if (jobs == nullptr || jobs->empty()) {
      throw Failure(ErrorKind::kUsage, path_ + ": has no [[job]]; write one with input and output");
    }
    for (const toml::node& node : *jobs) {
      Job job = defaults;
      job.name = "job" + std::to_string(file_.jobs.size() + 1);
      job.lines[""] = static_cast<int>(node.source().begin.line);
      ReadTable(*node.as_table(), kJob, &job);
      CheckJob(job);
      file_.jobs.push_back(job);
    }
    return std::move(file_);
  }

 private:
  void CheckTables() const {
    for (const auto& [name, node] : toml_.root()) {
      const bool is_defaults = name.str() == kDefaults, is_job = name.str() == kJob;
      if (is_defaults && !node.is_table()) toml_.Fail(node, "defaults must be a table, [defaults]");
      if (is_job && !node.is_array_of_tables()) {
        toml_.Fail(node, "job must be a list of tables, each under [[job]]");
      }
      if (is_defaults || is_job) continue;
      Job job;
      toml_.Fail(node, node.is_table() || node.is_array_of_tables()
                           ? "unknown table [" + std::string(name.str()) +
                                 "]; there are [defaults] and [[job]]"
                           : "key " + std::string(name.str()) +
                                 " stands outside the tables [defaults] and [[job]]" +
                                 cli::NearestKey(JobKeys(job, kJob), "", name.str()));
    }
  }

  // Over what *job holds: the settings of `config`, then the keys beside it.
  void ReadTable(const toml::table& table, std::string_view table_name, Job* job) {
    std::vector<cli::Key> keys = JobKeys(*job, table_name);
    // For [[job]] too, so that the message about one there names the place where it belongs.
    for (const cli::Key& key : BatchKeys(file_)) keys.push_back(key);
    for (const auto& [name, node] : table) {
      job->lines[std::string(name.str())] = static_cast<int>(node.source().begin.line);
    }
    if (const toml::node* node = table.get("config")) {
      cli::ReadKey(toml_, keys, table_name, "config", *node);
      if (!job->config.empty()) ReadSettings(*node, table_name, job);
    }
    if (const toml::node* node = table.get("effort")) {
      cli::ReadKey(toml_, keys, table_name, "effort", *node);
      job->encode.options.codec =
          WithEffort(job->encode.options.codec, job->encode.options.codec.effort);
    }
    ApplyResolution(table, job);
    for (const auto& [name, node] : table) {
      const bool is_read = name.str() == "config" || name.str() == "effort";
      if (is_read || cli::ReadKey(toml_, keys, table_name, name.str(), node)) continue;
      ReadLods(node, job);
    }
  }

  void ReadSettings(const toml::node& node, std::string_view table_name, Job* job) {
    const std::string path = file_.Resolve(job->config).string();
    const Result<void> read = cli::ReadConfig(path, &job->encode);
    if (!read) {
      throw Failure(read.error().kind, fmt::format("{}:{}: config: {}", path_,
                                                   node.source().begin.line, read.error().message));
    }
    if (table_name != kDefaults) return;
    file_.threads = job->encode.threads;
    file_.memory_bytes = job->encode.options.limits.memory_bytes;
    file_.temporary_folder = job->encode.options.temporary_folder;
  }

  // One of bits, tolerance and exact puts those out of force that come from farther away.
  void ApplyResolution(const toml::table& table, Job* job) const {
    const auto* exact = table["exact"].as_boolean();
    const bool is_exact = exact != nullptr && exact->get();
    const bool bits = table.contains("bits"), tolerance = table.contains("tolerance");
    if (bits && tolerance) {
      toml_.Fail(*table.get("tolerance"),
                 "bits and tolerance exclude each other; give one of them");
    }
    if (is_exact && (bits || tolerance)) {
      toml_.Fail(*table.get("exact"),
                 "exact = true keeps every bit, so that bits and tolerance have no meaning beside "
                 "it; give one of them");
    }
    if (bits) job->encode.options.tolerance = 0;
    if (bits || tolerance) job->encode.options.exact = false;
  }

  void ReadLods(const toml::node& node, Job* job) const {
    constexpr const char* kWanted =
        "lods must be a list of tables such as [{ bpv = 2 }, { max_vertices = \"20k\" }]";
    job->lods.clear();
    if (!node.is_array()) toml_.Fail(node, kWanted);
    for (const toml::node& item : *node.as_array()) {
      if (!item.is_table()) toml_.Fail(item, kWanted);
      Lod lod;
      const std::vector<cli::Key> keys = LodKeys(lod);
      for (const auto& [name, value] : *item.as_table()) {
        cli::ReadKey(toml_, keys, kLods, name.str(), value);
      }
      CheckLod(item, lod);
      job->lods.push_back(lod);
    }
  }

  void CheckLod(const toml::node& node, const Lod& lod) const {
    const int bounds =
        (lod.bpv > 0) + (lod.max_error > 0) + (lod.max_vertices > 0) + (lod.layers > 0);
    if (bounds > 1) {
      toml_.Fail(node, "a lod has at most one of bpv, max_error, max_vertices and layers");
    }
    if (!lod.region.empty()) {
      const auto box = cli::ParseRegion(lod.region);
      if (!box) toml_.Fail(node, "key job.lods.region: " + box.error().message);
    }
    if (lod.name.find('/') != std::string::npos) {
      toml_.Fail(node, "key job.lods.name is a part of a file name, without /");
    }
  }

  void CheckJob(const Job& job) const {
    const auto usage = [&](const std::string& key, const std::string& message) {
      job.Fail(ErrorKind::kUsage, key, message);
    };
    if (job.name.empty() || job.name.find('/') != std::string::npos) {
      usage("name", "key job.name must be a part of a file name, without /");
    }
    for (const Job& other : file_.jobs) {
      if (other.name == job.name) usage("name", "two jobs are called \"" + job.name + "\"");
    }
    if (job.input.empty())
      usage("input", "key job.input is missing; write input = \"scans/*.ply\"");
    if (job.output.empty()) {
      usage("output", "key job.output is missing; write output = \"encoded\", a folder");
    }
    if (const auto checked = CheckPattern(job.pattern); !checked) {
      usage("pattern", checked.error().message);
    }
    CheckOperations(job);
    if (const auto checked = cli::CheckConfig(job.encode); !checked) {
      usage("", checked.error().message);
    }
  }

  static void CheckOperations(const Job& job) {
    const auto usage = [&](const std::string& key, const std::string& message) {
      job.Fail(ErrorKind::kUsage, key, message);
    };
    if (job.operations.empty()) usage("operations", "operations is empty; write [\"encode\"]");
    const std::set<std::string> different(job.operations.begin(), job.operations.end());
    if (different.size() != job.operations.size()) {
      usage("operations", "operations names one twice");
    }
    const bool of_folp = job.Does(Operation::kDecode) || job.Does(Operation::kVerify);
    if (job.Does(Operation::kRd) && of_folp && !job.Does(Operation::kEncode)) {
      usage("operations",
            "rd starts from scans, decode and verify without encode from .folp files: add "
            "\"encode\", or make two jobs");
    }
    if (job.lines.contains("lods") && !job.Does(Operation::kDecode)) {
      usage("lods", "lods is given, but \"decode\" is not among the operations");
    }
    if (job.lines.contains("rates") && !job.Does(Operation::kRd)) {
      usage("rates", "rates is given, but \"rd\" is not among the operations");
    }
    if (job.lines.contains("samples") && !job.Does(Operation::kRd)) {
      usage("samples", "samples is given, but \"rd\" is not among the operations");
    }
    if (job.Does(Operation::kRd) && job.rates.empty()) usage("rates", "rates is empty");
  }

  std::string path_;
  cli::TomlFile toml_;
  JobFile file_;
};

}  // namespace

std::string Lod::Text() const {
  std::string text = "whole";
  if (bpv > 0) text = fmt::format("bpv {}", bpv);
  if (max_error > 0) text = fmt::format("max_error {}", max_error);
  if (max_vertices > 0) text = fmt::format("max_vertices {}", max_vertices);
  if (layers > 0) text = fmt::format("layers {}", layers);
  return region.empty() ? text : text + ", region " + region;
}

std::string Lod::Suffix() const {
  std::string text = name;
  if (text.empty() && bpv > 0) text = fmt::format("bpv{}", bpv);
  if (text.empty() && max_error > 0) text = fmt::format("error{}", max_error);
  if (text.empty() && max_vertices > 0) text = fmt::format("vertices{}", max_vertices);
  if (text.empty() && layers > 0) text = fmt::format("layers{}", layers);
  if (name.empty() && !region.empty()) text += text.empty() ? "region" : "-region";
  return text.empty() ? ".ply" : "." + text + ".ply";
}

DecodeOptions Lod::Options() const {
  DecodeOptions options;
  options.bits_per_vertex = bpv;
  options.max_error = max_error;
  options.max_vertices = max_vertices;
  options.layers = layers;
  if (!region.empty()) {
    const std::array<double, 6> corners = cli::ParseRegion(region).value();
    options.use_region = true;
    std::copy_n(corners.begin(), 3, options.region_lo);
    std::copy_n(corners.begin() + 3, 3, options.region_hi);
  }
  return options;
}

bool Job::Does(Operation operation) const {
  return std::find(operations.begin(), operations.end(), NameOf(operation)) != operations.end();
}

std::string Job::SettingsText() const {
  const EncodeOptions& o = encode.options;
  const std::string resolution = o.exact           ? "exact"
                                 : o.tolerance > 0 ? fmt::format("tolerance {}", o.tolerance)
                                                   : fmt::format("{} bits", o.bits);
  return resolution + fmt::format(", effort {}", o.codec.effort);
}

void Job::Fail(ErrorKind kind, const std::string& key, const std::string& message) const {
  const auto own = lines.find(key);
  const int line = own != lines.end() ? own->second : lines.at("");
  throw Failure(kind, fmt::format("{}:{}: job \"{}\": {}", file, line, name, message));
}

fs::path JobFile::Resolve(const std::string& name) const {
  return (path.parent_path() / name).lexically_normal();
}

JobFile ReadJobFile(const std::string& path) { return JobReader(path).Read(); }

}  // namespace folprom::batch
