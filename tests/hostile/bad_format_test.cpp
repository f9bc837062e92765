// OBJ, STL and OFF files that are cut or damaged: a mesh, or an input error that names the file.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/fuzz/scan_check.h"
#include "tests/hostile/encode_error.h"
#include "tests/hostile/guarded_child.h"
#include "tests/hostile/small_scans.h"

namespace folprom::hostile {
namespace {

constexpr uint64_t kGrowth = uint64_t{64} << 20;

/// false where reading ends in anything but a sound mesh or an input error that names the file.
/// *is_mesh tells which.
bool ReadsOrRefuses(const SmallScan& scan, const std::string& bytes, bool* is_mesh) {
  const fuzz::ScanOutcome outcome = fuzz::ReadScanBytes(
      std::span(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()), scan.name);
  *is_mesh = outcome.is_mesh;
  return outcome.fault.empty();
}

TEST(BadFormat, SmallScansVerifyWhileTheyAreWhole) {
  for (const SmallScan& scan : SmallScans()) {
    EXPECT_EQ(EncodeErrorOfBytes(scan.bytes, SmallOptions(), scan.name), "") << scan.name;
    EncodeOptions exact = SmallOptions();
    exact.exact = true;
    EXPECT_EQ(EncodeErrorOfBytes(scan.bytes, exact, scan.name), "") << scan.name;
  }
}

TEST(BadFormat, CutAtAnyByteIsRefusedOrAMeshWhereALineEnds) {
  for (const SmallScan& scan : SmallScans()) {
    const std::string faults = RunGuarded(scan.bytes.size(), 1, kGrowth, [&](size_t size) {
      bool is_mesh = false;
      const std::string cut = scan.bytes.substr(0, size);
      if (!ReadsOrRefuses(scan, cut, &is_mesh)) return false;
      // OBJ announces nothing: any of its lines may be the last, and lose digits.
      if (!is_mesh || scan.name == "obj.obj") return true;
      return scan.is_text && cut.size() > scan.bytes.size() / 2;
    });
    EXPECT_EQ(faults, "") << scan.name;
  }
}

TEST(BadFormat, WithAnyBitFlippedIsRefusedOrAMesh) {
  for (const SmallScan& scan : SmallScans()) {
    const std::string faults = RunGuarded(8 * scan.bytes.size(), 1, kGrowth, [&](size_t bit) {
      std::string bytes = scan.bytes;
      bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
      bool is_mesh = false;
      return ReadsOrRefuses(scan, bytes, &is_mesh);
    });
    EXPECT_EQ(faults, "") << scan.name;
  }
}

TEST(BadFormat, WithAnyByteChangedIsRefusedOrVerifies) {
  for (const SmallScan& scan : SmallScans()) {
    const std::string faults = RunGuarded(scan.bytes.size(), 1, kGrowth, [&](size_t i) {
      std::string bytes = scan.bytes;
      bytes[i] = static_cast<char>(bytes[i] ^ (1 << i % 8));
      EncodeErrorOfBytes(bytes, SmallOptions(), scan.name);
      return !::testing::Test::HasFailure();
    });
    EXPECT_EQ(faults, "") << scan.name;
  }
}

TEST(BadFormat, WithAbsurdCountsIsRefusedWithoutMemoryForThem) {
  const std::string zeros(84, '\0');
  std::string stl = zeros;
  stl.replace(80, 4, "\xff\xff\xff\xff");
  const std::vector<SmallScan> scans = {
      {"a.off", "OFF\n4000000000000000000 1 0\n0 0 0\n3 0 0 0\n"},
      {"a.off", "OFF\n1 4000000000000000000 0\n0 0 0\n3 0 0 0\n"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n4000000000000000000 0 0 0\n"},
      {"a.off", "OFF BINARY\n\x7f\xff\xff\xff\x7f\xff\xff\xff" + zeros},
      {"a.off", "OFF BINARY\n" + zeros.substr(0, 4) + "\x7f\xff\xff\xff" + zeros},
      {"a.stl", stl},
      {"a.obj", "f 1000000000000000000 2 3\n"},
      {"a.obj", "v 0 0 0\nf -9223372036854775808 1 1\n"},
  };
  const std::string faults = RunGuarded(scans.size(), 1, kGrowth, [&](size_t i) {
    bool is_mesh = false;
    return ReadsOrRefuses(scans[i], scans[i].bytes, &is_mesh) && !is_mesh;
  });
  EXPECT_EQ(faults, "");
}

TEST(BadFormat, WithLongLinesIsReadInBoundedMemory) {
  struct Case {
    const char* name;
    std::string head, piece, tail;
  };
  const std::vector<Case> cases = {{"a.obj", "v 0 0 0\n#", "# comment ", "\n"},
                                   {"a.obj", "v 0 0 0\nf", " 1", "\n"},
                                   {"a.obj", "v 0 0 0\n", "\\\n", "f 1 1 1\n"},
                                   {"a.obj", "v 0 0 0\ng ", "name", "\n"},
                                   {"a.obj", "v 0 0 0", " ", "\n"},
                                   {"a.obj", "v 0 0 ", "1", "\n"},
                                   {"a.obj", "", "\n", "v 0 0 0"},
                                   {"a.off", "OFF 1 0 0\n0 0 0.", "3", "\n"},
                                   {"a.off", "OFF", " ", "0 0"},
                                   {"a.stl", "solid ", "name ", "\nendsolid"},
                                   {"a.stl", "solid\n", "endsolid\nsolid\n", "endsolid"}};
  const std::string faults = RunGuarded(cases.size(), 5, kGrowth, [&](size_t i) {
    std::string bytes = cases[i].head;
    while (bytes.size() < 1000000) bytes += cases[i].piece;
    bytes += cases[i].tail;
    bool is_mesh = false;
    return ReadsOrRefuses({cases[i].name, ""}, bytes, &is_mesh) && is_mesh;
  });
  EXPECT_EQ(faults, "");
}

}  // namespace
}  // namespace folprom::hostile
