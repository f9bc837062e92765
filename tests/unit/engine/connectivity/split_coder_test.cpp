// SplitOracle and SplitCoder together against the definition: after every split two sets are joined
// by an edge exactly when an original edge joins them, and so for the faces.
#include "engine/connectivity/split_coder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include "engine/connectivity/face_exceptions.h"
#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

using Edge = std::array<uint32_t, 2>;

/// Original vertices with positions, and triples: faces, copies, degenerate ones, edges (a, b, b).
struct Mesh {
  std::vector<Int3> positions;
  std::vector<Face> triples;
};

Mesh RandomMesh(uint64_t seed) {
  std::mt19937_64 random(seed);
  Mesh mesh;
  const uint32_t vertices = 1 + static_cast<uint32_t>(random() % 24);
  for (uint32_t v = 0; v < vertices; ++v) {
    auto draw = [&] { return static_cast<int32_t>(random() % 1000); };
    mesh.positions.push_back(random() % 10 == 0 ? Int3{} : Int3{draw(), draw(), draw()});
  }
  auto vertex = [&] { return static_cast<uint32_t>(random() % vertices); };
  for (uint64_t i = random() % (4 * vertices); i > 0; --i) {
    if (random() % 8 == 0 && !mesh.triples.empty()) {
      Face copy = mesh.triples[random() % mesh.triples.size()];
      if (random() % 2 == 0) std::swap(copy[0], copy[1]);
      mesh.triples.push_back(copy);
    } else {
      mesh.triples.push_back({vertex(), vertex(), vertex()});
    }
  }
  return mesh;
}

/// A sheet, so that the usual case is among them.
Mesh Sheet(uint32_t side) {
  Mesh mesh;
  for (uint32_t i = 0; i < side * side; ++i) {
    const uint32_t x = i % side * 100, y = i / side * 100;
    mesh.positions.push_back({static_cast<int32_t>(x), static_cast<int32_t>(y), 0});
    if (i % side + 1 == side || i / side + 1 == side) continue;
    mesh.triples.push_back({i, i + 1, i + side});
    mesh.triples.push_back({i + 1, i + side + 1, i + side});
  }
  return mesh;
}

/// The edges and faces between the sets, by definition.
struct Images {
  std::set<Edge> edges;
  std::set<Face> faces;  ///< sorted
};

Images ImagesOf(const Mesh& mesh, const std::vector<uint32_t>& set_of) {
  Images images;
  for (const Face& t : mesh.triples) {
    Face image{set_of[t[0]], set_of[t[1]], set_of[t[2]]};
    std::sort(image.begin(), image.end());
    for (Edge e : {Edge{image[0], image[1]}, Edge{image[1], image[2]}, Edge{image[0], image[2]}}) {
      if (e[0] != e[1]) images.edges.insert(e);
    }
    if (image[0] != image[1] && image[1] != image[2]) images.faces.insert(image);
  }
  return images;
}

void ExpectImages(const Complex& complex, const Images& images) {
  std::set<Edge> edges;
  for (uint32_t e = 0; e < complex.edge_count(); ++e) {
    Edge edge = complex.edge(e);
    std::sort(edge.begin(), edge.end());
    ASSERT_TRUE(edges.insert(edge).second) << "twice the edge " << edge[0] << " " << edge[1];
  }
  ASSERT_EQ(edges, images.edges);
  std::set<Face> faces;
  for (uint32_t f = 0; f < complex.face_count(); ++f) {
    Face face = complex.face(f);
    std::sort(face.begin(), face.end());
    ASSERT_TRUE(faces.insert(face).second);
  }
  ASSERT_EQ(faces, images.faces);
}

/// Splits sets at random until every set is one vertex, and keeps what the decoder needs.
struct Recording {
  struct Split {
    uint32_t vertex;
    SplitCoder::Known known;
  };
  std::vector<Split> splits;
  std::vector<uint8_t> bytes;
  std::vector<std::vector<uint32_t>> members;  ///< originals per vertex of the complex
  Complex complex;
  std::vector<Face> final_faces;
  std::vector<uint32_t> face_of;
};

Recording Record(const Mesh& mesh, const ConnectivitySettings& settings, uint64_t seed) {
  std::mt19937_64 random(seed);
  Recording r;
  const uint32_t count = static_cast<uint32_t>(mesh.positions.size());
  SplitOracle oracle(count, mesh.triples);
  SplitCoder coder(settings);
  BitEncoder bits;
  SplitMeters meters;
  uint64_t exceptions = 0;
  std::vector<uint32_t> set_of(count, 0);
  std::vector<Int3> positions{mesh.positions[0]};
  r.complex.AddVertex();
  r.members.emplace_back();
  for (uint32_t v = 0; v < count; ++v) r.members[0].push_back(v);
  while (r.complex.vertex_count() < count) {
    uint32_t vertex = static_cast<uint32_t>(random() % r.complex.vertex_count());
    auto& set = r.members[vertex];
    if (set.size() < 2) continue;
    std::shuffle(set.begin(), set.end(), random);
    const size_t kept = 1 + random() % (set.size() - 1);
    std::vector<uint32_t> second(set.begin() + static_cast<ptrdiff_t>(kept), set.end());
    set.resize(kept);
    // The smaller child is the one that is moved, in one range or two.
    const bool second_is_smaller = second.size() <= set.size();
    const std::vector<uint32_t>& moved = second_is_smaller ? second : set;
    const size_t cut = random() % (moved.size() + 1);
    const std::span<const uint32_t> all(moved);
    const std::array<std::span<const uint32_t>, 2> ranges{all.first(cut), all.subspan(cut)};
    oracle.Scan(vertex, ranges, second_is_smaller);
    SplitCoder::Known known;
    known.first = mesh.positions[set[0]];
    known.second = mesh.positions[second[0]];
    const uint32_t added =
        coder.Code(bits, r.complex, positions, vertex, known, &oracle, &meters, &exceptions);
    EXPECT_EQ(added, r.complex.vertex_count() - 1);
    r.splits.push_back({vertex, known});
    positions[vertex] = known.first;
    positions.push_back(known.second);
    for (uint32_t v : second) set_of[v] = added;
    r.members.push_back(std::move(second));
    ExpectImages(r.complex, ImagesOf(mesh, set_of));
    if (::testing::Test::HasFatalFailure()) return r;
    for (uint32_t v = 0; v < count; ++v) EXPECT_EQ(oracle.VertexOf(v), set_of[v]);
  }
  for (uint32_t t = 0; t < mesh.triples.size(); ++t) {
    const Face& face = mesh.triples[t];
    r.final_faces.push_back({set_of[face[0]], set_of[face[1]], set_of[face[2]]});
    r.face_of.push_back(oracle.FaceOf(t));
  }
  r.bytes = bits.TakeSegment();
  return r;
}

Complex Replay(const Recording& r, const ConnectivitySettings& settings) {
  SplitCoder coder(settings);
  BitDecoder bits;
  bits.StartSegment(r.bytes);
  Complex complex;
  complex.AddVertex();
  std::vector<Int3> positions{{}};
  // The root's own position is in no context: it has no neighbours.
  SplitMeters meters;
  uint64_t exceptions = 0;
  for (const auto& split : r.splits) {
    coder.Code(bits, complex, positions, split.vertex, split.known, nullptr, &meters, &exceptions);
    positions[split.vertex] = split.known.first;
    positions.push_back(split.known.second);
  }
  return complex;
}

void ExpectSameComplex(const Complex& a, const Complex& b) {
  ASSERT_EQ(a.vertex_count(), b.vertex_count());
  ASSERT_EQ(a.edge_count(), b.edge_count());
  ASSERT_EQ(a.face_count(), b.face_count());
  for (uint32_t e = 0; e < a.edge_count(); ++e) ASSERT_EQ(a.edge(e), b.edge(e));
  for (uint32_t f = 0; f < a.face_count(); ++f) ASSERT_EQ(a.face(f), b.face(f));
}

constexpr std::array<ConnectivitySettings, 5> kAllSettings{{{true, true, true},
                                                            {true, false, false},
                                                            {false, true, true},
                                                            {false, false, true},
                                                            {false, true, false}}};

TEST(SplitCoder, KeepsTheImagesOfRandomMeshesAtEverySplit) {
  for (uint64_t seed = 0; seed < 400; ++seed) {
    const auto& settings = kAllSettings[seed % kAllSettings.size()];
    const Recording r = Record(RandomMesh(seed), settings, seed);
    ASSERT_FALSE(HasFatalFailure()) << seed;
    ASSERT_NO_FATAL_FAILURE(ExpectSameComplex(Replay(r, settings), r.complex)) << seed;
  }
}

TEST(SplitCoder, KeepsTheImagesOfASheetAtEverySplit) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const auto& settings = kAllSettings[seed % kAllSettings.size()];
    const Recording r = Record(Sheet(6), settings, seed);
    ASSERT_FALSE(HasFatalFailure()) << seed;
    ASSERT_NO_FATAL_FAILURE(ExpectSameComplex(Replay(r, settings), r.complex)) << seed;
  }
}

TEST(SplitOracle, NamesTheFaceOfEveryOriginal) {
  for (uint64_t seed = 0; seed < 100; ++seed) {
    const Recording r = Record(RandomMesh(seed), {}, seed);
    for (size_t t = 0; t < r.final_faces.size(); ++t) {
      Face original = r.final_faces[t];
      std::sort(original.begin(), original.end());
      const bool degenerate = original[0] == original[1] || original[1] == original[2];
      ASSERT_EQ(r.face_of[t] == kNone, degenerate) << seed;
      if (degenerate) continue;
      Face found = r.complex.face(r.face_of[t]);
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, original) << seed;
    }
  }
}

TEST(SplitCoder, TurnsEachFaceAsMostOfItsOriginalsRun) {
  uint32_t against = 0;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const Recording r = Record(RandomMesh(seed), kAllSettings[seed % kAllSettings.size()], seed);
    const FaceCensus census = TakeCensus(r.complex, r.final_faces, r.face_of);
    for (size_t f = 0; f < census.forward.size(); ++f) {
      ASSERT_GE(census.forward[f], std::max(census.backward[f], 1u)) << seed;
      against += census.backward[f];
    }
  }
  EXPECT_GT(against, 0u) << "no mesh has faces of both orientations";
}

TEST(SplitCoder, RandomBytesGiveAComplexOrAnError) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 500; ++round) {
    std::vector<uint8_t> bytes(random() % 100);
    for (auto& byte : bytes) byte = static_cast<uint8_t>(random() & random());
    BitDecoder bits;
    bits.StartSegment(bytes);
    SplitCoder coder(kAllSettings[static_cast<size_t>(round) % kAllSettings.size()]);
    Complex complex;
    complex.AddVertex();
    std::vector<Int3> positions{{}};
    SplitMeters meters;
    uint64_t exceptions = 0;
    try {
      for (int split = 0; split < 40; ++split) {
        auto draw = [&] { return static_cast<int32_t>(random() % 50); };
        SplitCoder::Known known;
        known.first = {draw(), draw(), draw()};
        known.second = {draw(), draw(), draw()};
        const uint32_t vertex = static_cast<uint32_t>(random() % positions.size());
        coder.Code(bits, complex, positions, vertex, known, nullptr, &meters, &exceptions);
        positions[vertex] = known.first;
        positions.push_back(known.second);
        // No edge twice, no face with a corner twice, every face on edges that exist.
        std::set<Edge> edges;
        for (uint32_t e = 0; e < complex.edge_count(); ++e) {
          Edge edge = complex.edge(e);
          std::sort(edge.begin(), edge.end());
          ASSERT_NE(edge[0], edge[1]);
          ASSERT_TRUE(edges.insert(edge).second);
        }
        for (uint32_t f = 0; f < complex.face_count(); ++f) {
          Face face = complex.face(f);
          std::sort(face.begin(), face.end());
          for (Edge e : {Edge{face[0], face[1]}, Edge{face[1], face[2]}, Edge{face[0], face[2]}}) {
            ASSERT_TRUE(edges.contains(e)) << round;
          }
        }
      }
    } catch (const Failure& failure) {
      ASSERT_EQ(failure.error().kind, ErrorKind::kCorrupt);
    }
  }
}

/// Faces as they must come back: rotated to their smallest corner, with their number.
std::map<Face, int> Multiset(const std::vector<Face>& faces) {
  std::map<Face, int> counts;
  for (Face face : faces) {
    Face best = face;
    for (int i = 0; i < 2; ++i) {
      std::rotate(face.begin(), face.begin() + 1, face.end());
      best = std::min(best, face);
    }
    ++counts[best];
  }
  return counts;
}

TEST(FaceExceptions, GiveBackEveryFaceWithItsOrientationAndNumber) {
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const Recording r = Record(seed % 10 == 0 ? Sheet(5) : RandomMesh(seed), {}, seed);
    const FaceCensus census = TakeCensus(r.complex, r.final_faces, r.face_of);
    // As many faces as there are, and not one more, are within the limit.
    FaceExceptions written(r.final_faces.size()), read(r.final_faces.size());
    BitEncoder encoder;
    written.Code(encoder, r.complex, &census);
    const auto bytes = encoder.TakeSegment();
    BitDecoder decoder;
    decoder.StartSegment(bytes);
    read.Code(decoder, r.complex, nullptr);
    std::vector<Face> faces;
    read.AppendFaces(r.complex, &faces);
    EXPECT_EQ(read.FaceCount(r.complex), r.final_faces.size()) << seed;
    ASSERT_EQ(Multiset(faces), Multiset(r.final_faces)) << seed;
    std::vector<Face> own;
    written.AppendFaces(r.complex, &own);
    ASSERT_EQ(own, faces) << seed;
  }
}

TEST(FaceExceptions, RandomBytesGiveFacesOfTheComplexOrAnError) {
  std::mt19937_64 random(8);
  const Recording r = Record(Sheet(4), {}, 1);
  for (int round = 0; round < 1000; ++round) {
    std::vector<uint8_t> bytes(random() % 60);
    for (auto& byte : bytes) byte = static_cast<uint8_t>(random());
    if (round % 2 == 0) bytes.insert(bytes.begin(), 0);  // towards both kinds of exceptions
    BitDecoder decoder;
    decoder.StartSegment(bytes);
    FaceExceptions exceptions(1000);
    try {
      exceptions.Code(decoder, r.complex, nullptr);
    } catch (const Failure& failure) {
      ASSERT_EQ(failure.error().kind, ErrorKind::kCorrupt);
      continue;
    }
    std::vector<Face> faces;
    exceptions.AppendFaces(r.complex, &faces);
    ASSERT_EQ(faces.size(), exceptions.FaceCount(r.complex));
    ASSERT_LE(faces.size(), 1000u);
    for (const Face& face : faces) {
      for (uint32_t vertex : face) ASSERT_LT(vertex, r.complex.vertex_count());
    }
  }
}

}  // namespace
}  // namespace folprom
