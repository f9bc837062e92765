// Which format a file is read as: by its content, and by its ending where that leaves it open.
#include <gtest/gtest.h>

#include "io/formats/mesh_format.h"
#include "support.h"

namespace folprom::io {
namespace {

using testing::InputErrorOf;
using testing::MeshOf;

constexpr const char* kObj = "# a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
constexpr const char* kOff = "# a\nOFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
constexpr const char* kStl =
    "solid v\nfacet normal 0 0 1 outer loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nendsolid v\n";
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(Format, IsKnownByContentWhateverTheEnding) {
  for (const char* bytes : {kObj, kOff, kStl, kPly}) {
    for (const char* name : {"a", "a.ply", "a.obj", "a.stl", "a.txt", "a.off"}) {
      // What OBJ begins with is in any text: another ending wins.
      if (bytes == kObj && FormatByEnding(name).value_or(MeshFormat::kObj) != MeshFormat::kObj) {
        EXPECT_NE(InputErrorOf(bytes, name), "") << name;
        continue;
      }
      EXPECT_EQ(MeshOf(bytes, name).value().xyz, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}))
          << name << bytes;
      EXPECT_EQ(MeshOf(bytes, name).value().triangles, (std::vector<Triangle>{{0, 1, 2}}));
    }
  }
}

TEST(Format, IsKnownBehindAByteOrderMarkAndInLargeLetters) {
  for (const std::string& text :
       {std::string(kObj), std::string(kOff), "S" + std::string(kStl + 1)}) {
    const std::vector<double> expected = MeshOf(text, "a").value().xyz;
    EXPECT_EQ(expected.size(), 9u);
    EXPECT_EQ(MeshOf("\xef\xbb\xbf" + text, "a").value().xyz, expected);
  }
}

TEST(Format, IsTakenFromTheEndingWhereTheContentLeavesItOpen) {
  const std::string counts = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(MeshOf(counts, "a.OFF").value().xyz.size(), 9u);
  EXPECT_NE(InputErrorOf(counts, "a.txt").find("unsupported format"), std::string::npos);
  EXPECT_NE(InputErrorOf(counts, "a.obj").find("no keyword of an OBJ file"), std::string::npos);
  EXPECT_NE(InputErrorOf(counts, "a.stl").find("is not solid"), std::string::npos);
}

TEST(Format, OfAnyOtherKindIsRefusedWithAListOfTheKnownOnes) {
  for (const std::string& bytes :
       {std::string("glTF"), std::string("PK\3\4\0\0", 6), std::string(100, '\0'),
        std::string(84, '\0'), std::string("# only a comment\n")}) {
    for (const char* name : {"a.glb", "a", "a.ply"}) {
      EXPECT_NE(
          InputErrorOf(bytes, name).find("unsupported format (known formats: PLY, OBJ, STL, OFF)"),
          std::string::npos);
    }
  }
}

}  // namespace
}  // namespace folprom::io
