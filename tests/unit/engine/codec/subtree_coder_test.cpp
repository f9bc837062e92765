// One subtree through encoder and decoder, without a file around it.
#include "engine/codec/subtree_coder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "engine/codec/border_file.h"
#include "engine/codec/encode_subtree.h"
#include "engine/entropy/bit_coder.h"
#include "tests/support/coders.h"

namespace folprom {
namespace {

constexpr int32_t kSide = 40000;

/// A chunk that owns what it shows.
struct Chunk {
  std::vector<Int3> positions;
  std::vector<Face> faces;
  std::vector<CrossFace> cross_faces;
  SubtreeChunk view() const { return {positions, faces, cross_faces, {}}; }
  SubtreeSummary summary() const {
    SubtreeSummary summary;
    summary.vertices = static_cast<uint32_t>(positions.size());
    summary.faces = faces.size();
    summary.cross_faces = cross_faces.size();
    summary.box_hi = {kSide, kSide, kSide};
    if (!cross_faces.empty()) summary.neighbours = {1};
    return summary;
  }
};

Chunk Sheet(uint32_t side) {
  Chunk chunk;
  for (uint32_t i = 0; i < side * side; ++i) {
    const double x = i % side, y = i / side, step = static_cast<double>(kSide) / side;
    chunk.positions.push_back(
        {static_cast<int32_t>(x * step), static_cast<int32_t>(y * step),
         static_cast<int32_t>(kSide / 2 + kSide / 5 * std::sin(x * 0.4) * std::cos(y * 0.3))});
    if (i % side + 1 == side || i / side + 1 == side) continue;
    chunk.faces.push_back({i, i + 1, i + side});
    chunk.faces.push_back({i + 1, i + side + 1, i + side});
  }
  return chunk;
}

/// Random triangles over random points, of which some coincide, with faces into another subtree.
Chunk Soup(uint64_t seed) {
  std::mt19937_64 random(seed);
  Chunk chunk;
  const uint32_t count = 1 + static_cast<uint32_t>(random() % 120);
  auto draw = [&] { return static_cast<int32_t>(random() % kSide); };
  for (uint32_t v = 0; v < count; ++v) {
    if (v > 0 && random() % 10 == 0) {
      chunk.positions.push_back(chunk.positions[random() % v]);
    } else {
      chunk.positions.push_back({draw(), draw(), draw()});
    }
  }
  auto vertex = [&] { return static_cast<uint32_t>(random() % count); };
  for (uint64_t f = random() % (3 * count); f > 0; --f) {
    chunk.faces.push_back({vertex(), vertex(), vertex()});
  }
  for (uint64_t f = random() % count; f > 0; --f) {
    const uint32_t a = vertex(), b = vertex();
    chunk.cross_faces.push_back(
        {{{{0, a}, {0, b}, {1, 0}}}, {chunk.positions[a], chunk.positions[b], Int3{5, 5, 5}}});
  }
  return chunk;
}

CodecParameters ParametersFor(const CodecSettings& settings) {
  CodecParameters parameters;
  parameters.extent = {kSide, kSide, kSide};
  parameters.settings = settings;
  const uint32_t per_octave = parameters.settings.steps_per_octave;
  parameters.schedule = LayerSchedule(
      parameters.extent, per_octave, parameters.settings.rounds_per_step,
      SplitLayersFor(parameters.extent, 500, per_octave, parameters.settings.offsets),
      RefineLayersFor(parameters.extent, 500, per_octave, parameters.settings.offsets));
  return parameters;
}

/// Of the coder of the paper.
CodecParameters ParametersFor(uint32_t children, bool split_first) {
  CodecSettings settings = support::LloydSettings();
  settings.children = children;
  settings.split_first = split_first;
  return ParametersFor(settings);
}

/// Faces by their corners in the chunk's own numbers, rotated to the smallest, sorted.
std::vector<Face> Canonical(std::vector<Face> faces) {
  for (Face& face : faces) {
    Face best = face;
    for (int i = 0; i < 2; ++i) {
      std::rotate(face.begin(), face.begin() + 1, face.end());
      best = std::min(best, face);
    }
    face = best;
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

void ExpectComesBack(const Chunk& chunk, const CodecParameters& parameters) {
  const SubtreeSummary summary = chunk.summary();
  const EncodedSubtree encoded = EncodeSubtree(chunk.view(), summary, 0, parameters);
  const SubtreeShape shape{summary.vertices, summary.box_lo, summary.box_hi,
                           !summary.neighbours.empty()};
  SubtreeCoder decoder(parameters, shape);
  BitDecoder bits;
  for (size_t layer = 0; layer < encoded.segments.size(); ++layer) {
    bits.StartSegment(encoded.segments[layer]);
    decoder.CodeLayer(bits, nullptr, nullptr);
    ASSERT_EQ(decoder.positions().size(), encoded.vertices[layer]) << layer;
    ASSERT_EQ(decoder.face_count(), encoded.faces[layer]) << layer;
    ASSERT_EQ(decoder.border().LayerEnd(static_cast<uint32_t>(layer)),
              encoded.border.LayerEnd(static_cast<uint32_t>(layer)));
  }
  // Every vertex once, within the tolerance.
  ASSERT_EQ(decoder.positions().size(), chunk.positions.size());
  std::vector<uint32_t> vertices = encoded.final_vertices;
  for (size_t v = 0; v < vertices.size(); ++v) {
    const Int3 &a = chunk.positions[v], &b = decoder.positions()[vertices[v]];
    ASSERT_LE(std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)}), 31);
  }
  std::vector<Face> expected;
  for (const Face& f : chunk.faces) {
    expected.push_back({vertices[f[0]], vertices[f[1]], vertices[f[2]]});
  }
  std::sort(vertices.begin(), vertices.end());
  for (uint32_t v = 0; v < vertices.size(); ++v) ASSERT_EQ(vertices[v], v);
  std::vector<Face> faces;
  decoder.AppendFaces(&faces);
  ASSERT_EQ(Canonical(faces), Canonical(expected));
  // The border record is what the seams will replay on both sides.
  ASSERT_EQ(decoder.border().events.size(), encoded.border.events.size());
  for (size_t e = 0; e < encoded.border.events.size(); ++e) {
    const BorderEvent &a = decoder.border().events[e], &b = encoded.border.events[e];
    ASSERT_EQ(a.border, b.border);
    ASSERT_EQ(a.both, b.both);
    ASSERT_EQ(a.first_position, b.first_position);
    ASSERT_EQ(a.connected, b.connected);
  }
  const std::vector<uint32_t> border = decoder.BorderVertices();
  ASSERT_EQ(border.size(), encoded.border_vertices.original.size());
  for (size_t b = 0; b < border.size(); ++b) {
    EXPECT_EQ(border[b], encoded.final_vertices[encoded.border_vertices.original[b]]);
  }
}

TEST(SubtreeCoder, GivesBackASheet) {
  ASSERT_NO_FATAL_FAILURE(ExpectComesBack(Sheet(25), ParametersFor(CodecSettings())));
  for (uint32_t children : {2u, 4u, 8u}) {
    for (bool split_first : {true, false}) {
      ASSERT_NO_FATAL_FAILURE(ExpectComesBack(Sheet(25), ParametersFor(children, split_first)));
    }
  }
}

TEST(SubtreeCoder, GivesBackSoupsWithBorders) {
  for (uint64_t seed = 0; seed < 150; ++seed) {
    ASSERT_NO_FATAL_FAILURE(ExpectComesBack(Soup(seed), ParametersFor(CodecSettings()))) << seed;
    ASSERT_NO_FATAL_FAILURE(ExpectComesBack(
        Soup(seed), ParametersFor(2 + static_cast<uint32_t>(seed % 7), seed % 2 == 0)))
        << seed;
  }
}

TEST(SubtreeCoder, TakesFewerBytesForASheetThanForASoup) {
  auto bytes = [](const Chunk& chunk, const CodecParameters& parameters) {
    size_t sum = 0;
    for (const auto& s : EncodeSubtree(chunk.view(), chunk.summary(), 0, parameters).segments) {
      sum += s.size();
    }
    return sum;
  };
  Chunk shuffled = Sheet(25);
  std::mt19937_64 random(1);
  std::shuffle(shuffled.positions.begin(), shuffled.positions.end(), random);
  for (const auto& parameters : {ParametersFor(CodecSettings()), ParametersFor(4, true)}) {
    EXPECT_LT(3 * bytes(Sheet(25), parameters), 2 * bytes(shuffled, parameters));
  }
}

TEST(SubtreeCoder, DistancesBoundWhatIsDecoded) {
  const Chunk chunk = Sheet(25);
  for (const auto& parameters : {ParametersFor(CodecSettings()), ParametersFor(4, true)}) {
    const EncodedSubtree encoded = EncodeSubtree(chunk.view(), chunk.summary(), 0, parameters);
    EXPECT_LT(encoded.distance.back(), encoded.distance.front() / 10);
    EXPECT_LE(encoded.distance.back(), 31 * std::sqrt(3.0));
  }
}

TEST(BorderFile, ComesBackFromTheSpill) {
  const io::SpillDirectory spill("");
  const Chunk chunk = Soup(6);
  const EncodedSubtree encoded =
      EncodeSubtree(chunk.view(), chunk.summary(), 0, ParametersFor(4, true));
  SpillBorder(spill, 17, encoded.border, encoded.border_vertices);
  SpillBorder(spill, 18, {}, {});
  const BorderFile read = LoadBorder(spill, 17);
  ASSERT_EQ(read.record.events.size(), encoded.border.events.size());
  EXPECT_EQ(read.record.layer_end, encoded.border.layer_end);
  EXPECT_EQ(read.record.root_position, encoded.border.root_position);
  EXPECT_EQ(read.vertices.original, encoded.border_vertices.original);
  EXPECT_EQ(read.vertices.position, encoded.border_vertices.position);
  EXPECT_TRUE(LoadBorder(spill, 18).record.events.empty());
}

}  // namespace
}  // namespace folprom
