// The synthetic scan: exact size, the same for a seed, a mesh as a scanner leaves it.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>

#include "tests/cli/program.h"
#include "tests/support/files.h"

namespace folprom::cli_test {
namespace {

struct Ply {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<uint32_t, 3>> faces;
};

Ply ReadPly(const std::string& path) {
  const std::string text = FileText(path);
  const auto count = [&](const std::string& element) {
    const std::string key = "element " + element + " ";
    return static_cast<size_t>(std::stoull(text.substr(text.find(key) + key.size(), 20)));
  };
  Ply ply;
  ply.positions.resize(count("vertex"));
  ply.faces.resize(count("face"));
  const char* at = text.data() + text.find("end_header\n") + 11;
  EXPECT_EQ(static_cast<size_t>(text.data() + text.size() - at),
            12 * ply.positions.size() + 13 * ply.faces.size());
  std::memcpy(ply.positions.data(), at, 12 * ply.positions.size());
  at += 12 * ply.positions.size();
  for (auto& face : ply.faces) {
    EXPECT_EQ(*at, 3);
    std::memcpy(face.data(), at + 1, 12);
    at += 13;
  }
  return ply;
}

class Synth : public CliTest {
 protected:
  Ply Make(const std::string& vertices, const std::string& seed,
           const std::string& kind = "scan") const {
    const Outcome outcome = Run({"synth", "--kind", kind, "--vertices", vertices, "--seed", seed,
                                 "-o", Path("s.ply"), "-q", "-f"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return ReadPly(Path("s.ply"));
  }
};

using Edge = std::pair<uint32_t, uint32_t>;

// Directed edges of all faces, sorted.
std::vector<Edge> DirectedEdges(const Ply& ply) {
  std::vector<Edge> edges;
  for (const auto& face : ply.faces) {
    for (size_t i = 0; i < 3; ++i) edges.push_back({face[i], face[(i + 1) % 3]});
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

size_t ComponentCount(const Ply& ply, size_t at_least) {
  std::vector<uint32_t> parent(ply.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& face : ply.faces) {
    parent[root(face[0])] = root(face[1]);
    parent[root(face[1])] = root(face[2]);
  }
  std::map<uint32_t, size_t> sizes;
  for (uint32_t v = 0; v < parent.size(); ++v) ++sizes[root(v)];
  return static_cast<size_t>(std::count_if(sizes.begin(), sizes.end(),
                                           [&](const auto& s) { return s.second >= at_least; }));
}

// Border edges stand in one direction only; each hole's border leads around it once.
size_t BorderLoops(const Ply& ply) {
  const std::vector<Edge> edges = DirectedEdges(ply);
  std::map<uint32_t, uint32_t> next;
  for (const auto& [a, b] : edges) {
    if (!std::binary_search(edges.begin(), edges.end(), Edge(b, a))) next[a] = b;
  }
  size_t loops = 0;
  while (!next.empty()) {
    ++loops;
    for (auto at = next.begin(); at != next.end();) {
      const uint32_t to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  }
  return loops;
}

// Part of the vertices that have six faces.
double ShareOfSixes(const Ply& ply) {
  std::vector<int> corners(ply.positions.size());
  for (const auto& face : ply.faces) {
    for (const uint32_t v : face) ++corners[v];
  }
  const auto six = std::count(corners.begin(), corners.end(), 6);
  return static_cast<double>(six) / static_cast<double>(corners.size());
}

TEST_F(Synth, GivesTheExactVertexCount) {
  for (const char* vertices : {"4", "5", "6", "7", "8", "50", "999", "20000", "123457"}) {
    for (const char* seed : {"1", "2", "18446744073709551615"}) {
      EXPECT_EQ(Make(vertices, seed).positions.size(), std::stoull(vertices)) << seed;
      EXPECT_EQ(Make(vertices, seed, "range").positions.size(), std::stoull(vertices)) << seed;
    }
  }
  EXPECT_EQ(Make("20k", "1").positions.size(), 20000u);
}

TEST_F(Synth, EveryEdgeHasOneOrTwoFacesOrientedAlike) {
  for (const char* kind : {"scan", "range"}) {
    for (const char* seed : {"1", "2", "3", "4"}) {
      const Ply ply = Make("60000", seed, kind);
      const std::vector<Edge> edges = DirectedEdges(ply);
      // Twice the same direction would be a third face, or two of opposite orientation.
      EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end());
      for (const auto& [a, b] : edges) {
        ASSERT_LT(a, ply.positions.size());
        ASSERT_NE(a, b);
      }
    }
  }
}

TEST_F(Synth, EveryVertexHasAFace) {
  for (const char* kind : {"scan", "range"}) {
    const Ply ply = Make("60000", "1", kind);
    std::vector<char> used(ply.positions.size());
    for (const auto& face : ply.faces) {
      for (const uint32_t v : face) used[v] = 1;
    }
    EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
  }
}

TEST_F(Synth, HasSeveralComponentsAndManyHoles) {
  for (const char* kind : {"scan", "range"}) {
    const Ply ply = Make("60000", "1", kind);
    EXPECT_GE(ComponentCount(ply, 1000), 4u);
    EXPECT_GE(BorderLoops(ply), 20u);
  }
}

TEST_F(Synth, IsNoGrid) { EXPECT_LT(ShareOfSixes(Make("60000", "1")), 0.6); }

TEST_F(Synth, RangeScansAreGrids) { EXPECT_GT(ShareOfSixes(Make("60000", "1", "range")), 0.85); }

TEST_F(Synth, RangeScansJoinNothingAcrossAJumpOfTheDepth) {
  const Ply ply = Make("60000", "1", "range");
  // A jump is as long as the object's parts lie behind each other, many times the pixels' distance.
  std::vector<double> lengths;
  for (const auto& face : ply.faces) {
    double squared = 0;
    for (size_t k = 0; k < 3; ++k) {
      const double d = static_cast<double>(ply.positions[face[0]][k]) -
                       static_cast<double>(ply.positions[face[1]][k]);
      squared += d * d;
    }
    lengths.push_back(squared);
  }
  std::sort(lengths.begin(), lengths.end());
  EXPECT_LT(lengths.back(), 8 * 8 * lengths[lengths.size() / 2]);
}

TEST_F(Synth, SameSeedGivesTheSameBytesAnotherSeedOthers) {
  for (const char* kind : {"scan", "range"}) {
    Make("30000", "7", kind);
    const std::string first = FileText(Path("s.ply"));
    Make("30000", "7", kind);
    EXPECT_EQ(FileText(Path("s.ply")), first);
    Make("30000", "8", kind);
    EXPECT_NE(FileText(Path("s.ply")), first);
  }
  ASSERT_EQ(Run({"synth", "--vertices", "30000", "-o", Path("d.ply"), "-q"}).exit_code, 0);
  Make("30000", "1");
  EXPECT_EQ(FileText(Path("s.ply")), FileText(Path("d.ply")));
}

TEST_F(Synth, ReportsAsJson) {
  const Outcome outcome = Run({"synth", "--vertices", "1e4", "-o", Path("s.ply"), "--json"});
  ASSERT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  const auto report = outcome.json();
  EXPECT_EQ(report.at("vertices"), 10000);
  EXPECT_EQ(report.at("faces"), ReadPly(Path("s.ply")).faces.size());
  EXPECT_EQ(report.at("kind"), "scan");
  EXPECT_EQ(report.at("seed"), 1);
  EXPECT_GT(report.at("peak_rss_bytes"), 0);
  EXPECT_GE(report.at("seconds"), 0.0);
}

TEST_F(Synth, MemoryDoesNotGrowWithTheMesh) {
  if (support::kSanitized) GTEST_SKIP() << "a sanitizer's own memory would be counted";
  const auto peak = [&](const char* kind, const char* vertices) {
    return Run({"synth", "--kind", kind, "--vertices", vertices, "-o", Path("s.ply"), "-f",
                "--json"})
        .json()
        .at("peak_rss_bytes")
        .get<uint64_t>();
  };
  // 3M vertices are 110 MB of positions and faces.
  EXPECT_LT(peak("scan", "3M"), peak("scan", "10k") + (uint64_t{16} << 20));
  EXPECT_LT(peak("range", "1M"), peak("range", "10k") + (uint64_t{16} << 20));
}

TEST_F(Synth, RejectsImpossibleSizes) {
  for (const char* vertices : {"0", "3", "1e12", "-5", "many"}) {
    ExpectError({"synth", "--vertices", vertices, "-o", Path("s.ply")}, 2, "--vertices");
  }
  ExpectError({"synth", "--vertices", "10", "--kind", "lidar", "-o", Path("s.ply")}, 2, "--kind");
  EXPECT_TRUE(Files().empty());
}

}  // namespace
}  // namespace folprom::cli_test
