// Every format as input and as output: the mesh that comes back is the one that went in.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "parallel/runner.h"
#include "tests/support/bit_mesh.h"
#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/meshes.h"
#include "tests/support/random.h"
#include "tests/support/stl.h"
#include "tests/support/temporary_folder.h"

namespace folprom::support {
namespace {

/// Coincident and isolated vertices, copied and degenerate faces; some coordinates with short
/// decimals, some with all bits that the type has.
BitMesh HardMesh(bool is_float, bool is_short) {
  const Mesh mesh = NonManifoldSoup(400, 700, 3);
  Random random(5);
  BitMesh bits;
  bits.is_float = is_float;
  for (const Point& p : mesh.positions) {
    Bits3 xyz;
    for (size_t i = 0; i < 3; ++i) {
      double value = p[i];
      if (is_short) value = std::round(value * 100) / 100;
      if (random.Below(50) == 0) value = -0.0;
      xyz[i] = is_float ? std::bit_cast<uint32_t>(static_cast<float>(value))
                        : std::bit_cast<uint64_t>(value);
    }
    bits.positions.push_back(xyz);
  }
  bits.faces = mesh.faces;
  return bits;
}

TEST(Format, TextGivesEveryBitOfAnExactMeshBack) {
  for (const bool is_float : {true, false}) {
    for (const bool is_short : {true, false}) {
      const BitMesh mesh = HardMesh(is_float, is_short);
      const TemporaryFolder folder;
      WriteBits(folder.File("scan.ply"), mesh);
      Encode(folder.File("scan.ply"), folder.File("scan.folp"), ExactOptions(100));
      for (const std::string text : {"scan.obj", "scan.off"}) {
        const DecodeReport report = Decode(folder.File("scan.folp"), folder.File(text));
        EXPECT_TRUE(report.complete);
        EXPECT_TRUE(report.warnings.empty());
        DecodeOptions force;
        force.overwrite = true;
        EncodeOptions options = ExactOptions(100);
        options.overwrite = true;
        Encode(folder.File(text), folder.File("again.folp"), options);
        Decode(folder.File("again.folp"), folder.File("again.ply"), force);
        EXPECT_EQ(DifferenceOfBits(mesh, ReadBits(folder.File("again.ply"))), "") << text;
      }
    }
  }
}

TEST(Format, ASoupOfFacetsComesBackAsStl) {
  Random random(8);
  std::vector<Facet> facets;
  for (int f = 0; f < 500; ++f) {
    Facet facet;
    for (auto& corner : facet) {
      for (uint32_t& value : corner) {
        value = std::bit_cast<uint32_t>(static_cast<float>(random.Below(30)) / 7);
      }
    }
    facets.push_back(facet);
    if (f % 10 == 0) facets.push_back(facet);
  }
  const TemporaryFolder folder;
  WriteBytes(folder.File("soup.stl"), StlBytes(facets));
  const EncodeReport encoded =
      Encode(folder.File("soup.stl"), folder.File("soup.folp"), ExactOptions(200));
  EXPECT_EQ(encoded.scan_vertices, 3 * facets.size());
  EXPECT_TRUE(Verify(folder.File("soup.folp"), folder.File("soup.stl")).lossless);
  const DecodeReport decoded = Decode(folder.File("soup.folp"), folder.File("out.stl"));
  EXPECT_EQ(decoded.faces, facets.size());
  EXPECT_EQ(AsSet(FacetsOf(folder.File("out.stl"))), AsSet(facets));
}

TEST(Format, ARegionIsWrittenInEveryFormat) {
  const TemporaryFolder folder;
  WriteBits(folder.File("scan.ply"), HardMesh(true, false));
  Encode(folder.File("scan.ply"), folder.File("scan.folp"), ExactOptions(100));
  DecodeOptions region;
  region.use_region = true;
  for (int i = 0; i < 3; ++i) region.region_hi[i] = 0.5;
  const DecodeReport ply = Decode(folder.File("scan.folp"), folder.File("part.ply"), region);
  const BitMesh expected = ReadBits(folder.File("part.ply"));
  EXPECT_EQ(expected.positions.size(), ply.vertices);
  EXPECT_GT(ply.vertices, 0u);
  for (const std::string text : {"part.obj", "part.off"}) {
    Decode(folder.File("scan.folp"), folder.File(text), region);
    EncodeOptions options = ExactOptions();
    DecodeOptions force;
    options.overwrite = force.overwrite = true;
    Encode(folder.File(text), folder.File("part.folp"), options);
    Decode(folder.File("part.folp"), folder.File("again.ply"), force);
    EXPECT_EQ(DifferenceOfBits(expected, ReadBits(folder.File("again.ply"))), "") << text;
  }
}

class SharedFormat : public ::testing::TestWithParam<const char*> {};

TEST_P(SharedFormat, ComesBackWhole) {
  const std::string scan = SharedFile(GetParam());
  if (scan.empty()) GTEST_SKIP() << kNoSharedData;
  const TemporaryFolder folder;
  const auto runner = parallel::MakeTbbRunner(2);
  // The large one is coded on a lattice, to save time.
  const bool is_large = FileBytes(scan).size() > 1000000;
  if (kSanitized && is_large) GTEST_SKIP() << "too large for a build with sanitizers";
  const EncodeOptions options = is_large ? EncodeOptions() : ExactOptions();
  Encode(scan, folder.File("scan.folp"), options, runner.get());
  const VerifyReport verified = Verify(folder.File("scan.folp"), scan, runner.get());
  EXPECT_TRUE(verified.lossless) << verified.reason;
  if (is_large || !scan.ends_with(".stl")) return;
  Decode(folder.File("scan.folp"), folder.File("out.stl"));
  EXPECT_TRUE(AsSet(FacetsOf(folder.File("out.stl"))) == AsSet(FacetsOf(scan)));
}

INSTANTIATE_TEST_SUITE_P(Hard, SharedFormat,
                         ::testing::Values("hard/box_longline.obj", "hard/chair_model.obj",
                                           "hard/conrod__meshlab.stl", "hard/soup_bunny.stl",
                                           "hard/dangling_edge2.off", "malformed/bad_beetle.off"));

}  // namespace
}  // namespace folprom::support
