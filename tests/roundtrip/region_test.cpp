#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/codec.h"
#include "tests/support/coders.h"
#include "tests/support/files.h"
#include "tests/support/meshes.h"
#include "tests/support/ply.h"
#include "tests/support/same_mesh.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

struct Box {
  std::string name;
  Point lo, hi;
};

bool Inside(const Box& box, const Point& p) {
  for (size_t i = 0; i < 3; ++i) {
    if (p[i] < box.lo[i] || p[i] > box.hi[i]) return false;
  }
  return true;
}

/// The vertices inside, in their order, and the faces with all corners inside.
Mesh PartInside(const Mesh& mesh, const Box& box) {
  Mesh part;
  constexpr uint64_t kOutside = ~uint64_t{0};
  std::vector<uint64_t> index(mesh.positions.size(), kOutside);
  for (size_t v = 0; v < index.size(); ++v) {
    if (!Inside(box, mesh.positions[v])) continue;
    index[v] = part.positions.size();
    part.positions.push_back(mesh.positions[v]);
  }
  for (const Triple& f : mesh.faces) {
    Triple face{index[f[0]], index[f[1]], index[f[2]]};
    if (std::count(face.begin(), face.end(), kOutside) == 0) part.faces.push_back(face);
  }
  return part;
}

class RegionTest : public ::testing::TestWithParam<Coder> {
 protected:
  void Code(const Mesh& mesh, uint32_t subtree_vertices) {
    WritePly(folder_.File("scan.ply"), mesh, CoordinateType::kDouble);
    EncodeOptions options;
    options.codec = GetParam().settings;
    options.codec.subtree_vertices = subtree_vertices;
    subtrees_ = Encode(folder_.File("scan.ply"), folp_, options).subtrees;
  }
  DecodeReport DecodeBox(const Box& box, uint32_t layers) {
    DecodeOptions options;
    options.layers = layers;
    options.overwrite = true;
    options.use_region = true;
    std::copy(box.lo.begin(), box.lo.end(), options.region_lo);
    std::copy(box.hi.begin(), box.hi.end(), options.region_hi);
    return Decode(folp_, out_, options);
  }
  void ExpectPart(const Mesh& lod, const Box& box, uint32_t layers) {
    SCOPED_TRACE(box.name + ", layers " + std::to_string(layers));
    Mesh expected = PartInside(lod, box);
    DecodeReport report = DecodeBox(box, layers);
    EXPECT_EQ(report.vertices, expected.positions.size());
    EXPECT_EQ(report.faces, expected.faces.size());
    EXPECT_EQ(DifferenceInOrder(expected, ReadPly(out_).mesh), "");
    EXPECT_EQ(report.warnings.size(), expected.positions.empty() ? 1u : 0u);  // that it is empty
  }

  TemporaryFolder folder_;
  std::string folp_ = folder_.File("scan.folp"), out_ = folder_.File("out.ply");
  uint64_t subtrees_ = 0;
};

INSTANTIATE_TEST_SUITE_P(Coder, RegionTest, EveryCoder(), NameOfCoder);

std::vector<Box> Boxes() {
  return {{"Everything", {-9, -9, -9}, {9, 9, 9}},
          {"BesideTheMesh", {5, 5, 5}, {6, 6, 6}},
          {"HollowMiddle", {-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}},
          {"OneCorner", {0.3, 0.3, 0.3}, {9, 9, 9}},
          {"AcrossSubtrees", {-0.5, -9, -9}, {0.5, 9, 9}},
          {"ThinSlice", {-9, -9, 0.1}, {9, 9, 0.101}},
          {"SmallPatch", {0.9, -0.2, -0.2}, {1.3, 0.1, 0.1}}};
}

TEST_P(RegionTest, HoldsTheVerticesInsideAndTheFacesBetweenThem) {
  Code(BumpySphere(4000, true, 1), 300);
  ASSERT_GE(subtrees_, 12u);
  Mesh whole = LodOf(folp_);
  for (const Box& box : Boxes()) ExpectPart(whole, box, 0);
}

TEST_P(RegionTest, OfAnLodIsThePartOfThatLod) {
  Code(BumpySphere(4000, true, 2), 300);
  std::vector<Mesh> lods = EveryLod(folp_);
  for (uint32_t layers = 1; layers <= lods.size(); layers += 3) {
    for (const Box& box : Boxes()) ExpectPart(lods[layers - 1], box, layers);
  }
}

TEST_P(RegionTest, OfANonManifoldSoupHoldsItsDegenerateAndRepeatedFaces) {
  Code(NonManifoldSoup(400, 1500, 3), 60);
  Mesh whole = LodOf(folp_);
  for (const Box& box : Boxes()) ExpectPart(whole, box, 0);
}

TEST_P(RegionTest, OfOnePointHoldsTheVertexThere) {
  Code(BumpySphere(1500, false, 4), 200);
  Mesh whole = LodOf(folp_);
  for (size_t v = 0; v < whole.positions.size(); v += 300) {
    ExpectPart(whole, {"Vertex" + std::to_string(v), whole.positions[v], whole.positions[v]}, 0);
  }
}

/// The representative of a coarse LOD can lie outside the box of the vertices it stands for.
TEST_P(RegionTest, OfOnePointHoldsTheLodVertexThere) {
  Code(BumpySphere(1500, true, 7), 200);
  std::vector<Mesh> lods = EveryLod(folp_);
  for (uint32_t layers = 1; layers <= lods.size(); layers += 2) {
    const std::vector<Point>& positions = lods[layers - 1].positions;
    for (size_t v = 0; v < positions.size(); v += 1 + positions.size() / 25) {
      ExpectPart(lods[layers - 1], {"Vertex" + std::to_string(v), positions[v], positions[v]},
                 layers);
    }
  }
}

TEST_P(RegionTest, ReadsOnlyPartOfTheFile) {
  Code(BumpySphere(6000, false, 5), 300);
  Box patch{"Patch", {0.9, -0.2, -0.2}, {1.3, 0.1, 0.1}};
  DecodeReport part = DecodeBox(patch, 0);
  EXPECT_GT(part.vertices, 0u);
  EXPECT_FALSE(part.complete);
  EXPECT_LT(part.bytes_read, FileBytes(folp_).size() / 2);
}

TEST_P(RegionTest, UpsideDownIsRefused) {
  Code(BumpySphere(200, false, 6), 100);
  DecodeOptions options;
  options.use_region = true;
  options.region_lo[1] = 1;
  try {
    Decode(folp_, out_, options);
    FAIL() << "decoded";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().kind, ErrorKind::kUsage);
  }
}

}  // namespace
}  // namespace folprom::support
