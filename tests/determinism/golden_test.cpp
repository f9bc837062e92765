#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <sstream>
#include <string>

#include "io/container/checksum.h"
#include "tests/support/bit_mesh.h"
#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"
#include "tests/support/random.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

/// XXH3 of the files below, in every build and on every machine. A change of the bytes is a change
/// of the format: renew these together with FORMAT.md.
constexpr uint64_t kDefaultHash = 0x5f1d50387e8f09f7;
constexpr uint64_t kPaperHash = 0xf9168d67404e3e07;
constexpr uint64_t kQuadricHash = 0x8b84dba817717eaf;
constexpr uint64_t kExactHash = 0xd84172ebe107b204;
constexpr uint64_t kExactRestsHash = 0x3871dfc5a246aea0;
constexpr uint64_t kOtherHash = 0xc3258aa57680017d;

void ExpectHashOf(const std::string& scan, const char* constant, uint64_t expected,
                  const EncodeOptions& options) {
  TemporaryFolder folder;
  Encode(scan, folder.File("scan.folp"), options);
  uint64_t hash = io::XxHash64(FileBytes(folder.File("scan.folp")));
  std::ostringstream line;
  line << "constexpr uint64_t " << constant << " = 0x" << std::hex << hash << ";";
  EXPECT_EQ(hash, expected) << "the bytes have changed; where that is meant, write\n" << line.str();
}

void ExpectHash(const char* constant, uint64_t expected, const EncodeOptions& options) {
  TemporaryFolder folder;
  // Integers only, so that the mesh itself does not depend on a machine's arithmetic.
  WritePly(folder.File("scan.ply"), IntegerTerrain(90, 70, 1), CoordinateType::kInt);
  ExpectHashOf(folder.File("scan.ply"), constant, expected, options);
}

TEST(GoldenTest, DefaultSettingsGiveTheKnownBytes) { ExpectHash("kDefaultHash", kDefaultHash, {}); }

TEST(GoldenTest, SettingsOfThePaperInSubtreesGiveTheKnownBytes) {
  EncodeOptions options;
  options.bits = 16;
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
  codec.layers_per_octave = codec.rounds_per_layer = 2;
  ExpectHash("kPaperHash", kPaperHash, options);
}

TEST(GoldenTest, QuadricHierarchyInSubtreesGivesTheKnownBytes) {
  EncodeOptions options;
  options.bits = 15;
  options.codec.subtree_vertices = 1500;
  options.codec.hierarchy = Hierarchy::kQuadric;
  options.codec.offsets = Offsets::kLattice;
  ExpectHash("kQuadricHash", kQuadricHash, options);
}

TEST(GoldenTest, ExactIntegersGiveTheKnownBytes) {
  ExpectHash("kExactHash", kExactHash, ExactOptions(1500));
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

TEST(GoldenTest, EverythingOffInSubtreesGivesTheKnownBytes) {
  EncodeOptions options;
  options.bits = 14;
  CodecSettings& codec = options.codec;
  codec.subtree_vertices = 500;
  codec.children = 7;
  codec.normal_metric = codec.adaptive_quantisation = false;
  codec.predict_theta = codec.predict_height = codec.split_first = false;
  codec.pivot_order = codec.nearer_child = false;
  codec.representative = Representative::kCentre;
  codec.distortion_first = 0;
  codec.layers_per_octave = 3;
  codec.rounds_per_layer = 1;
  ExpectHash("kOtherHash", kOtherHash, options);
}

}  // namespace
}  // namespace folprom::support
