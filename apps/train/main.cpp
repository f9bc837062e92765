// Makes the statistics that models start from, out of scans: see README.md.
#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/folprom/config.h"
#include "apps/train/lesson.h"
#include "apps/train/merge.h"
#include "engine/codec/encode_subtree.h"
#include "engine/encode_job.h"
#include "engine/entropy/initial_statistics.h"
#include "io/files/atomic_file.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom::train {
namespace {

/// A scan cut into subtrees, ready to be encoded again and again.
struct Pupil {
  std::string name;
  std::unique_ptr<parallel::Progress> progress = std::make_unique<parallel::Progress>();
  std::unique_ptr<EncodeJob> job;
};

Pupil Open(const std::string& scan, const EncodeOptions& options, parallel::Runner& runner) {
  Pupil pupil;
  pupil.name = std::filesystem::path(scan).stem().string();
  pupil.job = std::make_unique<EncodeJob>(scan, options, runner, *pupil.progress);
  pupil.job->MeasureScan();
  pupil.job->Partition();
  return pupil;
}

CodecParameters Cold(CodecParameters parameters) {
  parameters.settings.trained = false;
  parameters.statistics = nullptr;
  return parameters;
}

std::vector<Piece> Beginning(const CodecParameters& parameters) {
  SubtreeShape shape;
  shape.vertices = 2;
  SubtreeCoder coder(Cold(parameters), shape);
  Lesson lesson;
  coder.Visit(lesson);
  return lesson.pieces();
}

struct Result {
  double bits_per_vertex = 0;
  std::vector<WeightedLesson> lessons;
};

/// Encodes all subtrees, the models starting from `statistics`, or from nothing.
Result Encode(const Pupil& pupil, const InitialStatistics* statistics, parallel::Runner& runner) {
  CodecParameters parameters = Cold(pupil.job->parameters());
  const std::vector<Piece> beginning = Beginning(parameters);
  parameters.statistics = statistics;
  const size_t subtrees = pupil.job->scan().subtree_count();
  Result result;
  result.lessons.resize(subtrees);
  std::vector<size_t> bytes(subtrees, 0);
  runner.ForEach(subtrees, [&](size_t s) {
    Lesson lesson(beginning);
    const auto note = [&](SubtreeCoder& coder) {
      lesson.BeginVisit();
      coder.Visit(lesson);
    };
    const EncodedSubtree encoded =
        EncodeSubtree(pupil.job->scan().Load(s), pupil.job->scan().summary(s),
                      static_cast<uint32_t>(s), parameters, {}, note);
    for (const auto& segment : encoded.segments) bytes[s] += segment.size();
    result.lessons[s] = {lesson.pieces(), 1 / static_cast<double>(subtrees)};
  });
  double all = 0;
  for (size_t size : bytes) all += static_cast<double>(size);
  result.bits_per_vertex = 8 * all / static_cast<double>(pupil.job->source().vertex_count());
  return result;
}

using Lessons = std::vector<std::vector<WeightedLesson>>;  ///< per pupil

InitialStatistics MergeAll(const Lessons& lessons) {
  std::vector<WeightedLesson> chosen;
  for (const auto& lesson : lessons) chosen.insert(chosen.end(), lesson.begin(), lesson.end());
  return InitialStatistics(Merge(chosen));
}

/// What the pupils teach. Models that learn by small steps go on from what the first pass brought;
/// decisions are those of the first, which nothing had told anything.
InitialStatistics Teach(const std::vector<const Pupil*>& pupils, Lessons lessons, int passes,
                        parallel::Runner& runner) {
  for (int pass = 1; pass < passes; ++pass) {
    const InitialStatistics before = MergeAll(lessons);
    for (size_t p = 0; p < pupils.size(); ++p) {
      const Result again = Encode(*pupils[p], &before, runner);
      for (size_t l = 0; l < lessons[p].size(); ++l) {
        for (size_t i = 0; i < lessons[p][l].pieces.size(); ++i) {
          Piece& piece = lessons[p][l].pieces[i];
          if (piece.kind != Kind::kDecision) piece = again.lessons[l].pieces[i];
        }
      }
    }
  }
  return MergeAll(lessons);
}

std::string Text(std::span<const int16_t> codes) {
  std::string text = "// Made by folprom_train; 0 is followed by how many of it there are.\n", line;
  const auto put = [&](int value) {
    const std::string word = fmt::format("{},", value);
    if (line.size() + word.size() > 100) {
      text += line + "\n";
      line.clear();
    }
    line += word;
  };
  for (size_t i = 0; i < codes.size();) {
    if (codes[i] != 0) {
      put(codes[i++]);
      continue;
    }
    int run = 0;
    while (i < codes.size() && codes[i] == 0 && run < 32000) ++run, ++i;
    put(0);
    put(run);
  }
  return text + line + "\n";
}

/// What each pupil gains from what the others teach.
void Report(const std::vector<Pupil>& pupils, const std::vector<double>& cold,
            const Lessons& lessons, int passes, parallel::Runner& runner) {
  fmt::print("| scan | from nothing | taught by the others | gain |\n|---|---|---|---|\n");
  for (size_t p = 0; p < pupils.size(); ++p) {
    std::vector<const Pupil*> others;
    Lessons of_others;
    for (size_t o = 0; o < pupils.size(); ++o) {
      if (o == p) continue;
      others.push_back(&pupils[o]);
      of_others.push_back(lessons[o]);
    }
    const InitialStatistics statistics = Teach(others, std::move(of_others), passes, runner);
    const double bits = Encode(pupils[p], &statistics, runner).bits_per_vertex;
    fmt::print("| {} | {:.3f} | {:.3f} | {:.2f} % |\n", pupils[p].name, cold[p], bits,
               100 * (1 - bits / cold[p]));
    std::fflush(stdout);
  }
}

int Run(int argc, char** argv) {
  CLI::App app("Makes the statistics that models start from, out of scans.");
  std::vector<std::string> scans;
  std::string config, output;
  bool report = false;
  int passes = 3;
  app.add_option("scans", scans, "PLY files")->required()->check(CLI::ExistingFile);
  app.add_option("--config", config, "settings of the coder")->required();
  app.add_option("-o,--output", output, "file to write, such as trained_statistics.inc");
  app.add_option("--passes", passes, "how often each scan is encoded")->check(CLI::Range(1, 100));
  app.add_flag("--report", report, "print what each scan gains from the others alone");
  CLI11_PARSE(app, argc, argv);

  cli::EncodeConfig settings;
  cli::ReadConfig(config, &settings).value();
  const auto runner = parallel::MakeTbbRunner(0);
  std::vector<Pupil> pupils;
  std::vector<double> cold;
  Lessons lessons;
  for (const std::string& scan : scans) {
    pupils.push_back(Open(scan, settings.options, *runner));
    Result result = Encode(pupils.back(), nullptr, *runner);
    cold.push_back(result.bits_per_vertex);
    lessons.push_back(std::move(result.lessons));
    fmt::print(stderr, "{}: {:.3f} bits per vertex\n", pupils.back().name, cold.back());
  }
  if (report) Report(pupils, cold, lessons, passes, *runner);
  if (!output.empty()) {
    std::vector<const Pupil*> all;
    for (const Pupil& pupil : pupils) all.push_back(&pupil);
    const InitialStatistics statistics = Teach(all, std::move(lessons), passes, *runner);
    const std::string text = Text(statistics.codes());
    const auto file = io::AtomicFile::Create(output, true).value();
    file->Append({reinterpret_cast<const uint8_t*>(text.data()), text.size()}).value();
    file->Commit().value();
  }
  return 0;
}

}  // namespace
}  // namespace folprom::train

int main(int argc, char** argv) {
  try {
    return folprom::train::Run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "folprom_train: {}\n", e.what());
    return 1;
  }
}
