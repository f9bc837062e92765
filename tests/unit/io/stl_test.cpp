// STL files, binary and text.
#include <gtest/gtest.h>

#include <cstring>

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

void ExpectFault(const std::string& bytes, const std::string& part) {
  EXPECT_NE(InputErrorOf(bytes, "a.stl").find("a.stl: " + part), std::string::npos)
      << InputErrorOf(bytes, "a.stl");
}

std::string BinaryStl(const std::string& title, uint32_t facets, uint64_t seed,
                      uint16_t attributes = 0) {
  std::string bytes = title + std::string(80 - title.size(), '\0');
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(facets);
  support::Random random(seed);
  for (uint32_t f = 0; f < facets; ++f) {
    for (int i = 0; i < 12; ++i) put(static_cast<float>(random.Between(-9, 9)));
    put(attributes);
  }
  return bytes;
}

std::string Facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 1\n outer loop\n  vertex " + a + "\n  vertex " + b + "\n  vertex " + c +
         "\n endloop\nendfacet\n";
}

TEST(BinaryStl, GivesWhatAPlainReaderGives) {
  for (const uint32_t facets : {0u, 1u, 21845u, 21846u, 70000u}) {
    const std::string bytes = BinaryStl("by a test", facets, facets);
    const Mesh mesh = MeshOf(bytes, "a.stl").value();
    const Mesh plain = testing::PlainBinaryStl(bytes);
    EXPECT_TRUE(mesh.xyz == plain.xyz) << facets;
    EXPECT_TRUE(mesh.triangles == plain.triangles) << facets;
    EXPECT_EQ(mesh.triangles.size(), facets);
  }
}

TEST(BinaryStl, IsKnownByItsSizeWhateverItsHeaderSays) {
  const std::string bytes = BinaryStl("solid as text would begin\nfacet", 3, 1);
  for (const char* name : {"a.stl", "a.STL", "a", "a.obj"}) {
    EXPECT_EQ(MeshOf(bytes, name).value().triangles.size(), 3u) << name;
  }
}

TEST(BinaryStl, NamesWhatIsNotCoded) {
  const TemporaryFolder folder;
  const auto names = [&](const std::string& bytes) {
    return OpenBytes(folder, bytes, "a.stl").value()->notes().ignored_properties;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(BinaryStl("", 2, 1)), Names{"facet normals"});
  EXPECT_EQ(names(BinaryStl("", 2, 1, 7)), (Names{"facet normals", "attribute bytes of facets"}));
  EXPECT_EQ(names(BinaryStl("", 0, 1)), Names{});
  EXPECT_EQ(names(BinaryStl("", 0, 1) + "\n"), Names{"what lies behind the last facet (1 B)"});
  std::string no_normals = BinaryStl("", 1, 1);
  std::fill_n(no_normals.begin() + 84, 12, '\0');
  EXPECT_EQ(names(no_normals), Names{});
}

TEST(BinaryStl, OfAnotherSizeThanItsCountIsRefused) {
  for (const char* title : {"", "solid x"}) {
    const std::string bytes = BinaryStl(title, 3, 1);
    ExpectFault(bytes.substr(0, bytes.size() - 1),
                "binary STL: 3 facets are announced, but the file holds 2");
    ExpectFault(bytes + std::string(50, 'x'),
                "binary STL: 3 facets are announced, but the file holds 4");
    ExpectFault(bytes.substr(0, 83), "binary STL: the file ends in the header, 83 of 84 bytes");
  }
}

TEST(TextStl, ReadsSeveralSolidsAnyCaseAndLineEnds) {
  const std::string text = "SOLID a b facet\n" + Facet("0 0 0", "1 0 0", "0 1 0") +
                           "ENDSOLID a b facet\n\nsolid\r\n" +
                           "FACET NORMAL 0 0 1 OUTER LOOP VERTEX 0 0 5 vertex 1e0 0 5\r\nvertex " +
                           "0 +1 5 endloop\r\rendfacet\rendsolid";
  const TemporaryFolder folder;
  const auto source = OpenBytes(folder, text, "a.stl").value();
  const Mesh mesh = AllBlocks(*source).value();
  EXPECT_EQ(mesh.xyz, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0,  //
                                           0, 0, 5, 1, 0, 5, 0, 1, 5}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(source->notes().ignored_properties,
            (std::vector<std::string>{"facet normals", "the parting into 2 solids"}));
  EXPECT_EQ(source->coordinate_type(), ScalarType::kFloat32);
}

TEST(TextStl, KeepsDoubles) {
  const TemporaryFolder folder;
  const std::string text =
      "solid\n" + Facet("0 0 0", "1 0 4512345.123", "0.123456789 1 0") + "endsolid\n";
  const auto source = OpenBytes(folder, text, "a.stl").value();
  EXPECT_EQ(source->coordinate_type(), ScalarType::kFloat64);
  EXPECT_EQ(AllBlocks(*source).value().xyz[5], 4512345.123);
}

TEST(TextStl, WithoutFacetsIsAnEmptyMesh) {
  EXPECT_TRUE(MeshOf("solid Empty\nendsolid Empty", "a.stl").value().xyz.empty());
}

TEST(TextStl, NamesTheLineOfAFault) {
  const std::string facet = Facet("0 0 0", "1 0 0", "0 1 0");
  ExpectFault("solid\n" + facet, "line 9: the file ends before endsolid");
  ExpectFault("solid\n" + facet + "facet normal 0 0", "line 9: the file ends in a facet");
  ExpectFault("solid\n" + facet + "endsolid\nfacet", "line 10: \"facet\" is not solid");
  ExpectFault("solid\n" + facet + "facets\n", "line 9: \"facets\" is neither facet nor endsolid");
  ExpectFault("solid\n" + Facet("0 0", "1 0 0", "0 1 0"), "line 4: the line has fewer than three");
  ExpectFault("solid\n" + Facet("0 0 0", "1 0 x", "0 1 0"), "line 5: \"x\" is not a number");
  ExpectFault("solid\n" + Facet("0 0 0", "1 0 0", "0 1 0\nvertex 1 1 1"),
              "line 7: \"vertex\" is in the place of endloop");
}

std::string RandomTextStl(int facets, int decimals) {
  support::Random random(5);
  std::string text = "solid random\n";
  for (int f = 0; f < facets; ++f) {
    std::string corners[3];
    for (std::string& corner : corners) {
      for (int i = 0; i < 3; ++i)
        corner.append(" ").append(testing::RandomDecimal(random, decimals));
    }
    text += Facet(corners[0], corners[1], corners[2]);
    if (f % 10000 == 9999) text += "endsolid random\n\nsolid next\n";
  }
  return text + "endsolid";
}

TEST(TextStl, GivesWhatAPlainReaderGives) {
  for (const auto& [decimals, type] :
       {std::pair{2, ScalarType::kFloat32}, std::pair{9, ScalarType::kFloat64}}) {
    const std::string text = RandomTextStl(45000, decimals);
    testing::ExpectSameAsPlain(
        text, "a.stl", type, [&](bool as_float) { return testing::PlainTextStl(text, as_float); });
  }
}

}  // namespace
}  // namespace folprom::io
