// What the tests of `folprom batch` share: scans, job files, and what a run reported.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/cli/program.h"

namespace folprom::cli_test {

class BatchTest : public CliTest {
 protected:
  /// A scan of about that many vertices, the same for the same seed.
  void MakeScan(const std::string& name, int vertices, int seed) const {
    std::filesystem::create_directories(std::filesystem::path(Path(name)).parent_path());
    ASSERT_EQ(Run({"synth", "--vertices", std::to_string(vertices), "--seed", std::to_string(seed),
                   "-o", Path(name), "-q", "-f"})
                  .exit_code,
              0);
  }

  std::string WriteJob(const std::string& text) const {
    WriteText(Path("job.toml"), text);
    return Path("job.toml");
  }

  Outcome RunBatch(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"batch", Path("job.toml"), "--no-pictures"});
    return Run(more);
  }

  nlohmann::json Report() const {
    return nlohmann::json::parse(FileText(Path("job.report/report.json")));
  }

  /// "encode a.ply" -> status, of the last run.
  std::map<std::string, std::string> Statuses() const {
    std::map<std::string, std::string> statuses;
    const nlohmann::json report = Report();
    for (const auto& result : report.at("results")) {
      std::string name = result.at("operation");
      name += ' ';
      name += result.at("scan").get<std::string>();
      if (result.at("operation") == "decode") {
        name += ' ';
        name += result.at("lod").get<std::string>();
      }
      statuses[name] = result.at("status");
    }
    return statuses;
  }

  /// Hash of every file below a folder but the state file, by its path there.
  std::map<std::string, size_t> Contents(const std::string& folder) const {
    std::map<std::string, size_t> contents;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(Path(folder))) {
      const std::string name = entry.path().filename();
      if (!entry.is_regular_file() || name.starts_with(".folprom-batch")) continue;
      contents[std::filesystem::relative(entry.path(), Path(folder))] =
          std::hash<std::string>()(FileText(entry.path()));
    }
    return contents;
  }
};

}  // namespace folprom::cli_test
