// What `encode --exact` promises: every bit of every coordinate.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "folprom/float_bits.h"
#include "tests/support/bit_mesh.h"
#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"
#include "tests/support/random.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

void ExpectExact(const BitMesh& mesh, uint32_t subtree_vertices) {
  TemporaryFolder folder;
  const std::string scan = folder.File("scan.ply"), folp = folder.File("scan.folp");
  WriteBits(scan, mesh);
  const EncodeReport report = Encode(scan, folp, ExactOptions(subtree_vertices));
  EXPECT_EQ(report.vertices, mesh.positions.size());
  EXPECT_TRUE(Decode(folp, folder.File("out.ply")).complete);
  EXPECT_EQ(DifferenceOfBits(mesh, ReadBits(folder.File("out.ply"))), "");
  if (report.layers > 0) {
    EXPECT_EQ(DifferenceOfBits(mesh, BitsFromMemory(folp)), "");
  }
  const VerifyReport by_digest = Verify(folp, ""), by_scan = Verify(folp, scan);
  EXPECT_TRUE(by_digest.lossless) << by_digest.reason;
  EXPECT_TRUE(by_scan.lossless) << by_scan.reason;
  EXPECT_EQ(by_scan.max_position_error, 0);
}

// ----- coordinates of many kinds, on one surface

double Decimal(double x, int places) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", places, x);
  return std::strtod(text, nullptr);
}

double Printed(double x) {
  char text[64];
  std::snprintf(text, sizeof text, "%g", x);
  return std::strtod(text, nullptr);
}

double DecimalOf4(double x, size_t, Random&) { return Decimal(x, 4); }
double DecimalOf8(double x, size_t, Random&) { return Decimal(x, 8); }
double AsPrinted(double x, size_t, Random&) { return Printed(x / 7); }
double OfTenBits(double x, size_t, Random&) { return std::floor(x * 1024) / 1024; }
double Noise(double x, size_t, Random&) { return x / 3; }
double Geographic(double x, size_t axis, Random&) {
  constexpr double kPlace[] = {512050.25, 5403060.5, 312.125};
  return Decimal(100 * x + kPlace[axis], 2);
}
double MostlyTiny(double x, size_t axis, Random&) { return axis == 0 ? x : x * 1e-30; }
double Denormal(double x, size_t, Random&) { return std::floor(x * 500) * 4.9406564584124654e-324; }
double FloatDenormal(double x, size_t, Random&) { return std::floor(x * 500) * 1.4e-45; }
double Huge(double x, size_t, Random&) { return x * 3e38; }
double OneFarAway(double x, size_t, Random& random) {
  return random.Below(1000) == 0 ? 1e30 : Decimal(x, 4);
}
double Large(double x, size_t, Random&) { return std::floor(x * 1e9); }
double Special(double x, size_t, Random& random) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kSpecial[] = {kInfinity, -kInfinity, -0.0, 0.0, 1e-42, 1e-310};
  const uint64_t choice = random.Below(60);
  if (choice < 6) return kSpecial[choice];
  if (choice > 9) return Decimal(x, 4);
  // NaN with sign and payload, quiet and signalling.
  const uint64_t payload = random.Next() & 0x800fffffe0000000;
  return std::bit_cast<double>(payload | 0x7ff0000020000000);
}

struct Case {
  const char* name;
  bool is_float;
  double (*coordinate)(double, size_t, Random&);
};
void PrintTo(const Case& given, std::ostream* out) { *out << given.name; }

BitMesh Surface(const Case& given) {
  const Mesh sphere = BumpySphere(700, true, 3);
  Random random(5);
  BitMesh mesh{given.is_float, {}, sphere.faces};
  for (const Point& p : sphere.positions) {
    Bits3 bits;
    for (size_t axis = 0; axis < 3; ++axis) {
      const double x = given.coordinate(p[axis], axis, random);
      bits[axis] = given.is_float ? NarrowToFloatBits(x) : std::bit_cast<uint64_t>(x);
    }
    mesh.positions.push_back(bits);
  }
  return mesh;
}

class ExactTest : public ::testing::TestWithParam<Case> {};

TEST_P(ExactTest, GivesEveryBitBack) { ExpectExact(Surface(GetParam()), 1 << 24); }
TEST_P(ExactTest, GivesEveryBitBackFromSubtrees) { ExpectExact(Surface(GetParam()), 60); }

INSTANTIATE_TEST_SUITE_P(
    Of, ExactTest,
    ::testing::Values(
        Case{"DecimalFloats", true, DecimalOf4}, Case{"DecimalDoubles", false, DecimalOf8},
        Case{"PrintedFloats", true, AsPrinted}, Case{"PrintedDoubles", false, AsPrinted},
        Case{"BinaryFloats", true, OfTenBits}, Case{"BinaryDoubles", false, OfTenBits},
        Case{"NoisyFloats", true, Noise}, Case{"NoisyDoubles", false, Noise},
        Case{"GeographicFloats", true, Geographic}, Case{"GeographicDoubles", false, Geographic},
        Case{"FloatsOfTwoSizes", true, MostlyTiny}, Case{"DoublesOfTwoSizes", false, MostlyTiny},
        Case{"DenormalFloats", true, FloatDenormal}, Case{"DenormalDoubles", false, Denormal},
        Case{"HugeFloats", true, Huge}, Case{"HugeDoubles", false, Huge},
        Case{"FloatsAndOneFarAway", true, OneFarAway},
        Case{"DoublesAndOneFarAway", false, OneFarAway}, Case{"LargeWholeFloats", true, Large},
        Case{"LargeWholeDoubles", false, Large}, Case{"SpecialFloats", true, Special},
        Case{"SpecialDoubles", false, Special}),
    [](const auto& given) { return std::string(given.param.name); });

TEST(Exact, GivesBackAnyBitsAtAll) {
  for (bool is_float : {true, false}) {
    Random random(7);
    BitMesh mesh{is_float, {}, BumpySphere(500, true, 1).faces};
    for (uint64_t v = 0; v < 600; ++v) {
      Bits3 bits{random.Next(), random.Next(), random.Next()};
      for (uint64_t& value : bits) value = is_float ? value >> 32 : value;
      mesh.positions.push_back(bits);
    }
    for (uint32_t subtree_vertices : {1u << 24, 40u}) ExpectExact(mesh, subtree_vertices);
  }
}

TEST(Exact, GivesBackTheSmallestMeshes) {
  const uint32_t nan = 0xffa12345, negative_zero = 0x80000000, tenth = 0x3dcccccd;
  ExpectExact({true, {}, {}}, 10);
  ExpectExact({true, {{tenth, tenth, 0}}, {}}, 10);
  ExpectExact({true, {{negative_zero, negative_zero, negative_zero}}, {}}, 10);
  ExpectExact({true, {{nan, nan, nan}}, {{0, 0, 0}}}, 10);
  ExpectExact({true, {{nan, tenth, 0}, {tenth, 0, nan}, {0, 0, 0}}, {{0, 1, 2}}}, 1);
  ExpectExact({false, {{nan, nan, nan}, {nan, nan, nan}, {0, 1, 2}}, {{0, 1, 2}, {1, 2, 1}}}, 10);
}

// Positions that follow from the box alone, so that a layer changes vertices and codes nothing.
TEST(Exact, GivesBackAFewVerticesFarFromOne) {
  Random random(11);
  for (int i = 0; i < 120; ++i) {
    const uint64_t far = uint64_t{1} << (12 + 3 * random.Below(2)), spread = 4 + random.Below(50);
    const bool on_a_line = random.Below(2) == 0;
    BitMesh mesh{true, {}, {}};
    const auto bits = [](uint64_t value) { return NarrowToFloatBits(static_cast<double>(value)); };
    const uint64_t near = 3 + random.Below(5);
    for (uint64_t v = 0; v < near; ++v) {
      Bits3 position;
      for (uint64_t& value : position) value = bits(far + random.Below(spread));
      if (on_a_line) position[1] = position[2] = bits(0);
      mesh.positions.push_back(position);
    }
    mesh.positions.push_back({bits(0), bits(0), bits(0)});
    const uint64_t copies = 3 + random.Below(6);
    for (uint64_t c = 0; c < copies; ++c) mesh.faces.push_back({near, 0, 0});
    for (uint64_t v = 0; v + 1 < near; ++v) mesh.faces.push_back({v, v + 1, v + 1});
    ExpectExact(mesh, 1 << 24);
  }
}

TEST(Exact, FindsTheLatticeOfTheCoordinates) {
  struct Expected {
    Case given;
    uint32_t radix;
    int32_t exponent;
    bool has_rests;
  };
  for (const Expected& expected : {Expected{{"", true, DecimalOf4}, 10, 4, false},
                                   Expected{{"", false, DecimalOf8}, 10, 8, false},
                                   Expected{{"", true, OfTenBits}, 2, 10, false},
                                   Expected{{"", false, OfTenBits}, 2, 10, false},
                                   Expected{{"", false, Geographic}, 10, 2, false},
                                   Expected{{"", true, Special}, 10, 4, true}}) {
    TemporaryFolder folder;
    WriteBits(folder.File("scan.ply"), Surface(expected.given));
    Encode(folder.File("scan.ply"), folder.File("scan.folp"), ExactOptions());
    const FileInfo info = ReadInfo(folder.File("scan.folp")).value();
    ASSERT_TRUE(info.exact.has_value());
    EXPECT_EQ(info.exact->is_float, expected.given.is_float);
    EXPECT_EQ(info.exact->radix, expected.radix);
    EXPECT_EQ(info.exact->exponent, expected.exponent);
    EXPECT_EQ(info.exact->has_rests, expected.has_rests);
    EXPECT_EQ(info.tolerance, 0);
    EXPECT_EQ(info.layers.back().error_bound, 0);
  }
}

TEST(Exact, CostsTheSameForAFewCoordinatesOffTheLattice) {
  TemporaryFolder folder;
  BitMesh mesh = Surface({"", true, DecimalOf4});
  WriteBits(folder.File("on.ply"), mesh);
  mesh.positions[100][1] += 1;  // the next float
  WriteBits(folder.File("off.ply"), mesh);
  const EncodeReport on = Encode(folder.File("on.ply"), folder.File("on.folp"), ExactOptions());
  const EncodeReport off = Encode(folder.File("off.ply"), folder.File("off.folp"), ExactOptions());
  EXPECT_EQ(on.bits.rests, 0);
  EXPECT_GT(off.bits.rests, 0);
  EXPECT_LE(off.bytes, on.bytes + 40);
}

TEST(Exact, KeepsIntegers) {
  for (CoordinateType type : {CoordinateType::kShort, CoordinateType::kInt}) {
    TemporaryFolder folder;
    const std::string scan = folder.File("scan.ply"), folp = folder.File("scan.folp");
    WritePly(scan, IntegerTerrain(30, 20, 1), type);
    Encode(scan, folp, ExactOptions(200));
    Decode(folp, folder.File("out.ply"));
    const PlyContent out = ReadPly(folder.File("out.ply"));
    EXPECT_EQ(out.coordinate_type, type == CoordinateType::kShort ? "float" : "double");
    std::vector<Point> expected = ReadPly(scan).mesh.positions, actual = out.mesh.positions;
    std::sort(expected.begin(), expected.end());
    std::sort(actual.begin(), actual.end());
    EXPECT_EQ(actual, expected);
    EXPECT_TRUE(Verify(folp, scan).lossless);
  }
}

TEST(Exact, VerifySeesASingleBit) {
  for (double (*coordinate)(double, size_t, Random&) : {DecimalOf4, Noise, Special}) {
    TemporaryFolder folder;
    BitMesh mesh = Surface({"", true, coordinate});
    WriteBits(folder.File("scan.ply"), mesh);
    Encode(folder.File("scan.ply"), folder.File("scan.folp"), ExactOptions(100));
    mesh.positions[77][2] ^= 1;
    WriteBits(folder.File("other.ply"), mesh);
    const VerifyReport report = Verify(folder.File("scan.folp"), folder.File("other.ply"));
    EXPECT_FALSE(report.lossless);
    EXPECT_NE(report.reason, "");
  }
}

TEST(Exact, VerifySeesTheSignOfAZero) {
  TemporaryFolder folder;
  BitMesh mesh = Surface({"", true, DecimalOf4});
  mesh.positions[5][0] = 0;
  WriteBits(folder.File("scan.ply"), mesh);
  Encode(folder.File("scan.ply"), folder.File("scan.folp"), ExactOptions());
  mesh.positions[5][0] = 0x80000000;
  WriteBits(folder.File("other.ply"), mesh);
  const VerifyReport report = Verify(folder.File("scan.folp"), folder.File("other.ply"));
  EXPECT_FALSE(report.lossless);
  EXPECT_EQ(report.max_position_error, 0);
  EXPECT_NE(report.reason.find("bits"), std::string::npos) << report.reason;
}

TEST(Exact, LevelsOfDetailStayInsideTheirErrorBounds) {
  TemporaryFolder folder;
  const BitMesh mesh = Surface({"", false, AsPrinted});
  WriteBits(folder.File("scan.ply"), mesh);
  Encode(folder.File("scan.ply"), folder.File("scan.folp"), ExactOptions(200));
  const FileInfo info = ReadInfo(folder.File("scan.folp")).value();
  const std::vector<Mesh> lods = EveryLod(folder.File("scan.folp"));
  ASSERT_EQ(lods.size(), info.layers.size());
  for (size_t layer = 0; layer < lods.size(); ++layer) {
    for (const Bits3& bits : mesh.positions) {
      const auto p = std::bit_cast<Point>(bits);
      double nearest = 1e9;
      for (const Point& q : lods[layer].positions) {
        nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
      }
      ASSERT_LE(nearest, info.layers[layer].error_bound) << "layer " << layer;
    }
  }
}

TEST(Exact, NeedsLatticeOffsets) {
  TemporaryFolder folder;
  WriteBits(folder.File("scan.ply"), Surface({"", true, DecimalOf4}));
  EncodeOptions options = ExactOptions();
  options.codec.offsets = Offsets::kCylindrical;
  try {
    Encode(folder.File("scan.ply"), folder.File("scan.folp"), options);
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().kind, ErrorKind::kUsage);
    EXPECT_NE(failure.error().message.find("offsets = \"lattice\""), std::string::npos);
  }
}

TEST(Exact, SharedScansComeBackSmall) {
  struct Scan {
    const char* name;
    uint64_t most_bytes;  ///< 0.4 of what xz -6 makes of the file
  };
  for (const Scan& scan : {Scan{"scans/horse.ply", 151561}, Scan{"scans/igea.ply", 583281},
                           Scan{"scans/dragon_vrip.ply", 2246504}, Scan{"scans/fandisk.ply", 31766},
                           Scan{"scans/venus_head.ply", 48547}}) {
    const std::string path = SharedFile(scan.name);
    if (path.empty()) GTEST_SKIP() << kNoSharedData;
    const BitMesh mesh = ReadBits(path);
    if (kSanitized && mesh.positions.size() > 20000) continue;
    TemporaryFolder folder;
    auto runner = parallel::MakeTbbRunner(2);
    const std::string folp = folder.File("scan.folp");
    EXPECT_LE(Encode(path, folp, ExactOptions(65536), runner.get()).bytes, scan.most_bytes);
    Decode(folp, folder.File("out.ply"), {}, runner.get());
    EXPECT_EQ(DifferenceOfBits(mesh, ReadBits(folder.File("out.ply"))), "");
    EXPECT_TRUE(Verify(folp, path, runner.get()).lossless);
  }
}

}  // namespace
}  // namespace folprom::support
