// Prints, as JSON, the rate-distortion envelope of "simplify, then Draco":
//   peer_envelope SCAN.ply SAMPLES RATE...
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <nlohmann/json.hpp>
#include <vector>

#include "parallel/runner.h"
#include "tests/bench/peers/envelope_search.h"

namespace folprom::peers {
namespace {

nlohmann::ordered_json JsonOf(const Envelope& envelope) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const EnvelopePoint& p : envelope.points) {
    points.push_back({{"requested", p.requested},
                      {"bits_per_vertex", p.bits_per_vertex},
                      {"bytes", p.bytes},
                      {"position_bits", p.position_bits},
                      {"vertices", p.vertices},
                      {"faces", p.faces},
                      {"mean_relative", p.error.mean},
                      {"rms_relative", p.error.rms},
                      {"max_relative", p.error.max}});
  }
  return {{"vertices", envelope.vertices},
          {"faces", envelope.faces},
          {"samples", envelope.samples},
          {"points", points}};
}

}  // namespace
}  // namespace folprom::peers

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "peer_envelope SCAN.ply SAMPLES RATE...\n");
    return 2;
  }
  try {
    std::vector<double> rates;
    for (int i = 3; i < argc; ++i) rates.push_back(std::stod(argv[i]));
    const auto runner = folprom::parallel::MakeTbbRunner(0);
    folprom::parallel::Progress progress;
    const folprom::peers::Envelope envelope = folprom::peers::SearchEnvelope(
        argv[1], rates, std::strtoull(argv[2], nullptr, 10), *runner, progress);
    std::puts(folprom::peers::JsonOf(envelope).dump(2).c_str());
    return 0;
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "peer_envelope: %s\n", fault.what());
    return 1;
  }
}
