// OFF files, text and binary, with all that may stand beside the coordinates.
#include <gtest/gtest.h>

#include <algorithm>

#include "plain_reader.h"
#include "support.h"
#include "tests/support/random.h"

namespace folprom::io {
namespace {

using testing::AllBlocks;
using testing::InputErrorOf;
using testing::Mesh;
using testing::MeshOf;
using testing::OpenBytes;
using testing::TemporaryFolder;
using Names = std::vector<std::string>;

const std::vector<double> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

void ExpectFault(const std::string& bytes, const std::string& part) {
  EXPECT_NE(InputErrorOf(bytes, "a.off").find("a.off: " + part), std::string::npos)
      << InputErrorOf(bytes, "a.off");
}

Names NamesOf(const std::string& bytes) {
  const TemporaryFolder folder;
  return OpenBytes(folder, bytes, "a.off").value()->notes().ignored_properties;
}

/// A triangle with these values behind each vertex and behind the face.
std::string OneTriangle(const std::string& keyword, const std::string& vertex,
                        const std::string& face = "") {
  return keyword + "\n3 1 0\n0 0 0" + vertex + "\n1 0 0" + vertex + "\n0 1 0" + vertex +
         "\n3 0 1 2" + face + "\n";
}

TEST(TextOff, ReadsEveryKeyword) {
  struct Case {
    const char *keyword, *vertex, *face;
    size_t of_vertices, of_faces;  ///< attributes
  };
  for (const Case& c :
       {Case{"OFF", "", "", 0, 0}, Case{"", "", "", 0, 0}, Case{"NOFF", " 0 0 1", "", 3, 0},
        Case{"COFF", " 255 0 0 255", "", 4, 0}, Case{"COFF", " 0.5 0 0", "", 3, 0},
        Case{"CNOFF", " 0 0 1 9 9 9 9", "", 7, 0}, Case{"STOFF", " 0 1", "", 2, 0},
        Case{"STCNOFF", " 0 0 1 9 9 9 0 1", " 3", 8, 1},
        Case{"OFF", " 1 2 3", " 0.1 0.2 0.3 1", 3, 4}}) {
    const std::string text = OneTriangle(c.keyword, c.vertex, c.face);
    EXPECT_EQ(MeshOf(text, "a.off").value().xyz, kTriangle) << text;
    EXPECT_EQ(MeshOf(text, "a.off").value().triangles, (std::vector<Triangle>{{0, 1, 2}})) << text;
    EXPECT_EQ(NamesOf(text), Names{}) << text;
    const TemporaryFolder folder;
    const auto source = OpenBytes(folder, text, "a.off").value();
    EXPECT_EQ(source->vertex_schema().attributes.size(), c.of_vertices) << text;
    EXPECT_EQ(source->face_schema().attributes.size(), c.of_faces) << text;
  }
}

TEST(TextOff, NamesColoursThatSomeVerticesHave) {
  EXPECT_EQ(NamesOf("OFF\n3 1 0\n0 0 0 1 1 1\n1 0 0\n0 1 0\n3 0 1 2\n"),
            Names{"colours of vertices"});
}

TEST(TextOff, TakesCommentsBlankLinesLineEndsAndCountsBesideTheKeyword) {
  for (const std::string text :
       {"# a\r\n\r\nOFF # b\r\n# c\r\n 3 1\r\n0 0 0\r\n# d\r\n1 0 0 # e\r\n\r\n0 1 0\r\n3 0 1 2",
        "OFF 3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", "OFF\r3 1 0\r0 0 0\r1 0 0\r0 1 0\r3 0 1 2\r",
        "  OFF  \n\t3\t1\t0\n  0 0 0  \n1 0 0\n0 1 0\n3  0 1 2\n\n\n# end"}) {
    EXPECT_EQ(MeshOf(text, "a.off").value().xyz, kTriangle) << text;
    EXPECT_EQ(MeshOf(text, "a.off").value().triangles, (std::vector<Triangle>{{0, 1, 2}})) << text;
  }
}

TEST(TextOff, CutsPolygonsAndDropsWhatIsNone) {
  const TemporaryFolder folder;
  const auto source = OpenBytes(folder,
                                "OFF 4 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"
                                "2 0 1\n0\n1 9\n",
                                "a.off")
                          .value();
  EXPECT_EQ(AllBlocks(*source).value().triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(source->notes().polygons_triangulated, 1u);
  EXPECT_EQ(source->notes().polygons_dropped, 3u);
}

TEST(TextOff, RefusesOtherDimensionsByName) {
  for (const std::string keyword : {"4OFF", "nOFF", "C4nOFF", "ST4OFF"}) {
    ExpectFault(keyword + "\n", "line 1: vertices of other than three coordinates (" + keyword);
  }
}

TEST(TextOff, NamesTheLineOfAFault) {
  ExpectFault("OFF\n", "line 2: the file ends before the number of vertices");
  ExpectFault("OFF\n3\n", "line 2: the line ends before number of faces");
  ExpectFault("OFF\n-3 1 0\n", "line 2: the number of vertices is negative");
  ExpectFault("OFF\n3 1 x\n", "line 2: \"x\" is not an integer");
  ExpectFault("OFF\n3 1 0 0\n", "line 2: more than three counts");
  ExpectFault("OFF\n999 1 0\n0 0 0\n", "line 2: 999 vertices are announced");
  ExpectFault("OFF\n1 18446744073709551615 0\n0 0 0\n", "line 2: \"18446744073709551615\" is not");
  ExpectFault("OFF\n1 9223372036854775807 0\n0 0 0\n", "line 2: 9223372036854775807 faces are");
  ExpectFault("OFF 2 0 0\n0.50000 0 0\n\n\n", "line 5: the file ends before vertex 1 of 2");
  ExpectFault("OFF 1 2 0\n0 0 0\n3 0 0 0\n", "line 4: the file ends before face 1 of 2");
  ExpectFault("OFF 1 1 0\n0 0 0\n3 0 0 0\n3 0 0 0\n", "line 4: there are more lines");
  ExpectFault(OneTriangle("OFF", " 1"), "line 3: a vertex has 4 values");
  ExpectFault(OneTriangle("COFF", ""), "line 3: a vertex has 3 values");
  ExpectFault(OneTriangle("OFF", "", " 1 2"), "line 6: a face of 3 corners has 2 values behind");
  ExpectFault("OFF 1 1 0\n0 0 0\n3 0 0\n", "line 3: a face of 3 corners has 2 values");
  ExpectFault("OFF 1 1 0\n0 0 0\n-1 0 0\n", "line 3: a face of -1 corners");
  ExpectFault("OFF 1 1 0\n0 0 0\n3 0 0 1\n", "line 3: the vertex index 1 is not below");
  ExpectFault("OFF 1 1 0\n0 0 0\n3 0 0 -1\n", "line 3: the vertex index -1 is not below");
  ExpectFault("OFF 1 1 0\n0 0 x\n3 0 0 0\n", "line 2: \"x\" is not a number");
}

std::string RandomOff(uint64_t vertices, uint64_t faces, int decimals) {
  support::Random random(vertices);
  std::string text = "OFF\n" + std::to_string(vertices) + " " + std::to_string(faces) + " 0\n";
  const char* ends[] = {"\n", "\r\n", " \n", "\n\n", " # 1 2 3\n"};
  for (uint64_t v = 0; v < vertices; ++v) {
    for (int i = 0; i < 3; ++i) text.append(" ").append(testing::RandomDecimal(random, decimals));
    text += ends[random.Below(5)];
  }
  for (uint64_t f = 0; f < faces; ++f) {
    const uint64_t corners = random.Below(6);
    text += std::to_string(corners);
    for (uint64_t i = 0; i < corners; ++i)
      text.append(" ").append(std::to_string(random.Below(vertices)));
    text += ends[random.Below(5)];
  }
  return text;
}

TEST(TextOff, GivesWhatAPlainReaderGives) {
  for (const uint64_t vertices : {50, 140000}) {
    for (const auto& [decimals, type] :
         {std::pair{2, ScalarType::kFloat32}, std::pair{9, ScalarType::kFloat64}}) {
      const std::string text = RandomOff(vertices, vertices, decimals);
      testing::ExpectSameAsPlain(text, "a.off", type,
                                 [&](bool as_float) { return testing::PlainOff(text, as_float); });
    }
  }
}

/// What a form of binary OFF adds.
struct BinaryForm {
  bool big_endian = true;
  bool face_colours = true;
  uint64_t values = 0;  // behind each vertex
};

std::string BinaryOff(const std::string& head, const BinaryForm& form, uint64_t vertices,
                      uint64_t faces, uint64_t seed) {
  support::Random random(seed);
  std::string bytes = head;
  const auto put = [&](auto value) {
    std::string piece(reinterpret_cast<const char*>(&value), sizeof value);
    if (form.big_endian) std::ranges::reverse(piece);
    bytes += piece;
  };
  const auto count = [&](uint64_t value) { put(static_cast<uint32_t>(value)); };
  count(vertices);
  count(faces);
  count(0);
  for (uint64_t i = 0; i < vertices * (3 + form.values); ++i) {
    put(static_cast<float>(random.Between(-9, 9)));
  }
  for (uint64_t f = 0; f < faces; ++f) {
    const uint64_t corners = 2 + random.Below(4);
    count(corners);
    for (uint64_t i = 0; i < corners; ++i) count(random.Below(vertices));
    if (!form.face_colours) continue;
    const uint64_t colours = random.Below(2) * 4;
    count(colours);
    for (uint64_t i = 0; i < colours; ++i) put(0.5f);
  }
  return bytes;
}

TEST(BinaryOff, GivesWhatAPlainReaderGives) {
  for (const bool geomview : {true, false}) {
    for (const uint64_t count : {0, 1, 9, 70000}) {
      const std::string bytes =
          BinaryOff("OFF BINARY\n", {geomview, geomview, 0}, count, count, count);
      const Mesh mesh = MeshOf(bytes, "a").value();
      const Mesh plain = testing::PlainBinaryOff(bytes, geomview);
      EXPECT_TRUE(mesh.xyz == plain.xyz) << count;
      EXPECT_TRUE(mesh.triangles == plain.triangles) << count;
    }
  }
}

TEST(BinaryOff, TakesEitherByteOrderWithAndWithoutColours) {
  for (const bool big_endian : {true, false}) {
    for (const bool face_colours : {true, false}) {
      struct Head {
        const char* keyword;
        uint64_t values;
      };
      Mesh first;
      for (const Head& head : {Head{"OFF", 0}, Head{"NOFF", 3}, Head{"COFF", 4}, Head{"COFF", 3},
                               Head{"STCNOFF", 9}, Head{"STOFF", 2}}) {
        const BinaryForm form{big_endian, face_colours, head.values};
        const std::string bytes =
            BinaryOff(head.keyword + std::string(" BINARY\r\n"), form, 20, 30, 7);
        const Result<Mesh> mesh = MeshOf(bytes, "a.off");
        ASSERT_TRUE(mesh.ok()) << head.keyword << mesh.error().message;
      }
    }
  }
}

TEST(BinaryOff, ThatDoesNotEndWithItsFacesIsRefused) {
  for (const bool geomview : {true, false}) {
    const std::string bytes = BinaryOff("OFF BINARY\n", {geomview, geomview, 0}, 9, 9, 1);
    for (size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_NE(InputErrorOf(bytes.substr(0, size), "a.off"), "") << size;
    }
    ExpectFault(bytes + "x", "binary OFF: the vertices and faces that the counts announce do not");
  }
}

TEST(BinaryOff, NamesTheFaceOfABadIndex) {
  std::string bytes = BinaryOff("OFF BINARY\n", {false, false, 0}, 1, 0, 1);
  bytes[15] = 1;
  bytes += std::string("\3\0\0\0\0\0\0\0\0\0\0\0\1\0\0\0", 16);
  ExpectFault(bytes, "the face at byte 35: the vertex index 1 is not below the count of 1");
}

}  // namespace
}  // namespace folprom::io
