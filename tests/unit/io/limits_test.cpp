// What a scan may ask for, and that it may be raised.
#include "folprom/limits.h"

#include <gtest/gtest.h>

#include "support.h"

namespace folprom::io {
namespace {

using testing::TemporaryFolder;
using testing::WriteFile;

/// Opens the bytes under the limits; the error, "" where there is none.
Error ErrorUnder(const Limits& limits, std::string_view bytes, const std::string& name = "s.ply") {
  const TemporaryFolder folder;
  const std::string path = folder.File(name);
  WriteFile(path, bytes);
  const auto source = MeshSource::Open(path, limits);
  if (source) return {ErrorKind::kUsage, ""};
  EXPECT_TRUE(source.error().message.starts_with(path + ": ")) << source.error().message;
  return source.error();
}

void ExpectLimit(const Limits& limits, std::string_view bytes, const std::string& reason,
                 const std::string& name = "s.ply") {
  const Error error = ErrorUnder(limits, bytes, name);
  EXPECT_EQ(error.kind, ErrorKind::kLimit) << error.message;
  EXPECT_NE(error.message.find(reason), std::string::npos) << error.message;
}

constexpr std::string_view kPly =
    "ply\nformat ascii 1.0\ncomment one\ncomment two\nelement vertex 3\nproperty char x\n"
    "property char y\nproperty char z\nelement face 2\nproperty list uchar int vertex_indices\n"
    "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n";
constexpr std::string_view kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n";

TEST(Limits, OfVerticesAndFacesAreThoseOfEveryFormat) {
  for (const auto& [bytes, name] : {std::pair{kPly, "s.ply"}, {kObj, "s.obj"}}) {
    Limits limits;
    limits.vertices = 3;
    limits.faces = 2;
    EXPECT_EQ(ErrorUnder(limits, bytes, name).message, "");
    limits.vertices = 2;
    ExpectLimit(limits, bytes, "3 vertices are more than the limit of 2", name);
    limits.vertices = 3;
    limits.faces = 1;
    ExpectLimit(limits, bytes, "2 faces are more than the limit of 1", name);
  }
}

TEST(Limits, OfPropertiesCountThoseOfAllElements) {
  Limits limits;
  limits.properties = 4;
  EXPECT_EQ(ErrorUnder(limits, kPly).message, "");
  limits.properties = 3;
  ExpectLimit(limits, kPly, "4 properties are more than the limit of 3");
  std::string many = "ply\nformat ascii 1.0\nelement vertex 0\n";
  for (int i = 0; i < 5000; ++i) many += "property char a" + std::to_string(i) + "\n";
  many += "property char x\nproperty char y\nproperty char z\nend_header\n";
  limits.properties = 4096;
  ExpectLimit(limits, many, "4097 properties are more than the limit of 4096");
  limits.properties = 10000;
  EXPECT_EQ(ErrorUnder(limits, many).message, "");
}

TEST(Limits, OfTheHeaderEndItsSearchAndCanBeRaised) {
  const size_t header = kPly.find("0 0 0");
  Limits limits;
  limits.header_bytes = header + 1;
  EXPECT_EQ(ErrorUnder(limits, kPly).message, "");
  limits.header_bytes = header - 1;
  ExpectLimit(limits, kPly, "the limit of a header");
  std::string long_one(kPly);
  long_one.insert(4, "comment " + std::string(2 << 20, 'c') + "\n");
  ExpectLimit({}, long_one, "no end_header in the first 1048576 bytes");
  limits.header_bytes = 4 << 20;
  EXPECT_EQ(ErrorUnder(limits, long_one).message, "");
}

TEST(Limits, OfCommentsDropThoseBeyondAndCountThem) {
  const TemporaryFolder folder;
  const std::string path = folder.File("s.ply");
  WriteFile(path, kPly);
  Limits limits;
  limits.comment_bytes = std::string_view("comment one").size();
  auto source = MeshSource::Open(path, limits).value();
  EXPECT_EQ(source->remarks(), std::vector<std::string>{"comment one"});
  EXPECT_EQ(source->notes().remarks_dropped, 1u);

  std::string long_one(kPly);
  const std::string comment = "comment " + std::string(100'000, 'c');
  long_one.insert(4, comment + "\n");
  WriteFile(path, long_one);
  EXPECT_EQ(MeshSource::Open(path).value()->notes().remarks_dropped, 1u);
  limits.comment_bytes = 1 << 20;
  source = MeshSource::Open(path, limits).value();
  EXPECT_EQ(source->notes().remarks_dropped, 0u);
  EXPECT_EQ(source->remarks().front(), comment);
}

}  // namespace
}  // namespace folprom::io
