#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/codec.h"
#include "tests/support/coders.h"
#include "tests/support/files.h"
#include "tests/support/lod_replay.h"
#include "tests/support/meshes.h"
#include "tests/support/ply.h"
#include "tests/support/same_mesh.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

using Edge = LodReplay::Edge;

template <class T>
std::vector<T> Sorted(std::vector<T> values) {
  std::sort(values.begin(), values.end());
  return values;
}
template <class T>
std::vector<T> SortedDistinct(std::vector<T> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

Triple SmallestRotation(const Triple& f) {
  return std::min({f, Triple{f[1], f[2], f[0]}, Triple{f[2], f[0], f[1]}});
}
Triple SortedCorners(Triple f) {
  std::sort(f.begin(), f.end());
  return f;
}

/// What an LOD must be: the original mesh seen through the sets of its vertices.
struct Image {
  std::vector<Edge> edges;        ///< ascending, each once
  std::vector<Triple> faces;      ///< distinct corners, unordered, ascending, each once
  std::vector<Triple> all_faces;  ///< every face with its orientation, ascending
};

Image ImageOf(const Mesh& original, const std::vector<uint64_t>& representative) {
  Image image;
  for (const Triple& face : original.faces) {
    Triple f{representative[face[0]], representative[face[1]], representative[face[2]]};
    for (size_t i = 0; i < 3; ++i) {
      uint64_t a = f[i], b = f[(i + 1) % 3];
      if (a != b) image.edges.push_back({std::min(a, b), std::max(a, b)});
    }
    if (f[0] != f[1] && f[1] != f[2] && f[0] != f[2]) image.faces.push_back(SortedCorners(f));
    image.all_faces.push_back(SmallestRotation(f));
  }
  image.edges = SortedDistinct(std::move(image.edges));
  image.faces = SortedDistinct(std::move(image.faces));
  image.all_faces = Sorted(std::move(image.all_faces));
  return image;
}

/// A scan coded into a file, and its LODs.
class LodTest : public ::testing::TestWithParam<Coder> {
 protected:
  void Code(const std::string& scan, EncodeOptions options) {
    Encode(scan, folp_, options);
    replay_ = std::make_unique<LodReplay>(scan, folp_);
  }
  void Code(const Mesh& mesh, uint32_t subtree_vertices) {
    Code(mesh, subtree_vertices, GetParam().settings);
  }
  void Code(const Mesh& mesh, uint32_t subtree_vertices, const CodecSettings& settings) {
    original_ = mesh;
    std::string scan = folder_.File("scan.ply");
    WritePly(scan, mesh, CoordinateType::kDouble);
    EncodeOptions options;
    options.codec = settings;
    options.codec.subtree_vertices = subtree_vertices;
    Code(scan, options);
  }

  /// Goes through the layers and checks those that are wanted.
  void ExpectLodsAreImages(const std::function<bool(size_t)>& wanted) {
    for (size_t layer = 0; layer < replay_->layers(); ++layer) {
      SCOPED_TRACE("layer " + std::to_string(layer) + " of " + std::to_string(replay_->layers()));
      replay_->NextLayer();
      if (!wanted(layer)) continue;
      ExpectOneRepresentativeEach();
      ExpectImage(layer);
      ExpectErrorBoundHolds(layer);
      if (HasFailure()) return;
    }
  }
  void ExpectLodsAreImages() {
    ExpectLodsAreImages([](size_t) { return true; });
  }

  void ExpectOneRepresentativeEach() {
    const std::vector<uint64_t>& of = replay_->representatives();
    ASSERT_EQ(of.size(), original_.positions.size());
    std::vector<bool> stands_for_one(replay_->positions().size(), false);
    for (uint64_t vertex : of) {
      ASSERT_LT(vertex, stands_for_one.size());
      stands_for_one[vertex] = true;
    }
    EXPECT_EQ(std::count(stands_for_one.begin(), stands_for_one.end(), false), 0)
        << "LOD vertices without an original";
  }

  void ExpectImage(size_t layer) {
    Image image = ImageOf(original_, replay_->representatives());
    EXPECT_TRUE(Sorted(replay_->edges()) == image.edges)
        << replay_->edges().size() << " edges instead of " << image.edges.size();
    std::vector<Triple> faces;
    bool final_faces = layer + 1 >= replay_->split_layers();
    for (const Triple& f : replay_->faces()) {
      faces.push_back(final_faces ? SmallestRotation(f) : SortedCorners(f));
    }
    EXPECT_TRUE(Sorted(std::move(faces)) == (final_faces ? image.all_faces : image.faces))
        << replay_->faces().size() << " faces instead of "
        << (final_faces ? image.all_faces : image.faces).size();
  }

  void ExpectErrorBoundHolds(size_t layer) {
    double largest = 0;
    for (size_t v = 0; v < original_.positions.size(); ++v) {
      const Point &a = original_.positions[v],
                  &b = replay_->positions()[replay_->representatives()[v]];
      largest = std::max(largest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
    EXPECT_LE(largest, replay_->error_bound(layer));
  }

  TemporaryFolder folder_;
  std::string folp_ = folder_.File("scan.folp");
  Mesh original_;
  std::unique_ptr<LodReplay> replay_;
};

INSTANTIATE_TEST_SUITE_P(Coder, LodTest, EveryCoder(), NameOfCoder);

TEST_P(LodTest, OfASurfaceInManySubtreesIsTheImageOfItsSets) {
  Code(BumpySphere(3000, true, 1), 300);
  EXPECT_GE(replay_->subtrees(), 8u);
  EXPECT_TRUE(replay_->ThreeSubtreesMeet());
  ExpectLodsAreImages();
}

TEST_P(LodTest, OfTinySubtreesIsTheImageOfItsSets) {
  Code(BumpySphere(300, true, 2), 5);
  EXPECT_GE(replay_->subtrees(), 60u);
  EXPECT_TRUE(replay_->ThreeSubtreesMeet());
  ExpectLodsAreImages();
}

TEST_P(LodTest, OfOneSubtreeIsTheImageOfItsSets) {
  Code(BumpySphere(2000, true, 3), 1 << 24);
  EXPECT_EQ(replay_->subtrees(), 1u);
  ExpectLodsAreImages();
}

TEST_P(LodTest, WithLeavesRefinedAtOnceIsTheImageOfItsSets) {
  CodecSettings settings = GetParam().settings;
  settings.split_first = false;
  settings.children = 3;
  Code(BumpySphere(1500, true, 4), 200, settings);
  ExpectLodsAreImages();
}

TEST_P(LodTest, OfARangeGridIsTheImageOfItsSets) {
  Code(RangeGrid(60, 40, 1), 900);
  EXPECT_GE(replay_->subtrees(), 3u);
  ExpectLodsAreImages();
}

TEST_P(LodTest, OfDenseRandomFacesIsTheImageOfItsSets) {
  Code(RandomFaces(60, 2000, 5), 10);
  EXPECT_GE(replay_->subtrees(), 6u);
  EXPECT_TRUE(replay_->ThreeSubtreesMeet());
  ExpectLodsAreImages();
}

TEST_P(LodTest, OfANonManifoldSoupIsTheImageOfItsSets) {
  Code(NonManifoldSoup(300, 600, 6), 40);
  EXPECT_GE(replay_->subtrees(), 8u);
  ExpectLodsAreImages();
}

TEST_P(LodTest, OfDegenerateFacesAcrossSubtreesIsTheImageOfItsSets) {
  Mesh mesh = RandomFaces(80, 0, 7);
  for (uint64_t v = 0; v < 80; ++v) {
    mesh.faces.push_back({v, (v + 1) % 80, v});
    mesh.faces.push_back({v, (v + 7) % 80, (v + 7) % 80});
  }
  Code(mesh, 9);
  EXPECT_GE(replay_->subtrees(), 9u);
  ExpectLodsAreImages();
}

TEST_P(LodTest, OfAScanIsTheImageOfItsSets) {
  std::string scan = SharedFile("hard/dragon_vrip_res2.ply");
  if (scan.empty()) GTEST_SKIP() << kNoSharedData;
  if (kSanitized) GTEST_SKIP() << "too large for a build with sanitizers";
  original_ = ReadPly(scan).mesh;
  EncodeOptions options;
  options.codec = GetParam().settings;
  options.codec.subtree_vertices = 20000;
  Code(scan, options);
  size_t last_split = replay_->split_layers() - 1;
  ExpectLodsAreImages([&](size_t layer) {
    return layer % 5 == 0 || layer + 1 == last_split || layer == last_split ||
           layer + 1 == replay_->layers();
  });
}

TEST_P(LodTest, OfTheWholeProgramIsThatOfTheDecoderInMemory) {
  Code(BumpySphere(2500, true, 8), 300);
  std::vector<Mesh> lods = EveryLod(folp_);
  ASSERT_EQ(lods.size(), replay_->layers());
  for (size_t layer = 0; layer < lods.size(); ++layer) {
    SCOPED_TRACE("layer " + std::to_string(layer));
    DecodeOptions options;
    options.layers = static_cast<uint32_t>(layer + 1);
    options.overwrite = true;
    DecodeReport report = Decode(folp_, folder_.File("out.ply"), options);
    EXPECT_EQ(report.layers, layer + 1);
    EXPECT_EQ(report.error_bound, replay_->error_bound(layer));
    PlyContent written = ReadPly(folder_.File("out.ply"));
    EXPECT_EQ(written.coordinate_type, "double");
    EXPECT_EQ(DifferenceInOrder(lods[layer], written.mesh), "");
    replay_->NextLayer();
    EXPECT_EQ(DifferenceInOrder(lods[layer], {replay_->positions(), replay_->faces()}), "");
  }
}

}  // namespace
}  // namespace folprom::support
