// Soups: coded as the mesh that they are welded to, and whole again when they are decoded.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "parallel/runner.h"
#include "tests/support/bit_mesh.h"
#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"
#include "tests/support/random.h"
#include "tests/support/stl.h"
#include "tests/support/surfaces.h"
#include "tests/support/temporary_folder.h"

namespace folprom::support {
namespace {

Corner CornerOf(const Point& p) {
  Corner corner;
  for (size_t i = 0; i < 3; ++i) corner[i] = std::bit_cast<uint32_t>(static_cast<float>(p[i]));
  return corner;
}

/// The facets of a mesh, some of them twice, or turned, or with a corner twice or thrice.
std::vector<Facet> FacetsOfMesh(const Mesh& mesh) {
  std::vector<Facet> facets;
  for (const Triple& face : mesh.faces) {
    Facet facet;
    for (size_t i = 0; i < 3; ++i) facet[i] = CornerOf(mesh.positions[face[i]]);
    facets.push_back(facet);
    if (facets.size() % 40 == 0) facets.push_back(facet);
    if (facets.size() % 41 == 0) facets.push_back({facet[2], facet[1], facet[0]});
    if (facets.size() % 42 == 0) facets.push_back({facet[0], facet[1], facet[0]});
    if (facets.size() % 43 == 0) facets.push_back({facet[0], facet[0], facet[0]});
  }
  return facets;
}

/// Corners that only their bits tell apart.
std::vector<Facet> FacetsOfZeros() {
  const uint32_t minus = std::bit_cast<uint32_t>(-0.0F), one = std::bit_cast<uint32_t>(1.0F);
  return {{Corner{0, 0, 0}, Corner{one, 0, 0}, Corner{0, one, 0}},
          {Corner{minus, 0, 0}, Corner{one, 0, 0}, Corner{0, one, 0}},
          {Corner{0, minus, 0}, Corner{0, 0, 0}, Corner{minus, minus, minus}},
          {Corner{minus, 0, 0}, Corner{one, minus, 0}, Corner{0, one, 0}}};
}

std::string StlText(const std::vector<Facet>& facets) {
  std::string text = "solid a\n";
  for (const Facet& facet : facets) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const Corner& corner : facet) {
      text += "vertex";
      for (const uint32_t bits : corner) {
        char number[64];
        std::snprintf(number, sizeof number, " %.9g",
                      static_cast<double>(std::bit_cast<float>(bits)));
        text += number;
      }
      text += "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid a\n";
}

size_t DifferentCorners(const std::vector<Facet>& facets) {
  std::vector<Corner> corners;
  for (const Facet& facet : facets) corners.insert(corners.end(), facet.begin(), facet.end());
  std::ranges::sort(corners);
  return static_cast<size_t>(std::ranges::unique(corners).begin() - corners.begin());
}

EncodeOptions Exact(bool keep_order = false) {
  EncodeOptions options = ExactOptions(300);
  options.keep_order = keep_order;
  return options;
}

class Soup : public ::testing::Test {
 protected:
  Soup() : facets_(FacetsOfMesh(IntegerTerrain(40, 30, 5))) {
    WriteBytes(scan_, StlBytes(facets_));
  }
  /// The facets of the mesh that a decoder in memory gives.
  std::vector<Facet> FacetsInMemory() const {
    const Mesh mesh = LodOf(folp_);
    EXPECT_EQ(mesh.positions.size(), 3 * mesh.faces.size());
    std::vector<Facet> facets;
    uint64_t next = 0;
    for (const Triple& face : mesh.faces) {
      Facet& facet = facets.emplace_back();
      for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(face[i], next++);
        facet[i] = CornerOf(mesh.positions[face[i]]);
      }
    }
    return facets;
  }

  TemporaryFolder folder_;
  std::string scan_ = folder_.File("soup.stl"), folp_ = folder_.File("soup.folp"),
              back_ = folder_.File("back.stl");
  std::vector<Facet> facets_;
};

TEST_F(Soup, ComesBackAsASoupAndIsCodedAsTheMeshThatItIsWeldedTo) {
  const EncodeReport encoded = Encode(scan_, folp_, Exact());
  EXPECT_TRUE(encoded.is_soup);
  EXPECT_EQ(encoded.scan_vertices, 3 * facets_.size());
  EXPECT_EQ(encoded.vertices, DifferentCorners(facets_));
  EXPECT_GT(encoded.subtrees, 1u);
  const DecodeReport decoded = Decode(folp_, back_);
  EXPECT_EQ(decoded.vertices, 3 * facets_.size());
  EXPECT_EQ(decoded.faces, facets_.size());
  EXPECT_TRUE(decoded.warnings.empty()) << decoded.warnings.front();
  EXPECT_EQ(AsSet(FacetsOf(back_)), AsSet(facets_));
  EXPECT_EQ(AsSet(FacetsInMemory()), AsSet(facets_));
  EXPECT_TRUE(Verify(folp_, "").lossless);
  const VerifyReport verified = Verify(folp_, scan_);
  EXPECT_TRUE(verified.lossless) << verified.reason;
  EXPECT_FALSE(verified.welded);
  const FileInfo info = ReadInfo(folp_).value();
  EXPECT_TRUE(info.is_soup);
  EXPECT_EQ(info.vertices, encoded.vertices);
  EXPECT_EQ(info.faces, facets_.size());
}

TEST_F(Soup, InOrderComesBackFacetByFacetAndCornerByCorner) {
  Encode(scan_, folp_, Exact(true));
  Decode(folp_, back_);
  EXPECT_EQ(FacetsOf(back_), facets_);
  EXPECT_EQ(FacetsInMemory(), facets_);
  EXPECT_TRUE(LodOf(folp_).has_scan_order);
  EXPECT_TRUE(Verify(folp_, "").lossless);
  const VerifyReport verified = Verify(folp_, scan_);
  EXPECT_TRUE(verified.lossless) << verified.reason;
  EXPECT_TRUE(verified.order_kept);
}

TEST_F(Soup, OfTextComesBackToo) {
  WriteBytes(folder_.File("text.stl"), StlText(facets_));
  for (const bool keep_order : {false, true}) {
    EncodeOptions options = Exact(keep_order);
    options.overwrite = true;
    DecodeOptions force;
    force.overwrite = true;
    Encode(folder_.File("text.stl"), folp_, options);
    EXPECT_TRUE(Verify(folp_, folder_.File("text.stl")).lossless);
    Decode(folp_, back_, force);
    EXPECT_EQ(AsSet(FacetsOf(back_)), AsSet(facets_));
  }
  EXPECT_EQ(FacetsOf(back_), facets_);
}

TEST_F(Soup, TellsZerosOfBothSignsAndNumbersThatAreNoneApart) {
  std::vector<Facet> facets = FacetsOfZeros();
  const uint32_t infinity = std::bit_cast<uint32_t>(std::numeric_limits<float>::infinity());
  facets.push_back({Corner{0x7fc00001, 0, 0}, Corner{0xffc00001, 0, 0}, Corner{0x7f800001, 0, 0}});
  facets.push_back({Corner{0x7fc00001, 0, 0}, Corner{infinity, 0, 0}, Corner{0, 0, 0}});
  WriteBytes(scan_, StlBytes(facets));
  EXPECT_EQ(Encode(scan_, folp_, Exact(true)).vertices, DifferentCorners(facets));
  Decode(folp_, back_);
  EXPECT_EQ(FacetsOf(back_), facets);
  EXPECT_TRUE(Verify(folp_, scan_).lossless);
}

TEST_F(Soup, RoundedLiesWithinTheTolerance) {
  for (const bool keep_order : {false, true}) {
    EncodeOptions options = Exact(keep_order);
    options.exact = false;
    options.bits = 9;
    options.overwrite = true;
    Encode(scan_, folp_, options);
    const VerifyReport verified = Verify(folp_, scan_);
    EXPECT_TRUE(verified.lossless) << verified.reason;
    EXPECT_GT(verified.max_position_error, 0);
    EXPECT_TRUE(Verify(folp_, "").lossless);
  }
}

TEST_F(Soup, IsToldFromAnotherOne) {
  for (const bool keep_order : {false, true}) {
    EncodeOptions options = Exact(keep_order);
    options.overwrite = true;
    Encode(scan_, folp_, options);
    std::vector<Facet> others = facets_;
    others[7][1][2] ^= 1;
    WriteBytes(folder_.File("other.stl"), StlBytes(others));
    EXPECT_FALSE(Verify(folp_, folder_.File("other.stl")).lossless);
    others = facets_;
    std::swap(others[3], others[4]);
    WriteBytes(folder_.File("other.stl"), StlBytes(others));
    EXPECT_EQ(Verify(folp_, folder_.File("other.stl")).lossless, !keep_order);
    others.pop_back();
    WriteBytes(folder_.File("other.stl"), StlBytes(others));
    EXPECT_FALSE(Verify(folp_, folder_.File("other.stl")).lossless);
    WritePly(folder_.File("mesh.ply"), IntegerTerrain(40, 30, 5), CoordinateType::kFloat);
    EXPECT_FALSE(Verify(folp_, folder_.File("mesh.ply")).lossless);
  }
}

TEST_F(Soup, WeldedIsASurface) {
  EncodeOptions options = Exact();
  options.weld = true;
  const EncodeReport encoded = Encode(scan_, folp_, options);
  EXPECT_FALSE(encoded.is_soup);
  EXPECT_EQ(encoded.vertices, DifferentCorners(facets_));
  EXPECT_EQ(Decode(folp_, folder_.File("back.ply")).vertices, encoded.vertices);
  const BitMesh mesh = ReadBits(folder_.File("back.ply"));
  EXPECT_EQ(mesh.positions.size(), DifferentCorners(facets_));
  EXPECT_FALSE(ReadInfo(folp_).value().is_soup);
  const VerifyReport verified = Verify(folp_, scan_);
  EXPECT_TRUE(verified.lossless) << verified.reason;
  EXPECT_TRUE(verified.welded);
  // As a soup again it is the one that it was.
  EXPECT_FALSE(Decode(folp_, back_).warnings.empty());
  EXPECT_EQ(AsSet(FacetsOf(back_)), AsSet(facets_));
}

TEST_F(Soup, WeldedInOrderHasItsVerticesAsTheyFirstCome) {
  EncodeOptions options = Exact(true);
  options.weld = true;
  Encode(scan_, folp_, options);
  Decode(folp_, folder_.File("back.ply"));
  const BitMesh mesh = ReadBits(folder_.File("back.ply"));
  uint64_t next = 0;
  ASSERT_EQ(mesh.faces.size(), facets_.size());
  for (size_t f = 0; f < facets_.size(); ++f) {
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_LE(mesh.faces[f][i], next);
      next = std::max(next, mesh.faces[f][i] + 1);
      const Bits3& bits = mesh.positions[mesh.faces[f][i]];
      for (size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(bits[axis], facets_[f][i][axis]);
    }
  }
  EXPECT_TRUE(Verify(folp_, scan_).lossless);
}

TEST_F(Soup, InAnyFormatIsOne) {
  Encode(scan_, folp_, Exact(true));
  for (const std::string name : {"back.ply", "back.obj", "back.off"}) {
    Decode(folp_, folder_.File(name));
    EncodeOptions options = Exact(true);
    options.overwrite = true;
    EXPECT_TRUE(Verify(folp_, folder_.File(name)).lossless) << name;
    const EncodeReport again = Encode(folder_.File(name), folder_.File("again.folp"), options);
    EXPECT_TRUE(again.is_soup) << name;
    EXPECT_TRUE(FileBytes(folder_.File("again.folp")) == FileBytes(folp_)) << name;
  }
}

TEST_F(Soup, HasTheSameBytesForAnyThreadsAndMemory) {
  for (const bool keep_order : {false, true}) {
    EncodeOptions options = Exact(keep_order);
    options.overwrite = true;
    Encode(scan_, folp_, options);
    const auto tbb = parallel::MakeTbbRunner(3);
    const auto shuffled = parallel::MakeShuffledRunner(4);
    EncodeOptions little = options;
    little.limits.memory_bytes = uint64_t{1} << 18;  // many buckets
    Encode(scan_, folder_.File("2.folp"), little, tbb.get());
    Encode(scan_, folder_.File("3.folp"), options, shuffled.get());
    EXPECT_TRUE(FileBytes(folp_) == FileBytes(folder_.File("2.folp")));
    EXPECT_TRUE(FileBytes(folp_) == FileBytes(folder_.File("3.folp")));
    EXPECT_TRUE(Verify(folp_, scan_, tbb.get()).lossless);
    DecodeOptions decode;
    decode.overwrite = true;
    Decode(folp_, back_, decode);
    decode.limits.memory_bytes = uint64_t{1} << 20;
    Decode(folp_, folder_.File("2.stl"), decode, tbb.get());
    EXPECT_TRUE(FileBytes(back_) == FileBytes(folder_.File("2.stl")));
  }
}

TEST_F(Soup, HasLevelsOfDetailThatAreMeshes) {
  Encode(scan_, folp_, Exact());
  const size_t layers = EveryLod(folp_).size();
  ASSERT_GT(layers, 3u);
  const Mesh lod = LodOf(folp_, layers / 2);
  EXPECT_LT(lod.positions.size(), 3 * lod.faces.size());
  DecodeOptions options;
  options.layers = static_cast<uint32_t>(layers / 2);
  const DecodeReport report = Decode(folp_, folder_.File("lod.ply"), options);
  EXPECT_FALSE(report.complete);
  EXPECT_EQ(report.vertices, lod.positions.size());
  EXPECT_EQ(ReadPly(folder_.File("lod.ply")).mesh.faces.size(), lod.faces.size());
}

TEST_F(Soup, HasRegionsThatAreMeshes) {
  Encode(scan_, folp_, Exact());
  DecodeOptions options;
  options.use_region = true;
  for (int i = 0; i < 3; ++i) {
    options.region_lo[i] = -1e9;
    options.region_hi[i] = 1e9;
  }
  const DecodeReport whole = Decode(folp_, folder_.File("whole.ply"), options);
  EXPECT_EQ(whole.vertices, DifferentCorners(facets_));
  EXPECT_EQ(whole.faces, facets_.size());
  Decode(folp_, back_, options);
  EXPECT_EQ(AsSet(FacetsOf(back_)), AsSet(facets_));
}

TEST_F(Soup, TakesLittleMoreThanItsMesh) {
  EncodeOptions options = Exact();
  const uint64_t soup = Encode(scan_, folp_, options).bytes;
  options.weld = true;
  options.overwrite = true;
  EXPECT_EQ(Encode(scan_, folp_, options).bytes, soup);
  EncodeOptions in_order = Exact(true);
  in_order.overwrite = true;
  const uint64_t ordered = Encode(scan_, folp_, in_order).bytes;
  in_order.weld = true;
  // That of the vertices costs nothing.
  EXPECT_LT(static_cast<double>(ordered),
            1.02 * static_cast<double>(Encode(scan_, folp_, in_order).bytes));
}

TEST(SoupOfAttributes, IsNoneAndIsNotWelded) {
  const TemporaryFolder folder;
  WriteBytes(folder.File("scan.ply"),
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
             "property float z\nproperty uchar red\nelement face 1\n"
             "property list uchar int vertex_indices\nend_header\n"
             "0 0 0 1\n1 0 0 2\n0 0 0 3\n3 0 1 2\n");
  EncodeOptions options = Exact();
  const EncodeReport kept = Encode(folder.File("scan.ply"), folder.File("scan.folp"), options);
  EXPECT_FALSE(kept.is_soup);
  EXPECT_EQ(kept.vertices, 3u);
  EXPECT_TRUE(Verify(folder.File("scan.folp"), folder.File("scan.ply")).lossless);
  options.weld = options.overwrite = true;
  try {
    Encode(folder.File("scan.ply"), folder.File("scan.folp"), options);
    FAIL() << "the colours differ";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().kind, ErrorKind::kInput);
    EXPECT_NE(failure.error().message.find("attributes"), std::string::npos);
  }
  options.attributes = false;
  EXPECT_EQ(Encode(folder.File("scan.ply"), folder.File("scan.folp"), options).vertices, 2u);
}

TEST(Weld, JoinsTheVerticesOfAnyMesh) {
  const TemporaryFolder folder;
  Mesh mesh = IntegerTerrain(20, 20, 3);
  const uint64_t vertices = mesh.positions.size();
  mesh.positions.insert(mesh.positions.end(), mesh.positions.begin(), mesh.positions.begin() + 50);
  for (size_t f = 0; f < mesh.faces.size(); f += 2) {
    for (uint64_t& vertex : mesh.faces[f]) vertex += vertex < 50 ? vertices : 0;
  }
  WritePly(folder.File("scan.ply"), mesh, CoordinateType::kFloat);
  EncodeOptions options = Exact();
  EXPECT_EQ(Encode(folder.File("scan.ply"), folder.File("a.folp"), options).vertices,
            vertices + 50);
  options.weld = true;
  EXPECT_EQ(Encode(folder.File("scan.ply"), folder.File("b.folp"), options).vertices, vertices);
  EXPECT_TRUE(Verify(folder.File("b.folp"), folder.File("scan.ply")).lossless);
  WritePly(folder.File("none.ply"), Mesh(), CoordinateType::kFloat);
  EXPECT_EQ(Encode(folder.File("none.ply"), folder.File("c.folp"), options).vertices, 0u);
}

TEST(SharedSoup, InOrderIsAtMostAQuarterLargerThanItsMesh) {
  const std::string scan = SharedFile("hard/soup_bunny.stl");
  if (scan.empty()) GTEST_SKIP() << kNoSharedData;
  if (kSanitized) GTEST_SKIP() << "too large for a build with sanitizers";
  const TemporaryFolder folder;
  const auto runner = parallel::MakeTbbRunner(2);
  EncodeOptions options;
  options.exact = true;
  options.weld = true;
  Encode(scan, folder.File("weld.folp"), options, runner.get());
  Decode(folder.File("weld.folp"), folder.File("mesh.ply"), {}, runner.get());
  options.weld = false;
  options.keep_order = true;
  const uint64_t mesh =
      Encode(folder.File("mesh.ply"), folder.File("mesh.folp"), options, runner.get()).bytes;
  const uint64_t soup = Encode(scan, folder.File("soup.folp"), options, runner.get()).bytes;
  EXPECT_LT(static_cast<double>(soup), 1.25 * static_cast<double>(mesh));
}

}  // namespace
}  // namespace folprom::support
