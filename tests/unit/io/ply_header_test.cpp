#include "io/formats/ply_header.h"

#include <gtest/gtest.h>

#include "support.h"

namespace folprom::io {
namespace {

using testing::InputErrorOf;
using testing::MeshOf;

constexpr std::string_view kVertices =
    "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";

std::string Ascii(const std::string& header, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}

void ExpectFault(const std::string& bytes, const std::string& reason) {
  const std::string message = InputErrorOf(bytes);
  EXPECT_NE(message.find(reason), std::string::npos) << "\"" << message << "\" for:\n" << bytes;
  EXPECT_NE(message.find("scan.ply: "), std::string::npos) << message;
}

TEST(PlyHeader, AcceptsCommentsBlankLinesTabsAndWindowsLineEnds) {
  const std::string bytes =
      "ply\r\ncomment hi\r\nformat ascii 1.0\r\n\r\nobj_info x y\r\nelement  vertex\t1 \r\n"
      "property float x\r\ncomment\r\nproperty float y\r\nproperty float z\r\nend_header\r\n"
      "1 2 3\r\n";
  EXPECT_EQ(MeshOf(bytes).value().xyz, (std::vector<double>{1, 2, 3}));
}

TEST(PlyHeader, FindsTheBodyBehindWindowsLineEnds) {
  const std::string bytes =
      "ply\r\nformat binary_little_endian 1.0\r\nelement vertex 1\r\nproperty char x\r\n"
      "property char y\r\nproperty char z\r\nend_header\r\n\n\r\n";
  EXPECT_EQ(MeshOf(bytes).value().xyz, (std::vector<double>{10, 13, 10}));
}

TEST(PlyHeader, NamesTheKnownFormatsForAnyOtherFile) {
  for (const std::string bytes : {"glTF", "pl", "ply", "ply\r", "plyx\n", "\n", "PLY\n", "ply "}) {
    ExpectFault(bytes, "unsupported format (known formats: PLY, OBJ, STL, OFF)");
  }
  ExpectFault("", "the file is empty");
}

TEST(PlyHeader, RefusesNamesThatWouldGarbleATerminal) {
  for (const std::string name : {"a\x1b[2Jb", "a\x07", "\x7f", "a\rb", "gr\xc3\xbcn"}) {
    ExpectFault(Ascii("element " + name + " 0\n" + std::string(kVertices), "1 2 3\n"),
                "line 3: the name \"");
    const std::string fault =
        InputErrorOf(Ascii(std::string(kVertices) + "property float " + name + "\n", "1 2 3 4\n"));
    EXPECT_NE(fault.find("not printable ASCII"), std::string::npos) << name;
    for (const char c : fault) EXPECT_TRUE(c >= ' ' && c <= '~');
  }
}

TEST(PlyHeader, NamesTheLineOfAFault) {
  ExpectFault("ply\nformat ascii 1.0\nelement vertex -5\n", "line 3: the count of element");
  ExpectFault("ply\nformat ascii 1.0\nelement vertex 18446744073709551616\n", "not a number");
  ExpectFault("ply\nformat ascii 1.0\nelement vertex 1e3\n", "not a number");
  ExpectFault("ply\nformat ascii 1.0\nelement vertex\n", "line 3: an element line has the form");
  ExpectFault("ply\nformat ascii 1.0\nproperty float x\n", "line 3: a property before");
  ExpectFault("ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n",
              "unknown type \"quad\"");
  ExpectFault("ply\nformat ascii 1.0\nelement vertex 1\nproperty float\n", "property line");
  ExpectFault("ply\nformat ascii 1.0\nelement vertex 1\nproperty list int x\n", "property line");
  ExpectFault("ply\nformat ascii 1.0\nelement f 1\nproperty list float int x\n", "count of a list");
  ExpectFault("ply\nformat ascii 1.0\nformat ascii 1.0\n", "line 3: a second format");
  ExpectFault("ply\nformat ascii 2.0\n", "line 2: unknown format version");
  ExpectFault("ply\nformat ebcdic 1.0\n", "line 2: unknown format");
  ExpectFault("ply\nformat\n", "line 2: a format line");
  ExpectFault("ply\nformat ascii 1.0\nfrobnicate\x1b[2J\n",
              "line 3: unknown keyword \"frobnicate?");
  ExpectFault("ply\nformat ascii 1.0\nelement a 0\nelement a 0\n", "line 4: a second element");
  ExpectFault("ply\nformat ascii 1.0\nelement a 0\nproperty int p\nproperty list int int p\n",
              "line 5: a second property \"p\"");
}

TEST(PlyHeader, NeedsFormatAndEnd) {
  ExpectFault("ply\n" + std::string(kVertices) + "end_header\n1 2 3\n", "no format line");
  ExpectFault("ply\nformat ascii 1.0\n" + std::string(kVertices), "ends before end_header");
  ExpectFault("ply\n", "ends before end_header");
}

TEST(PlyHeader, StopsReadingAtOneMebibyte) {
  std::string lines = "ply\nformat ascii 1.0\n";
  while (lines.size() < (1u << 20) + 100) lines += "comment and so on\n";
  for (const std::string& bytes : {lines + "end_header\n", "ply\n" + std::string(2 << 20, ' '),
                                   "ply\n" + std::string(2 << 20, '\n')}) {
    const auto mesh = testing::MeshOf(bytes);
    ASSERT_FALSE(mesh.ok());
    EXPECT_EQ(mesh.error().kind, ErrorKind::kLimit) << mesh.error().message;
    EXPECT_NE(mesh.error().message.find("first 1048576 bytes"), std::string::npos);
  }
}

TEST(PlyHeader, TakesTensOfThousandsOfProperties) {
  std::string header(kVertices);
  std::string body = "1 2 3";
  for (int i = 0; i < 30000; ++i) {
    header += "property char p" + std::to_string(i) + "\n";
    body += " 0";
  }
  EXPECT_EQ(MeshOf(Ascii(header, body)).value().xyz, (std::vector<double>{1, 2, 3}));
}

TEST(PlyLayout, NeedsVerticesWithThreeScalarCoordinates) {
  ExpectFault(Ascii("", ""), "no element vertex");
  ExpectFault(Ascii("element vertex 0\nproperty float x\nproperty float y\n", ""),
              "element vertex: has no property z");
  ExpectFault(Ascii("element vertex 1\nproperty list int float x\nproperty float y\n"
                    "property float z\n",
                    "1 1 2 3"),
              "element vertex: the property x is a list");
}

TEST(PlyLayout, NeedsFacesWithAListOfIntegers) {
  const std::string vertices(kVertices);
  ExpectFault(Ascii(vertices + "element face 1\nproperty int a\n", "1 2 3\n1\n"),
              "element face: has no property vertex_indices");
  ExpectFault(Ascii(vertices + "element face 1\nproperty int vertex_index\n", "1 2 3\n1\n"),
              "is not a list");
  ExpectFault(
      Ascii(vertices + "element face 1\nproperty list int float vertex_index\n", "1 2 3\n0\n"),
      "not of an integer type");
  ExpectFault(Ascii(vertices + "element tristrips 1\n", "1 2 3\n"), "element tristrips: has no");
}

TEST(PlyLayout, GivesNoTrianglesWithoutFaces) {
  const auto mesh = MeshOf(Ascii(std::string(kVertices), "1 2 3")).value();
  EXPECT_EQ(mesh.xyz, (std::vector<double>{1, 2, 3}));
  EXPECT_TRUE(mesh.triangles.empty());
  const auto none = MeshOf(Ascii(std::string(kVertices) + "element face 0\n", "1 2 3")).value();
  EXPECT_TRUE(none.triangles.empty());
}

TEST(PlyLayout, NamesWhatIsNotCoded) {
  const testing::TemporaryFolder folder;
  const auto source =
      testing::OpenBytes(
          folder, Ascii(std::string(kVertices) +
                            "property uchar red\nproperty list int int tags\n"
                            "element edge 1\nproperty int a\nelement none 0\nproperty int b\n"
                            "element face 0\nproperty list int int vertex_index\n",
                        "1 2 3 4 0\n5\n"))
          .value();
  EXPECT_EQ(source->notes().ignored_properties,
            (std::vector<std::string>{"vertex.tags", "edge.a"}));
}

TEST(PlyCounts, BeyondTheBytesLeftAreRefusedBeforeAnyAllocation) {
  for (const std::string count : {"2", "1000000000000", "18446744073709551615"}) {
    const std::string vertices =
        "element vertex " + count + "\nproperty float x\nproperty float y\nproperty float z\n";
    ExpectFault(Ascii(vertices, "1 2 3\n"), count + " records are announced");
    ExpectFault("ply\nformat binary_little_endian 1.0\n" + vertices + "end_header\n" +
                    std::string(12, '\0'),
                "element vertex: " + count + " records are announced");
    ExpectFault("ply\nformat binary_big_endian 1.0\n" + std::string(kVertices) + "element face " +
                    count + "\nproperty list uchar int vertex_indices\nend_header\n" +
                    std::string(13, '\0'),
                "element face: " + count + " records are announced");
  }
}

TEST(PlyCounts, OfAnElementWithoutPropertiesCostNothing) {
  const std::string header = "element ghost 18446744073709551615\n" + std::string(kVertices);
  EXPECT_EQ(MeshOf(Ascii(header, "1 2 3")).value().xyz.size(), 3u);
}

}  // namespace
}  // namespace folprom::io
