// What OBJ and OFF files have beside positions and faces comes back, in their own format and in
// PLY.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/order/plain_mesh.h"
#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/temporary_folder.h"

namespace folprom::support {
namespace {

constexpr const char* kObj =
    "# 4 vertices, 3 faces\n"
    "mtllib a b.mtl\n"
    "v 0 0 0 1 0 0.5\n"
    "v 1 0 0 0 1 0.25\n"
    "v 0 1 0 0 0 1\n"
    "v 1 1 2 0.1 0.5 0.5\n";

/// The same faces by other words: names in any place, lists before all, indices from the end.
constexpr const char* kObjFaces =
    "vt 0 0\nvt 1 0\nvt 9 9\nvt 0 1\nvt 0.5 0.75\nvn 0 0 1\n"
    "g other\no body\ng left side\nusemtl brass\ns 1\n"
    "f 1/1/1 2/2/1 3/4/1\nusemtl steel\nf -3/-4 -1/-1 -2/-2\ns off\nf 1 2 4 3\n";
constexpr const char* kObjFacesBack =
    "o body\ng left side\nusemtl brass\ns 1\n"
    "vt 0 0\nvn 0 0 1\nvt 1 0\nvt 0 1\nf 1/1/1 2/2/1 3/3/1\n"
    "usemtl steel\nvt 0.5 0.75\nf 2/2 4/4 3/3\ns off\nf 1 2 4 3\n";

EncodeOptions Exact(bool keep_order) {
  EncodeOptions options;
  options.exact = true;
  options.keep_order = keep_order;
  options.overwrite = true;
  return options;
}

std::string TextOf(const std::string& path) {
  const std::vector<uint8_t> bytes = FileBytes(path);
  return {bytes.begin(), bytes.end()};
}

/// Encodes the text, decodes it in its own format, and returns that.
std::string Back(const std::string& text, const std::string& ending, bool keep_order = true) {
  const TemporaryFolder folder;
  const std::string scan = folder.File("scan" + ending);
  WriteBytes(scan, text);
  const EncodeReport report = Encode(scan, folder.File("scan.folp"), Exact(keep_order));
  for (const std::string& warning : report.warnings) ADD_FAILURE() << warning;
  const DecodeReport decoded = Decode(folder.File("scan.folp"), folder.File("back" + ending));
  for (const std::string& warning : decoded.warnings) ADD_FAILURE() << warning;
  const VerifyReport verified = Verify(folder.File("scan.folp"), scan);
  EXPECT_TRUE(verified.lossless) << verified.reason;
  // What was written says the same.
  const VerifyReport again = Verify(folder.File("scan.folp"), folder.File("back" + ending));
  EXPECT_TRUE(again.lossless || !keep_order) << again.reason;
  return TextOf(folder.File("back" + ending));
}

TEST(ObjValues, ComeBack) {
  std::string faces = kObjFaces;
  faces.erase(faces.find("g other\n"), 8);
  EXPECT_EQ(Back(std::string(kObj) + faces, ".obj"), std::string(kObj) + kObjFacesBack);
}

TEST(ObjValues, ComeBackWithoutAnOrder) {
  const std::string back = Back(std::string(kObj) + kObjFaces, ".obj", false);
  for (const char* line : {"mtllib a b.mtl\n", "v 0 0 0 1 0 0.5\n", "g left side\n",
                           "usemtl brass\n", "usemtl steel\n", "vt 0.5 0.75\n", "vn 0 0 1\n"}) {
    EXPECT_NE(back.find(line), std::string::npos) << line << back;
  }
}

TEST(ObjValues, StandOnceThoughManyFacesShareThem) {
  constexpr int kSide = 40;
  std::string vertices, textures, faces;
  for (int v = 0; v < kSide * kSide; ++v) {
    const std::string xy = std::to_string(v % kSide) + " " + std::to_string(v / kSide);
    vertices.append("v ").append(xy).append(" 0\n");
    textures.append("vt ").append(xy).append("\n");
    if (v % kSide + 1 == kSide || v / kSide + 1 == kSide) continue;
    faces.append("f");
    for (const int corner : {v + 1, v + 2, v + kSide + 2, v + kSide + 1}) {
      const std::string number = std::to_string(corner);
      faces.append(" ").append(number).append("/").append(number);
    }
    faces.append("\n");
  }
  const std::string back = Back(vertices.append(textures).append(faces), ".obj");
  size_t lines = 0;
  for (size_t at = 0; (at = back.find("\nvt ", at)) != std::string::npos; ++at) ++lines;
  EXPECT_EQ(lines, size_t{kSide * kSide});
}

TEST(ObjValues, StandInPlyWithTheirNames) {
  const TemporaryFolder folder;
  WriteBytes(folder.File("scan.obj"), std::string(kObj) + kObjFaces);
  Encode(folder.File("scan.obj"), folder.File("scan.folp"), Exact(true));
  Decode(folder.File("scan.folp"), folder.File("back.ply"));
  const std::string ply = TextOf(folder.File("back.ply"));
  for (const char* line :
       {"obj_info material 1 brass\n", "obj_info material 2 steel\n", "obj_info group 1 other\n",
        "obj_info group 2 left side\n", "obj_info mtllib a b.mtl\n", "property float red\n",
        "property uint material\n", "property list uchar float texcoord\n",
        "property list uchar float normal\n"}) {
    EXPECT_NE(ply.find(line), std::string::npos) << line;
  }
  const PlainMesh mesh = ReadPlain(folder.File("back.ply"));
  ASSERT_EQ(mesh.face_lists.size(), 3u);
  EXPECT_EQ(mesh.face_lists[0][0].size(), 3 * 2 * sizeof(float));
  EXPECT_EQ(mesh.face_lists[2][1].size(), 4 * 3 * sizeof(float));
  // From there to OBJ nothing is lost either.
  Encode(folder.File("back.ply"), folder.File("ply.folp"), Exact(true));
  EXPECT_TRUE(Decode(folder.File("ply.folp"), folder.File("back.obj")).warnings.empty());
  std::string faces = kObjFacesBack;
  EXPECT_EQ(TextOf(folder.File("back.obj")), std::string(kObj) + faces);
}

TEST(ObjValues, ThatContradictThemselvesAreNamed) {
  const auto error_of = [](const std::string& faces) -> std::string {
    const TemporaryFolder folder;
    WriteBytes(folder.File("scan.obj"), std::string(kObj) + "vt 0 0\n" + faces);
    try {
      Encode(folder.File("scan.obj"), folder.File("scan.folp"), Exact(true));
      return "";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.error().kind, ErrorKind::kInput);
      return failure.error().message;
    }
  };
  EXPECT_NE(error_of("f 1/2 2/1 3/1\n").find("the index 2 is none of the 1 vt"), std::string::npos);
  EXPECT_NE(error_of("f 1/0 2/1 3/1\n").find("the index 0 is none"), std::string::npos);
  EXPECT_NE(error_of("f 1/-2 2/1 3/1\n").find("the index -2 is none"), std::string::npos);
  EXPECT_NE(error_of("vt a\nf 1/1 2/1 3/1\n").find("not a number"), std::string::npos);
}

TEST(OffValues, OfAllLettersComeBack) {
  const std::string off =
      "STCNOFF\n4 3 0\n"
      "0 0 0 0 0 1 255 0 7 0.5 0.25\n"
      "1 0 0 0 0.6 0.8 254 0 7 0.5 0.125\n"
      "0 1 0 0 0 -1 253 9 7 0.5 0.5\n"
      "1 1 2 1 0 0 252 0 7 0.1 0.25\n"
      "3 0 1 2 10 20 30\n3 2 1 3\n4 0 1 3 2 5 6 7 255\n";
  EXPECT_EQ(Back(off, ".off"), off);
}

TEST(OffValues, OfFloatColoursComeBack) {
  const std::string off =
      "COFF\n3 2 0\n0 0 0 0.5 1.0 0.0 1.0\n1 0 0 1.0 1.0 1.0 1.0\n0 1 0 0.25 0.0 0.0 0.0\n"
      "3 0 1 2 0.5 1.0 0.0\n3 2 1 0 1.0 1.0 1.0\n";
  EXPECT_EQ(Back(off, ".off"), off);
  const std::string index = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7\n3 2 1 0 -1\n";
  EXPECT_EQ(Back(index, ".off"), index);
}

TEST(OffValues, OfBinaryFilesComeBack) {
  std::string off = "CNOFF BINARY\n";
  const auto put = [&](const void* value) {
    const auto* bytes = static_cast<const char*>(value);
    off.append({bytes[3], bytes[2], bytes[1], bytes[0]});
  };
  const auto put_count = [&](uint32_t value) { put(&value); };
  const auto put_float = [&](float value) { put(&value); };
  for (const uint32_t count : {3u, 2u, 0u}) put_count(count);
  for (int vertex = 0; vertex < 3; ++vertex) {
    for (int i = 0; i < 10; ++i) put_float(static_cast<float>(vertex * i) / 8);
  }
  for (const uint32_t number : {3u, 0u, 1u, 2u, 0u, 3u, 2u, 1u, 0u, 3u}) put_count(number);
  for (const float part : {0.5F, 1.0F, 0.0F}) put_float(part);
  const TemporaryFolder folder;
  WriteBytes(folder.File("scan.off"), off);
  Encode(folder.File("scan.off"), folder.File("scan.folp"), Exact(true));
  EXPECT_TRUE(Decode(folder.File("scan.folp"), folder.File("back.off")).warnings.empty());
  EXPECT_EQ(TextOf(folder.File("back.off")),
            "CNOFF\n3 2 0\n0 0 0 0 0 0 0.0 0.0 0.0 0.0\n"
            "0 0.125 0.25 0.375 0.5 0.625 0.75 0.875 1.0 1.125\n"
            "0 0.25 0.5 0.75 1 1.25 1.5 1.75 2.0 2.25\n3 0 1 2\n3 2 1 0 0.5 1.0 0.0\n");
  const VerifyReport verified = Verify(folder.File("scan.folp"), folder.File("scan.off"));
  EXPECT_TRUE(verified.lossless) << verified.reason;
}

/// A scan of bytes gives parts of 1, as OBJ has them; what OBJ has not is named.
TEST(ObjValues, TakeColoursAndNormalsOfVerticesFromPly) {
  const TemporaryFolder folder;
  WriteBytes(folder.File("scan.ply"),
             "ply\nformat ascii 1.0\ncomment one\nelement vertex 3\nproperty float x\n"
             "property float y\nproperty float z\nproperty float nx\nproperty float ny\n"
             "property float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
             "property float quality\nelement face 1\nproperty list uchar int vertex_indices\n"
             "end_header\n0 0 0 0 0 1 255 0 51 7\n1 0 0 0 0 1 0 0 0 8\n0 1 0 0 1 0 0 0 0 9\n"
             "3 0 1 2\n");
  Encode(folder.File("scan.ply"), folder.File("scan.folp"), Exact(true));
  const DecodeReport decoded = Decode(folder.File("scan.folp"), folder.File("back.obj"));
  ASSERT_EQ(decoded.warnings.size(), 2u);
  EXPECT_NE(decoded.warnings[0].find("lost are: quality"), std::string::npos);
  EXPECT_NE(decoded.warnings[1].find("comments"), std::string::npos);
  EXPECT_EQ(TextOf(folder.File("back.obj")),
            "# 3 vertices, 1 faces\nv 0 0 0 1 0 0.2\nvn 0 0 1\nv 1 0 0 0 0 0\nvn 0 0 1\n"
            "v 0 1 0 0 0 0\nvn 0 1 0\nf 1//1 2//2 3//3\n");
}

}  // namespace
}  // namespace folprom::support
