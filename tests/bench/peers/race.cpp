#include "tests/bench/peers/race.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "io/spill/spill.h"

namespace folprom::peers {
namespace {

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

std::string LabelOf(const Contender& c) {
  return c.bits > 0 ? fmt::format("{} ({} bits)", c.name, c.bits) : c.name;
}

struct Phase {
  std::vector<double> seconds;  ///< by round
  uint64_t peak_bytes = 0;

  void Add(const Run& run) {
    seconds.push_back(run.seconds);
    peak_bytes = std::max(peak_bytes, run.peak_bytes);
  }
  Cost AgainstReference(const Phase* reference) const {
    Cost cost{Median(seconds), 0, peak_bytes};
    if (reference == nullptr) return cost;
    std::vector<double> ratios;
    for (size_t round = 0; round < seconds.size(); ++round) {
      ratios.push_back(seconds[round] / reference->seconds[round]);
    }
    cost.ratio = Median(ratios);
    return cost;
  }
};

class RaceJob {
 public:
  RaceJob(const std::string& scan, const ContenderOptions& options, int runs)
      : scan_(scan),
        runs_(runs),
        folder_(""),
        size_(MeasureScan(scan)),
        contenders_(MakeContenders(scan, size_, folder_.path(), options)),
        encode_(contenders_.size()),
        decode_(contenders_.size()),
        failure_(contenders_.size()) {}

  Race Run() {
    for (int round = 1; round <= runs_; ++round) {
      for (size_t i = 0; i < contenders_.size(); ++i) RunOnce(i, round);
    }
    Race race;
    race.scan = std::filesystem::path(scan_).stem().string();
    race.size = size_;
    race.runs = runs_;
    for (size_t i = 0; i < contenders_.size(); ++i) race.standings.push_back(StandingOf(i));
    return race;
  }

 private:
  void RunOnce(size_t i, int round) {
    if (!failure_[i].empty()) return;
    const Contender& c = contenders_[i];
    const std::string log = folder_.File("log");
    const auto encoded = Execute(c.encode, c.encode_output, log);
    if (!encoded.succeeded) return Fail(i, "encoding");
    const auto decoded = Execute(c.decode, c.decode_output, log);
    if (!decoded.succeeded) return Fail(i, "decoding");
    encode_[i].Add(encoded);
    decode_[i].Add(decoded);
    fmt::print(stderr,
               "{}: round {} of {}, {} of {}: {} encoded in {:.3f} s, decoded in {:.3f} s\n", scan_,
               round, runs_, i + 1, contenders_.size(), LabelOf(c), encoded.seconds,
               decoded.seconds);
  }

  void Fail(size_t i, const char* phase) {
    failure_[i] = phase;
    fmt::print(stderr, "{}: {} failed in {}\n", scan_, LabelOf(contenders_[i]), phase);
  }

  Standing StandingOf(size_t i) {
    const Contender& c = contenders_[i];
    Standing standing;
    standing.name = c.name;
    standing.bits = c.bits;
    standing.failure = failure_[i];
    if (!failure_[i].empty()) return standing;
    standing.bytes = std::filesystem::file_size(c.file);
    const size_t reference = ReferenceFor(c.bits);
    const bool known = reference < contenders_.size();
    standing.encode = encode_[i].AgainstReference(known ? &encode_[reference] : nullptr);
    standing.decode = decode_[i].AgainstReference(known ? &decode_[reference] : nullptr);
    standing.kept = Check(c);
    return standing;
  }

  // The number of contenders where the reference itself failed.
  size_t ReferenceFor(int bits) const {
    size_t found = contenders_.size();
    for (size_t i = contenders_.size(); i-- > 0;) {
      if (contenders_[i].name != kReference || !failure_[i].empty()) continue;
      if (contenders_[i].bits == bits) return i;
      if (bits == 0) found = i;
    }
    return found;
  }

  std::optional<Kept> Check(const Contender& c) {
    fmt::print(stderr, "{}: looking at what {} gave back\n", scan_, LabelOf(c));
    if (!c.convert.empty() && !Execute(c.convert, "", "").succeeded) return std::nullopt;
    const nlohmann::json json =
        JsonOf({PEER_CHECK, scan_, c.mesh, fmt::format("{:.17g}", c.tolerance)},
               folder_.File("check.json"));
    Kept kept;
    kept.vertices = json.at("vertices");
    kept.faces = json.at("faces");
    kept.lost_vertices = json.at("lost_vertices");
    kept.lost_faces = json.at("lost_faces");
    kept.same_vertices = json.at("same_vertices");
    kept.same_connectivity = json.at("same_connectivity");
    kept.vertex_order = json.at("vertex_order");
    kept.face_order = json.at("face_order");
    return kept;
  }

  const std::string scan_;
  const int runs_;
  const io::SpillDirectory folder_;
  const ScanSize size_;
  const std::vector<Contender> contenders_;
  std::vector<Phase> encode_, decode_;
  std::vector<std::string> failure_;
};

}  // namespace

Race RunRace(const std::string& scan, const ContenderOptions& options, int runs) {
  return RaceJob(scan, options, runs).Run();
}

}  // namespace folprom::peers
