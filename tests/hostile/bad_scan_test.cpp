// Scans that are damaged, cut or not finite: an input error or a file that verifies, nothing
// between.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <random>

#include "parallel/progress.h"
#include "parallel/runner.h"
#include "tests/hostile/encode_error.h"
#include "tests/hostile/guarded_child.h"
#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace fs = std::filesystem;
namespace {

TestMesh TinyMesh() {
  TestMesh mesh = WavySheet(4);
  mesh.faces.resize(5);
  return mesh;
}

TEST(BadScan, OfTheMalformedSharedFilesIsRefusedOrVerifies) {
  if (SharedData().empty()) GTEST_SKIP() << "no shared data: set FOLPROM_SHARED";
  std::vector<std::string> scans;
  for (const auto& entry : fs::directory_iterator(SharedData() + "malformed")) {
    scans.push_back(entry.path().string());
  }
  std::sort(scans.begin(), scans.end());
  ASSERT_FALSE(scans.empty());
  const std::string faults = RunGuarded(scans.size(), 60, uint64_t{256} << 20, [&](size_t i) {
    const std::string message = EncodeError(scans[i]);
    std::printf("%s: %s\n", fs::path(scans[i]).filename().c_str(),
                message.empty() ? "encoded, verifies" : message.c_str());
    std::fflush(stdout);
    return !::testing::Test::HasFailure();
  });
  EXPECT_EQ(faults, "");
}

TEST(BadScan, WithANaNInPlaceOfAZeroIsNotWhatTheFileGivesBack) {
  TestMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.7, 0.1}};
  mesh.faces = {{0, 1, 2}, {1, 3, 2}};
  TemporaryFolder folder;
  WriteFile(folder.File("scan.folp"), Encoded(mesh, SmallOptions()));
  // On the lattice it is 0 again, so that all but the coordinate itself agrees.
  mesh.positions[0][0] = std::numeric_limits<double>::quiet_NaN();
  WriteFile(folder.File("nan.ply"), std::string_view(PlyBytes(mesh)));
  auto runner = parallel::MakeSerialRunner();
  parallel::Progress progress;
  DecodeOptions options;
  options.temporary_folder = folder.path();
  auto report =
      VerifyFile(folder.File("scan.folp"), folder.File("nan.ply"), options, *runner, progress);
  ASSERT_TRUE(report.ok()) << report.error().message;
  EXPECT_FALSE(report->lossless);
  EXPECT_NE(report->reason.find("tolerance"), std::string::npos) << report->reason;
  EXPECT_EQ(report->max_position_error, std::numeric_limits<double>::infinity());
}

TEST(BadScan, CutAtAnyByteIsRefused) {
  for (PlyForm form : {PlyForm::kLittleEndian, PlyForm::kBigEndian}) {
    const std::string whole = PlyBytes(TinyMesh(), form);
    ASSERT_EQ(EncodeErrorOfBytes(whole), "");
    for (size_t bytes = 0; bytes < whole.size(); ++bytes) {
      ASSERT_NE(EncodeErrorOfBytes(whole.substr(0, bytes)), "") << bytes;
    }
  }
}

TEST(BadScan, AsTextCutAtAnyByteIsRefusedUnlessANumberIsLeft) {
  const std::string whole = PlyBytes(TinyMesh(), PlyForm::kAscii);
  ASSERT_EQ(EncodeErrorOfBytes(whole), "");
  for (size_t bytes = 0; bytes < whole.size(); ++bytes) {
    const std::string message = EncodeErrorOfBytes(whole.substr(0, bytes));
    // The last number may lose digits and stay a number; all before must be missed.
    const size_t last_number = whole.find_last_of(' ') + 1;
    if (bytes <= last_number) {
      ASSERT_NE(message, "") << bytes;
    }
  }
}

TEST(BadScan, WithAnyByteChangedIsRefusedOrVerifies) {
  const std::string whole = PlyBytes(TinyMesh(), PlyForm::kLittleEndian);
  const std::string faults = RunGuarded(whole.size(), 60, uint64_t{256} << 20, [&](size_t i) {
    constexpr uint8_t kChanges[] = {1, 0x80, 0xff};
    std::string scan = whole;
    scan[i] = static_cast<char>(static_cast<uint8_t>(scan[i]) ^ kChanges[i % 3]);
    EncodeErrorOfBytes(scan);
    return !::testing::Test::HasFailure();
  });
  EXPECT_EQ(faults, "");
}

TEST(BadScan, WithACoordinateThatIsNotFiniteNamesTheVertex) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (double value : {std::nan(""), infinity, -infinity}) {
    for (PlyForm form : {PlyForm::kAscii, PlyForm::kLittleEndian, PlyForm::kBigEndian}) {
      TestMesh mesh = WavySheet(12);
      mesh.positions[137][1] = value;
      const std::string message = EncodeErrorOfBytes(PlyBytes(mesh, form));
      EXPECT_NE(message.find("vertex 137"), std::string::npos) << message;
      EXPECT_NE(message.find("scan.ply"), std::string::npos) << message;
    }
  }
}

TEST(BadScan, WithAnIndexBeyondTheVerticesNamesTheFace) {
  for (PlyForm form : {PlyForm::kAscii, PlyForm::kLittleEndian, PlyForm::kBigEndian}) {
    TestMesh mesh = WavySheet(12);
    mesh.faces[71][2] = 144;
    const std::string message = EncodeErrorOfBytes(PlyBytes(mesh, form));
    EXPECT_NE(message.find("face 71"), std::string::npos) << message;
    EXPECT_NE(message.find("scan.ply"), std::string::npos) << message;
  }
}

TEST(BadScan, OfExtremeSizeIsRefusedOrVerifies) {
  for (double factor : {1e-320, 1e-300, 1e-30, 1e30, 1e300, 1.7e308}) {
    TestMesh mesh = WavySheet(12);
    for (auto& p : mesh.positions) {
      for (double& value : p) value *= factor;
    }
    EncodeErrorOfBytes(PlyBytes(mesh));
    // Both ends of the range: the box itself is not a finite number.
    mesh.positions[3] = {-factor, -factor, -factor};
    EncodeErrorOfBytes(PlyBytes(mesh));
  }
}

TEST(BadScan, FarFromTheOriginIsRefusedOrVerifies) {
  for (double offset : {1e3, 1e6, 1e9, 1e12, 1e15, 1e18, -1e15}) {
    TestMesh mesh = WavySheet(12);
    for (auto& p : mesh.positions) p[0] += offset;
    EncodeErrorOfBytes(PlyBytes(mesh));
  }
}

TEST(BadScan, WithoutExtentVerifies) {
  TestMesh point;
  point.positions.assign(50, {1.5, -2.5, 1e9});
  point.faces = {{0, 1, 2}, {3, 4, 5}, {6, 6, 6}};
  EXPECT_EQ(EncodeErrorOfBytes(PlyBytes(point)), "");
  TestMesh line;
  for (int i = 0; i < 300; ++i) line.positions.push_back({0, 0, i * 0.25});
  for (uint32_t i = 0; i + 2 < 300; ++i) line.faces.push_back({i, i + 1, i + 2});
  EXPECT_EQ(EncodeErrorOfBytes(PlyBytes(line)), "");
  EXPECT_EQ(EncodeErrorOfBytes(PlyBytes(TestMesh{})), "");
  EXPECT_EQ(EncodeErrorOfBytes(PlyBytes(TestMesh{{{1, 2, 3}}, {}})), "");
}

TEST(BadScan, OfNeedlesVerifies) {
  // Tips straight above the vertices of a tilted plane, so that neighbours lie on the axis.
  for (double height : {0.05, -1.0, 1.0}) {
    TestMesh mesh;
    constexpr uint32_t kSide = 18;
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
      const double x = i % kSide * 0.1, y = i / kSide * 0.1;
      const double tip = i % 2 == 0 ? height : -height;
      mesh.positions.push_back({x, y, 0.3 * x + 0.7 * y});
      mesh.positions.push_back({x - 0.3 * tip, y - 0.7 * tip, 0.3 * x + 0.7 * y + tip});
      if (i % kSide + 1 == kSide || i / kSide + 1 == kSide) continue;
      mesh.faces.push_back({2 * i, 2 * i + 2, 2 * (i + kSide)});
      mesh.faces.push_back({2 * i, 2 * i + 1, 2 * i + 2});
      mesh.faces.push_back({2 * i, 2 * i + 1, 2 * (i + kSide)});
    }
    EXPECT_EQ(EncodeErrorOfBytes(PlyBytes(mesh)), "") << height;
  }
}

TEST(BadScan, OfRandomTrianglesVerifiesAtTheFinestLattice) {
  for (uint64_t seed = 0; seed < 60; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> part(0, 1);
    TestMesh mesh;
    for (int v = 0; v < 200; ++v) {
      // Heights that have nothing to do with distances: steep places, vertices above each other.
      mesh.positions.push_back(
          {part(random), std::floor(part(random) * 4) / 4, std::exp2(-20 * part(random))});
    }
    auto vertex = [&] { return static_cast<uint32_t>(random() % 200); };
    for (uint64_t f = 0; f < 50 + seed * 10; ++f)
      mesh.faces.push_back({vertex(), vertex(), vertex()});
    const uint32_t subtree_vertices = seed % 2 == 0 ? 1000 : 60;
    EncodeOptions options =
        seed % 8 < 4 ? LloydOptions(subtree_vertices) : SmallOptions(subtree_vertices);
    options.bits = 24;
    options.codec.children = 2 + static_cast<uint32_t>(seed % 7);
    options.codec.predict_height = seed % 5 != 0;
    options.codec.split_first = seed % 3 != 0;
    EXPECT_EQ(EncodeErrorOfBytes(PlyBytes(mesh), options), "") << seed;
  }
}

/// Two parallel sheets, close together, of opposite orientation, joined along one side.
TestMesh ThinPlate(uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> part(-1, 1);
  const double slope_x = part(random), slope_y = part(random);
  const double thickness = std::exp2(-2 - 18 * std::fabs(part(random)));
  const double noise = thickness * std::fabs(part(random)), jitter = 0.3 * std::fabs(part(random));
  const uint32_t side = 8 + static_cast<uint32_t>(random() % 8);
  TestMesh mesh;
  for (int layer = 0; layer < 2; ++layer) {
    for (uint32_t i = 0; i < side * side; ++i) {
      const double x = i % side + jitter * part(random), y = i / side + jitter * part(random);
      mesh.positions.push_back(
          {x, y, slope_x * x + slope_y * y + layer * thickness + noise * part(random)});
    }
  }
  for (uint32_t y = 0; y + 1 < side; ++y) {
    for (uint32_t x = 0; x + 1 < side; ++x) {
      const uint32_t low = y * side + x, high = side * side + low;
      mesh.faces.push_back({high, high + 1, high + side});
      mesh.faces.push_back({high + 1, high + side + 1, high + side});
      mesh.faces.push_back({low + 1, low, low + side});
      mesh.faces.push_back({low + side + 1, low + 1, low + side});
    }
  }
  for (uint32_t x = 0; x + 1 < side; ++x) mesh.faces.push_back({x, x + 1, x + side * side});
  return mesh;
}

TEST(BadScan, OfThinPlatesVerifies) {
  // Sets whose neighbours lie nearer to the axis than their children by a factor of thousands.
  for (uint64_t seed : {2, 17, 400, 1474}) {
    EncodeOptions quadric = SmallOptions(1000);
    quadric.bits = 24;
    EXPECT_EQ(EncodeErrorOfBytes(PlyBytes(ThinPlate(seed)), quadric), "") << seed;
    for (uint32_t levels : {16u, 256u, 4096u}) {
      EncodeOptions options = LloydOptions(1000);
      options.bits = 24;
      options.codec.children = 6;
      options.codec.quantisation_levels = levels;
      EXPECT_EQ(EncodeErrorOfBytes(PlyBytes(ThinPlate(seed)), options), "")
          << seed << " " << levels;
    }
  }
}

TEST(BadScan, WithExponentiallySpacedVerticesVerifies) {
  TestMesh mesh;
  for (int i = 0; i < 600; ++i) {
    mesh.positions.push_back({std::ldexp(1.0, -i / 4), std::ldexp(1.0, -i / 3), 0});
  }
  for (uint32_t i = 0; i + 2 < 600; ++i) mesh.faces.push_back({i, i + 1, i + 2});
  EXPECT_EQ(EncodeErrorOfBytes(PlyBytes(mesh)), "");
}

}  // namespace
}  // namespace folprom::hostile
