#include <gtest/gtest.h>

#include <string>

#include "tests/support/codec.h"
#include "tests/support/coders.h"
#include "tests/support/files.h"
#include "tests/support/meshes.h"
#include "tests/support/ply.h"
#include "tests/support/same_mesh.h"

namespace folprom::support {
namespace {

/// Encodes, decodes at every layer count from memory and at every `file_step`-th from the file, and
/// verifies.
void ExpectGoodAtEveryLod(const std::string& scan, const TemporaryFolder& folder,
                          const EncodeOptions& options, uint32_t file_step) {
  std::string folp = folder.File("dense.folp"), out = folder.File("out.ply");
  EncodeReport encoded = Encode(scan, folp, options);
  std::vector<uint8_t> bytes = FileBytes(folp);
  MemoryDecoder decoder = MemoryDecoder::Open(bytes).value();
  for (uint32_t layers = 1; layers <= encoded.layers; ++layers) {
    SCOPED_TRACE(std::to_string(layers) + " layers");
    decoder.DecodeNextLayer().value();
    Mesh lod = decoder.Mesh();
    EXPECT_LE(lod.faces.size(), encoded.faces);
    if (layers % file_step != 0) continue;
    DecodeOptions decode;
    decode.layers = layers;
    decode.overwrite = true;
    DecodeReport report = Decode(folp, out, decode);
    EXPECT_EQ(report.vertices, lod.positions.size());
    EXPECT_EQ(report.faces, lod.faces.size());
  }
  VerifyReport by_digest = Verify(folp, "");
  EXPECT_TRUE(by_digest.lossless) << by_digest.reason;
  VerifyReport by_scan = Verify(folp, scan);
  EXPECT_TRUE(by_scan.lossless) << by_scan.reason;
}

class DenseTest : public ::testing::TestWithParam<Coder> {
 protected:
  static EncodeOptions Options() {
    EncodeOptions options;
    options.codec = GetParam().settings;
    return options;
  }
};
INSTANTIATE_TEST_SUITE_P(Coder, DenseTest, EveryCoder(), NameOfCoder);

TEST_P(DenseTest, RandomFacesByTheHundredThousandAreCodedAtEveryLod) {
  TemporaryFolder folder;
  Mesh mesh = RandomFaces(1500, kSanitized ? 20000 : 200000, 1);
  WritePly(folder.File("scan.ply"), mesh, CoordinateType::kDouble);
  EncodeOptions options = Options();
  options.bits = 16;
  ExpectGoodAtEveryLod(folder.File("scan.ply"), folder, options, 8);
  EXPECT_EQ(DifferenceOf(mesh, LodOf(folder.File("dense.folp")),
                         Verify(folder.File("dense.folp"), "").tolerance),
            "");
}

TEST_P(DenseTest, RandomFacesAcrossSubtreesAreCodedAtEveryLod) {
  TemporaryFolder folder;
  Mesh mesh = RandomFaces(1500, kSanitized ? 4000 : 40000, 2);
  WritePly(folder.File("scan.ply"), mesh, CoordinateType::kDouble);
  EncodeOptions options = Options();
  options.bits = 16;
  options.codec.subtree_vertices = 200;
  ExpectGoodAtEveryLod(folder.File("scan.ply"), folder, options, 4);
  EXPECT_EQ(DifferenceOf(mesh, LodOf(folder.File("dense.folp")),
                         Verify(folder.File("dense.folp"), "").tolerance),
            "");
}

TEST_P(DenseTest, ScanWithThirtyThousandNonManifoldEdgesIsCodedAtEveryLod) {
  std::string scan = SharedFile("hard/abominevole.ply");
  if (scan.empty()) GTEST_SKIP() << kNoSharedData;
  TemporaryFolder folder;
  ExpectGoodAtEveryLod(scan, folder, Options(), 1);
}

}  // namespace
}  // namespace folprom::support
