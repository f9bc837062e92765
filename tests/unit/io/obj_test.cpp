// OBJ files in all the forms that programs write.
#include <gtest/gtest.h>

#include "plain_reader.h"
#include "support.h"
#include "tests/support/random.h"

namespace folprom::io {
namespace {

using testing::InputErrorOf;
using testing::Mesh;
using testing::MeshOf;
using testing::OpenBytes;
using testing::TemporaryFolder;

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::vector<Triangle> kSquareFan = {{0, 1, 2}, {0, 2, 3}};

void ExpectFault(const std::string& bytes, const std::string& part) {
  EXPECT_NE(InputErrorOf(bytes, "a.obj").find("a.obj: " + part), std::string::npos)
      << bytes << InputErrorOf(bytes, "a.obj");
}

TEST(Obj, ReadsEveryFormOfACorner) {
  for (const std::string face :
       {"f 1 2 3 4", "f 1/1 2/2 3/3 4/4", "f 1//1 2//2 3//3 4//4", "f 1/1/1 2/2/2 3/3/3 4/4/4",
        "f 1// 2/ 3/1/ 4/", "f +1 2 3 4", "f -4 -3 -2 -1", "f -4/-1 -3/-1/-1 -2//-1 4"}) {
    EXPECT_EQ(MeshOf(kSquare + face, "a.obj").value().triangles, kSquareFan) << face;
  }
}

TEST(Obj, CountsNegativeIndicesFromTheVerticesReadSoFar) {
  const Mesh mesh =
      MeshOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nf -1 -2 -3\n", "a.obj")
          .value();
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {4, 3, 2}}));
}

TEST(Obj, ReadsFacesBeforeTheirVertices) {
  const Mesh mesh = MeshOf("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0", "a.obj").value();
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(Obj, JoinsLinesAtABackslash) {
  const std::string square =
      "# c:\\\nv 0 \\\n0 0\nv 1 0 0\r\nv 1 1 \\\r\n0\nv 0 1 0\nmtllib c:\\a\\\nf 1 2\\\n 3 \\\n4\n";
  EXPECT_EQ(MeshOf(square, "a.obj").value().triangles, kSquareFan);
  EXPECT_EQ(MeshOf(square, "a.obj").value().xyz[6], 1);
  ExpectFault(std::string(kSquare) + "f 1 2 \\\n9\n", "line 6: the vertex index 9 is beyond");
}

TEST(Obj, JoinsNoLineAtABackslashInAComment) {
  const Mesh mesh = MeshOf(
                        "v 0 0 0 # c:\\\nv 1 0 0\nv 1 1 0 # c:\\\nf 1 2 3 # c:\\\n"
                        "v 0 1 0 # c:\\\nf 1 3 4 # c:\\\nl 1 2 # c:\\\nf -1 -2 -3\n",
                        "a.obj")
                        .value();
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}}));
}

TEST(Obj, TakesAnyLineEndsBlanksAndComments) {
  for (const std::string end : {"\n", "\r\n", "\r", " \t\n\n \n", " # f 9 9 9\n"}) {
    std::string text = "# head\n";
    for (const std::string line : {"\tv 0 0  0", "v 1.0 0 0", "v 1e0 1 0", "v 0 +1 -0"}) {
      text += line + end;
    }
    EXPECT_EQ(MeshOf(text + "f 1  2 3\t4" + end, "a.obj").value().triangles, kSquareFan) << text;
    EXPECT_EQ(MeshOf(text + "f 1 2 3 4", "a.obj").value().triangles, kSquareFan) << text;
  }
}

TEST(Obj, NamesWhatIsNotCoded) {
  const TemporaryFolder folder;
  const auto source =
      OpenBytes(folder,
                "mtllib a.mtl\no one\ng a b\nv 0 0 0 1\nv 1 0 0 255 0 0\nv 0 1 0 1 0 0 1\n"
                "vt 0 0\nvn 0 0 1\nvp 1\nusemtl red\ns 1\nl 1 2\np 1\nf 1 2 3\nf 1 2\n"
                "f 1 2 3 1\ncurv 0 1 1 2 \\\n3\nend\n",
                "a.obj")
          .value();
  EXPECT_EQ(source->notes().ignored_properties,
            (std::vector<std::string>{
                "weights of vertices (v)", "colours of vertices (v)", "normals (vn)",
                "texture coordinates (vt)", "points of parameter space (vp)", "point elements (p)",
                "line elements (l)", "curves (curv)", "ends of free-form elements (end)"}));
  EXPECT_EQ(source->remarks(),
            (std::vector<std::string>{"obj_info mtllib a.mtl", "obj_info object 1 one",
                                      "obj_info group 1 a b", "obj_info material 1 red",
                                      "obj_info smoothing 1 1"}));
  EXPECT_EQ(source->face_schema().attributes.size(), 4u);
  EXPECT_EQ(source->notes().polygons_dropped, 1u);
  EXPECT_EQ(source->notes().polygons_triangulated, 1u);
  EXPECT_EQ(testing::AllBlocks(*source).value().triangles.size(), 3u);
}

/// What a backslash joins to a line is no line of its own, in whatever is read.
TEST(Obj, JoinsLinesOfStatements) {
  const TemporaryFolder folder;
  const auto source = OpenBytes(folder,
                                "v 0 0 0\nv 1 0 0\nv 0 1 0\ns 1 \\\nf 3 2 1\nf 1 2 3\n"
                                "g a\\\nf 2 3 1\n",
                                "a.obj")
                          .value();
  EXPECT_EQ(testing::AllBlocks(*source).value().triangles,
            (std::vector<Triangle>{{0, 1, 2}, {1, 2, 0}}));
  std::vector<uint8_t> rows;
  source->ReadFaceAttributes(0, &rows).value();
  // The group, then the smoothing group.
  EXPECT_EQ(rows, (std::vector<uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
}

TEST(Obj, NamesTheLineOfAFault) {
  const std::string square = kSquare;
  ExpectFault(square + "f 0 1 2\n", "line 5: the vertex index 0 is no vertex: the first is 1");
  ExpectFault(square + "f 1 2 5\n", "line 5: the vertex index 5 is beyond the 4 vertices");
  ExpectFault(square + "f 1 2 -5\n", "line 5: the vertex index -5 goes back beyond the 4");
  ExpectFault(square + "f 1 2 -9223372036854775808\n", "line 5: the vertex index -92233");
  ExpectFault(square + "f 1 2 99999999999999999999\n", "line 5: \"99999999999999999999\" is no");
  for (const std::string corner : {"a", "1/a", "1/2/3/4", "/1", "1.5", "1/1.5", "--1"}) {
    ExpectFault(square + "f 1 2 " + corner + "\n", "line 5: \"" + corner + "\" is no corner");
  }
  ExpectFault(square + "v 1 2\n", "line 5: the line has fewer than three coordinates");
  ExpectFault(square + "v 1 2 x\n", "line 5: \"x\" is not a number");
  ExpectFault(square + "v 1 2 3 x\n", "line 5: \"x\" is not a number");
  ExpectFault(square + "v 1 2 3 4 5\n", "line 5: a vertex has 5 values");
  ExpectFault(square + "vn 1 2\n", "line 5: vn has 2 values");
  ExpectFault(square + "vt 1 2 3 f\n", "line 5: vt has 4 values");
  ExpectFault(square + "face 1 2 3\n", "line 5: \"face\" is no keyword of an OBJ file");
}

TEST(Obj, WithoutAVertexIsAnEmptyMesh) {
  for (const std::string text : {"# nothing\n", "o a\n", "\n"}) {
    EXPECT_TRUE(MeshOf(text, "a.obj").value().xyz.empty()) << text;
  }
  ExpectFault("f 1 2 3\n", "line 1: the vertex index 1 is beyond the 0 vertices");
}

/// Lines in any order, as no program writes them; more than a block of each kind.
std::string RandomObj(uint64_t vertices, int decimals) {
  support::Random random(vertices);
  std::string text = "# random\n";
  const char* ends[] = {"\n", "\r\n", " \n", "\n\n", " # v 1 2 3\n"};
  uint64_t written = 0;
  while (written < vertices) {
    const std::string end = ends[random.Below(5)];
    const uint64_t kind = random.Below(10);
    if (kind < 4 || written < 3) {
      text += "v";
      for (int i = 0; i < 3; ++i) text.append(" ").append(testing::RandomDecimal(random, decimals));
      ++written;
    } else if (kind < 9) {
      text += "f";
      for (uint64_t i = 0, count = 1 + random.Below(6); i < count; ++i) {
        const uint64_t vertex = 1 + random.Below(written);
        if (random.Below(8) == 0) text += " \\\n";
        const uint64_t back = written + 1 - vertex;
        if (random.Below(2) == 0) {
          text.append(" ").append(std::to_string(vertex)).append("/7");
        } else {
          text.append(" -").append(std::to_string(back)).append("//9");
        }
      }
    } else {
      text += random.Below(2) == 0 ? "vn 0 0 1" : "g group f";
    }
    text += end;
  }
  return text;
}

TEST(Obj, GivesWhatAPlainReaderGives) {
  for (const uint64_t vertices : {100, 140000}) {
    for (const auto& [decimals, type] :
         {std::pair{2, ScalarType::kFloat32}, std::pair{9, ScalarType::kFloat64}}) {
      const std::string text = RandomObj(vertices, decimals);
      testing::ExpectSameAsPlain(text, "a.obj", type,
                                 [&](bool as_float) { return testing::PlainObj(text, as_float); });
    }
  }
}

TEST(Obj, ReadsAPolygonLargerThanABlock) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf";
  for (int i = 0; i < 70000; ++i) text.append(" ").append(std::to_string(1 + i % 3));
  text += "\nf 3 2 1\n";
  const TemporaryFolder folder;
  const auto source = OpenBytes(folder, text, "a.obj").value();
  ASSERT_EQ(source->triangle_count(), 70000u);
  ASSERT_EQ(source->triangle_block_count(), 3u);
  std::vector<Triangle> triangles;
  source->ReadTriangleBlock(1, &triangles).value();
  EXPECT_EQ(triangles.size(), 69998u);
  source->ReadTriangleBlock(2, &triangles).value();
  EXPECT_EQ(triangles, (std::vector<Triangle>{{2, 1, 0}}));
}

}  // namespace
}  // namespace folprom::io
