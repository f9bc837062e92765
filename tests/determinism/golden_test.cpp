#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>

#include "io/container/checksum.h"
#include "tests/support/attribute_ply.h"
#include "tests/support/bit_mesh.h"
#include "tests/support/codec.h"
#include "tests/support/coders.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"
#include "tests/support/random.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

/// XXH3 of the files below, in every build and on every machine. A change of the bytes is a change
/// of the format: renew these together with FORMAT.md.
constexpr uint64_t kDefaultHash = 0xa7cbad5e4248d2cd;
constexpr uint64_t kPaperHash = 0x4007143afbaf70a6;
constexpr uint64_t kSubtreesHash = 0xca25564209b5b16b;
constexpr uint64_t kRangeHash = 0x8d00ad241020073e;
constexpr uint64_t kLeastEffortHash = 0x4a5cd71a2bcced09;
constexpr uint64_t kMostEffortHash = 0x3385b59eb52622df;
constexpr uint64_t kVoxelHash = 0xa1e87e0c938eb07f;
constexpr uint64_t kExactVoxelHash = 0x5bb89a280ad8dcd9;
constexpr uint64_t kSubdividedHash = 0x8721c905a4f9f0b9;
constexpr uint64_t kExactHash = 0x8be4490e1f69afbc;
constexpr uint64_t kExactRestsHash = 0xefed8baf9941e150;
constexpr uint64_t kOtherHash = 0x635e8f099bed4acb;
constexpr uint64_t kSoupHash = 0xa9efba3f85e0ab05;
constexpr uint64_t kAttributesHash = 0xb3b6bddf16c0fd6c;

void ExpectHashOf(const std::string& scan, const char* constant, uint64_t expected,
                  const EncodeOptions& options) {
  TemporaryFolder folder;
  Encode(scan, folder.File("scan.folp"), options);
  uint64_t hash = io::XxHash64(FileBytes(folder.File("scan.folp")));
  std::ostringstream line;
  line << "constexpr uint64_t " << constant << " = 0x" << std::hex << hash << ";";
  EXPECT_EQ(hash, expected) << "the bytes have changed; where that is meant, write\n" << line.str();
}

void ExpectHash(const char* constant, uint64_t expected, const EncodeOptions& options,
                const Mesh& mesh = IntegerTerrain(90, 70, 1)) {
  TemporaryFolder folder;
  // Integers only, so that the mesh itself does not depend on a machine's arithmetic.
  WritePly(folder.File("scan.ply"), mesh, CoordinateType::kInt);
  ExpectHashOf(folder.File("scan.ply"), constant, expected, options);
}

TEST(GoldenTest, DefaultSettingsGiveTheKnownBytes) { ExpectHash("kDefaultHash", kDefaultHash, {}); }

TEST(GoldenTest, SettingsOfThePaperInSubtreesGiveTheKnownBytes) {
  EncodeOptions options;
  options.bits = 16;
  options.codec = LloydSettings();
  CodecSettings& codec = options.codec;
  codec.subtree_vertices = 700;
  codec.children = 4;
  codec.normal_metric = true;
  codec.metric_a = 1;
  codec.metric_b = 8;
  codec.lloyd_iterations = 12;
  codec.lloyd_threshold = 0.01;
  codec.representative = Representative::kCurvature;
  codec.curvature_threshold = 0.1;
  codec.gaussian_ratio = 3;
  codec.quantisation_levels = 32;
  codec.distortion_first = 0.1;
  codec.adaptive_quantisation = codec.predict_theta = codec.predict_height = true;
  codec.split_first = codec.pivot_order = codec.nearer_child = true;
  codec.steps_per_octave = codec.rounds_per_step = 2;
  ExpectHash("kPaperHash", kPaperHash, options);
}

TEST(GoldenTest, DefaultSettingsInSubtreesGiveTheKnownBytes) {
  EncodeOptions options;
  options.bits = 15;
  options.codec.subtree_vertices = 1500;
  ExpectHash("kSubtreesHash", kSubtreesHash, options);
}

TEST(GoldenTest, RangeGridsInSubtreesGiveTheKnownBytes) {
  EncodeOptions options;
  options.bits = 15;
  options.codec.subtree_vertices = 2500;
  ExpectHash("kRangeHash", kRangeHash, options, RangeGrid(90, 70, 1));
}

TEST(GoldenTest, SurfacesOfVoxelsInSubtreesGiveTheKnownBytes) {
  const Mesh mesh = VoxelTerrain(90, 70, 1);
  EncodeOptions options;
  options.bits = 14;
  options.codec.subtree_vertices = 2500;
  ExpectHash("kVoxelHash", kVoxelHash, options, mesh);
  ExpectHash("kExactVoxelHash", kExactVoxelHash, ExactOptions(2500), mesh);
}

TEST(GoldenTest, SubdividedSurfacesInSubtreesGiveTheKnownBytes) {
  EncodeOptions options;
  options.bits = 14;
  options.codec.subtree_vertices = 2500;
  ExpectHash("kSubdividedHash", kSubdividedHash, options, SubdividedTerrain(45, 35, 1));
}

TEST(GoldenTest, LeastAndMostEffortInSubtreesGiveTheKnownBytes) {
  EncodeOptions options;
  options.bits = 15;
  options.codec = WithEffort(options.codec, 1);
  options.codec.subtree_vertices = 1500;
  ExpectHash("kLeastEffortHash", kLeastEffortHash, options);
  options.codec = WithEffort(options.codec, 9);
  options.codec.subtree_vertices = 3000;
  ExpectHash("kMostEffortHash", kMostEffortHash, options);
}

TEST(GoldenTest, ExactIntegersGiveTheKnownBytes) {
  ExpectHash("kExactHash", kExactHash, ExactOptions(1500));
}

TEST(GoldenTest, ASoupInOrderGivesTheKnownBytes) {
  TemporaryFolder folder;
  const Mesh terrain = IntegerTerrain(40, 30, 3);
  Mesh soup;
  for (const Triple& face : terrain.faces) {
    const uint64_t first = soup.positions.size();
    soup.faces.push_back({first, first + 1, first + 2});
    for (const uint64_t corner : face) soup.positions.push_back(terrain.positions[corner]);
  }
  WritePly(folder.File("scan.ply"), soup, CoordinateType::kInt);
  EncodeOptions options = ExactOptions(500);
  options.keep_order = true;
  ExpectHashOf(folder.File("scan.ply"), "kSoupHash", kSoupHash, options);
}

TEST(GoldenTest, ExactCoordinatesOffAnyLatticeGiveTheKnownBytes) {
  TemporaryFolder folder;
  BitMesh mesh{false, {}, IntegerTerrain(40, 30, 2).faces};
  Random random(1);
  for (const Point& p : IntegerTerrain(40, 30, 2).positions) {
    Bits3 bits;
    for (size_t axis = 0; axis < 3; ++axis) {
      // Sixteen bits of noise at the end of each double.
      bits[axis] = std::bit_cast<uint64_t>(p[axis]) | random.Below(1 << 16);
    }
    mesh.positions.push_back(bits);
  }
  WriteBits(folder.File("scan.ply"), mesh);
  ExpectHashOf(folder.File("scan.ply"), "kExactRestsHash", kExactRestsHash, ExactOptions(400));
}

TEST(GoldenTest, AttributesInSubtreesGiveTheKnownBytes) {
  TemporaryFolder folder;
  AttributeMesh content{IntegerTerrain(60, 50, 3), 1, {"comment of the scanner"}};
  content.mesh.attributes = Colours(content.mesh, 3);
  for (DecodedAttribute& other : EveryType(content.mesh, 3)) {
    content.mesh.attributes.push_back(std::move(other));
  }
  WriteAttributes(folder.File("scan.ply"), content);
  EncodeOptions options;
  options.codec.subtree_vertices = 900;
  ExpectHashOf(folder.File("scan.ply"), "kAttributesHash", kAttributesHash, options);
}

TEST(GoldenTest, EverythingOffInSubtreesGivesTheKnownBytes) {
  EncodeOptions options;
  options.bits = 14;
  options.codec = LloydSettings();
  CodecSettings& codec = options.codec;
  codec.subtree_vertices = 500;
  codec.children = 7;
  codec.normal_metric = codec.adaptive_quantisation = false;
  codec.predict_theta = codec.predict_height = codec.split_first = false;
  codec.pivot_order = codec.nearer_child = false;
  codec.representative = Representative::kCentre;
  codec.distortion_first = 0;
  codec.steps_per_octave = 3;
  codec.rounds_per_step = 1;
  ExpectHash("kOtherHash", kOtherHash, options);
}

}  // namespace
}  // namespace folprom::support
