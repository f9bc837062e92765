// What faces and their corners have beside vertices comes back bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "parallel/runner.h"
#include "tests/order/plain_mesh.h"
#include "tests/order/quads.h"
#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace folprom::support {
namespace {

template <class T>
std::string BytesOf(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// A binary PLY file of a grid whose vertices tell each other apart.
class Scan {
 public:
  explicit Scan(int64_t side) : side_(side) {
    for (int64_t i = 0; i < side * side; ++i) {
      body_ += BytesOf(static_cast<float>(i % side)) + BytesOf(static_cast<float>(i / side)) +
               BytesOf(static_cast<float>(i * i % 7));
    }
  }

  Faces Triangles() const {
    Faces faces;
    for (const auto& quad : Quads()) {
      faces.push_back({quad[0], quad[1], quad[2]});
      faces.push_back({quad[2], quad[3], quad[0]});
    }
    return faces;
  }
  Faces Quads() const { return support::Quads(side_); }

  /// before, behind: property lines. values(face, is_behind): the bytes of a face there.
  template <class Values>
  std::string File(const Faces& faces, const std::string& before, const std::string& behind,
                   Values values) const {
    std::string file = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                       std::to_string(side_ * side_) +
                       "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                       std::to_string(faces.size()) + "\n" + before +
                       "property list uchar int vertex_indices\n" + behind + "end_header\n" + body_;
    for (const auto& face : faces) {
      file += values(face, false) + static_cast<char>(face.size());
      for (const int64_t corner : face) file += BytesOf(static_cast<int32_t>(corner));
      file += values(face, true);
    }
    return file;
  }

 private:
  int64_t side_;
  std::string body_;
};

constexpr const char* kScalars =
    "property uchar red\nproperty char flag\nproperty ushort group\nproperty short level\n"
    "property uint id\nproperty int material\nproperty float quality\nproperty double area\n";

/// Of all eight types, some smooth, some the same for many faces, some wild.
std::string ScalarsOf(Random& random, int64_t first) {
  const auto wild = random.Below(20) == 0 ? random.Next() : static_cast<uint64_t>(first);
  return BytesOf(static_cast<uint8_t>(first / 7)) + BytesOf(static_cast<int8_t>(-(first / 40))) +
         BytesOf(static_cast<uint16_t>(wild)) + BytesOf(static_cast<int16_t>(first % 3 - 1)) +
         BytesOf(static_cast<uint32_t>(wild)) + BytesOf(int32_t{-5}) +
         BytesOf(static_cast<uint32_t>(random.Below(9) == 0 ? random.Next() : 0x3f800000)) +
         BytesOf(static_cast<double>(first) / 3);
}

/// Texture coordinates with a seam, corner by corner.
std::string TextureOf(const std::vector<int64_t>& face) {
  std::string values;
  for (const int64_t corner : face) {
    const bool beyond = face[0] % 20 > 12;
    values += BytesOf(static_cast<float>(corner % 20) / 64 + (beyond ? 0.5F : 0.0F)) +
              BytesOf(static_cast<float>(corner) / 1000);
  }
  return values;
}

std::string WildTexture(Random& random, size_t corners) {
  std::string values;
  for (size_t i = 0; i < 2 * corners; ++i) {
    values += BytesOf(random.Below(3) > 0 ? static_cast<uint32_t>(random.Below(4)) << 28
                                          : static_cast<uint32_t>(random.Next()));
  }
  return values;
}

EncodeOptions Exact(bool keep_order) {
  EncodeOptions options;
  options.exact = true;
  options.keep_order = keep_order;
  options.codec.subtree_vertices = 60;
  options.overwrite = true;
  return options;
}

/// A face as bytes, with its values, turned so that its corners are least.
std::string TurnedFace(const PlainMesh& mesh, size_t face) {
  const size_t corners = mesh.faces[face].size();
  std::string least;
  for (size_t turn = 0; turn < corners; ++turn) {
    std::string bytes;
    for (size_t i = 0; i < corners; ++i) {
      const size_t corner = (i + turn) % corners;
      bytes += mesh.vertices[static_cast<size_t>(mesh.faces[face][corner])];
      for (const std::string& list : mesh.face_lists[face]) {
        bytes += list.substr(corner * list.size() / corners, list.size() / corners);
      }
    }
    if (turn == 0 || bytes < least) least = bytes;
  }
  return least + mesh.face_scalars[face];
}

std::vector<std::string> FaceSet(const PlainMesh& mesh) {
  std::vector<std::string> faces;
  for (size_t face = 0; face < mesh.faces.size(); ++face) faces.push_back(TurnedFace(mesh, face));
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// With and without the order of the scan.
void ExpectValuesBack(const std::string& scan) {
  const TemporaryFolder folder;
  WriteBytes(folder.File("scan.ply"), scan);
  const PlainMesh wanted = ReadPlain(folder.File("scan.ply"));
  DecodeOptions force;
  force.overwrite = true;
  for (const bool keep_order : {true, false}) {
    SCOPED_TRACE(keep_order);
    const EncodeReport report =
        Encode(folder.File("scan.ply"), folder.File("scan.folp"), Exact(keep_order));
    EXPECT_TRUE(report.warnings.empty());
    EXPECT_GT(report.face_attribute_bytes, 0u);
    Decode(folder.File("scan.folp"), folder.File("back.ply"), force);
    const PlainMesh back = ReadPlain(folder.File("back.ply"));
    EXPECT_TRUE(FaceSet(back) == FaceSet(wanted));
    if (keep_order) {
      EXPECT_TRUE(back.faces == wanted.faces);
      EXPECT_TRUE(back.face_scalars == wanted.face_scalars);
      EXPECT_TRUE(back.face_lists == wanted.face_lists);
    }
    const VerifyReport verified = Verify(folder.File("scan.folp"), folder.File("scan.ply"));
    EXPECT_TRUE(verified.lossless) << verified.reason;
    EXPECT_EQ(verified.face_attributes, report.face_attributes.size());
    EXPECT_TRUE(Verify(folder.File("scan.folp"), "").lossless);
  }
}

TEST(FaceValues, OfAllTypesComeBack) {
  Random random(1);
  const Scan scan(20);
  const auto values = [&](const std::vector<int64_t>& face, bool is_behind) {
    return is_behind ? std::string() : ScalarsOf(random, face[0]);
  };
  ExpectValuesBack(scan.File(scan.Triangles(), kScalars, "", values));
  ExpectValuesBack(scan.File(scan.Quads(), kScalars, "", values));
}

constexpr const char* kTexture = "property list uchar float texcoord\nproperty int material\n";

TEST(FaceValues, OfCornersComeBack) {
  const Scan scan(20);
  const auto values = [&](const std::vector<int64_t>& face, bool is_behind) {
    if (!is_behind) return std::string();
    return static_cast<char>(2 * face.size()) + TextureOf(face) +
           BytesOf(static_cast<int32_t>(face[0] / 50));
  };
  ExpectValuesBack(scan.File(scan.Triangles(), "", kTexture, values));
  ExpectValuesBack(scan.File(scan.Quads(), "", kTexture, values));
}

/// Copies of faces, of other values; any size; corners and edges that come again.
TEST(FaceValues, OfWildFacesComeBack) {
  Random random(2);
  const Scan scan(8);
  Faces faces;
  for (int i = 0; i < 150; ++i) {
    std::vector<int64_t> face(3 + random.Below(random.Below(10) == 0 ? 40 : 3));
    for (int64_t& corner : face) corner = static_cast<int64_t>(random.Below(64));
    if (random.Below(6) == 0) face[1] = face[0];
    faces.push_back(face);
    if (random.Below(3) == 0) faces.push_back(face);
    if (random.Below(6) == 0) faces.emplace_back(face.rbegin(), face.rend());
  }
  faces.push_back({0, 0, 0, 0, 0});
  faces.push_back({1, 2, 1, 2, 1, 2});
  faces.push_back({3, 3, 3});
  const auto values = [&](const std::vector<int64_t>& face, bool is_behind) {
    if (!is_behind) return ScalarsOf(random, face[0]);
    return static_cast<char>(2 * face.size()) + WildTexture(random, face.size()) +
           BytesOf(static_cast<int32_t>(random.Below(3)));
  };
  std::string behind = kTexture;
  behind.replace(behind.find("material"), 8, "other");
  ExpectValuesBack(scan.File(faces, kScalars, behind, values));
  std::erase_if(faces, [](const auto& face) { return face.size() != 3; });
  ExpectValuesBack(scan.File(faces, kScalars, behind, values));
}

/// Texture coordinates of a chart: each vertex has one, or two at the seam.
TEST(FaceValues, ThatFollowFromOthersTakeFewBits) {
  const TemporaryFolder folder;
  const Scan scan(60);
  const Faces faces = scan.Triangles();
  WriteBytes(folder.File("scan.ply"),
             scan.File(faces, "", "property uchar red\nproperty uchar green\n",
                       [](const std::vector<int64_t>& face, bool is_behind) {
                         if (!is_behind) return std::string();
                         return BytesOf(static_cast<uint8_t>(face[0] / 600 * 40)) +
                                BytesOf(static_cast<uint8_t>(face[0] / 600));
                       }));
  const EncodeReport report =
      Encode(folder.File("scan.ply"), folder.File("scan.folp"), Exact(false));
  EXPECT_LT(8 * report.face_attribute_bytes, faces.size() / 2);
}

TEST(FaceValues, AreTheSameFromMemory) {
  Random random(3);
  const TemporaryFolder folder;
  const Scan scan(20);
  WriteBytes(folder.File("scan.ply"),
             scan.File(scan.Quads(), kScalars, "property list uchar float texcoord\n",
                       [&](const std::vector<int64_t>& face, bool is_behind) {
                         if (!is_behind) return ScalarsOf(random, face[0]);
                         return static_cast<char>(2 * face.size()) + TextureOf(face);
                       }));
  Encode(folder.File("scan.ply"), folder.File("scan.folp"), Exact(true));
  const Mesh mesh = LodOf(folder.File("scan.folp"));
  const PlainMesh wanted = ReadPlain(folder.File("scan.ply"));
  ASSERT_EQ(mesh.face_attributes.size(), 9u);
  ASSERT_EQ(mesh.polygon_begin.size(), wanted.faces.size());
  for (size_t face = 0; face < wanted.faces.size(); ++face) {
    const auto triangle = static_cast<size_t>(mesh.polygon_begin[face]);
    std::string scalars;
    for (size_t a = 0; a < 8; ++a) {
      const auto& values = mesh.face_attributes[a].values;
      const size_t size = ScalarSize(mesh.face_attributes[a].type);
      scalars.append(reinterpret_cast<const char*>(&values[triangle * size]), size);
    }
    EXPECT_EQ(scalars, wanted.face_scalars[face]);
    const auto* corners =
        reinterpret_cast<const char*>(&mesh.face_attributes[8].values[triangle * 24]);
    EXPECT_EQ(std::string(corners, 24), wanted.face_lists[face][0].substr(0, 24));
  }
  EXPECT_TRUE(LodOf(folder.File("scan.folp"), 1).face_attributes.empty());
}

TEST(FaceValues, HaveTheSameBytesForAnyThreads) {
  Random random(4);
  const TemporaryFolder folder;
  const Scan scan(40);
  WriteBytes(folder.File("scan.ply"),
             scan.File(scan.Triangles(), kScalars, "",
                       [&](const std::vector<int64_t>& face, bool is_behind) {
                         return is_behind ? std::string() : ScalarsOf(random, face[0]);
                       }));
  Encode(folder.File("scan.ply"), folder.File("1.folp"), Exact(false));
  for (const int threads : {2, 8}) {
    const auto runner = parallel::MakeTbbRunner(threads);
    EncodeOptions options = Exact(false);
    options.limits.memory_bytes = uint64_t{1} << 20;
    Encode(folder.File("scan.ply"), folder.File("2.folp"), options, runner.get());
    EXPECT_TRUE(FileBytes(folder.File("1.folp")) == FileBytes(folder.File("2.folp")));
  }
}

std::string Joined(const std::vector<std::string>& warnings) {
  std::string text;
  for (const std::string& warning : warnings) text += warning + "\n";
  return text;
}

/// Lists of any length are none of corners; what is lost is named.
TEST(FaceValues, ThatAreNotKeptAreNamed) {
  const TemporaryFolder folder;
  const Scan scan(5);
  WriteBytes(folder.File("scan.ply"),
             scan.File(scan.Triangles(), "property uchar red\n", "property list uchar uchar tags\n",
                       [](const std::vector<int64_t>& face, bool is_behind) {
                         if (!is_behind) return BytesOf(static_cast<uint8_t>(face[0]));
                         return static_cast<char>(face[0] % 4) +
                                std::string(static_cast<size_t>(face[0] % 4), 'x');
                       }));
  EncodeReport report = Encode(folder.File("scan.ply"), folder.File("scan.folp"), Exact(false));
  EXPECT_EQ(Joined(report.warnings), "properties not kept: face.tags\n");
  EXPECT_NE(Joined(Decode(folder.File("scan.folp"), folder.File("back.stl")).warnings).find("red"),
            std::string::npos);
  DecodeOptions first;
  first.layers = 1;
  EXPECT_NE(Joined(Decode(folder.File("scan.folp"), folder.File("lod.ply"), first).warnings)
                .find("with the whole mesh only"),
            std::string::npos);
  EncodeOptions bare = Exact(false);
  bare.attributes = false;
  report = Encode(folder.File("scan.ply"), folder.File("scan.folp"), bare);
  EXPECT_EQ(Joined(report.warnings), "properties not kept: face.tags, face.red\n");
  EXPECT_TRUE(Verify(folder.File("scan.folp"), folder.File("scan.ply")).lossless);
}

/// Another value is another scan.
TEST(FaceValues, ThatDifferAreSeenByVerify) {
  for (const bool keep_order : {true, false}) {
    const TemporaryFolder folder;
    const Scan scan(6);
    for (const uint8_t last : {uint8_t{1}, uint8_t{2}}) {
      WriteBytes(folder.File(last == 1 ? "1.ply" : "2.ply"),
                 scan.File(scan.Triangles(), "property uchar red\n", "",
                           [&](const std::vector<int64_t>& face, bool is_behind) {
                             if (is_behind) return std::string();
                             return BytesOf(face[0] == 7 ? last : uint8_t{0});
                           }));
    }
    Encode(folder.File("1.ply"), folder.File("1.folp"), Exact(keep_order));
    EXPECT_TRUE(Verify(folder.File("1.folp"), folder.File("1.ply")).lossless);
    const VerifyReport verified = Verify(folder.File("1.folp"), folder.File("2.ply"));
    EXPECT_FALSE(verified.lossless);
    EXPECT_NE(verified.reason.find("attribute of a face"), std::string::npos) << verified.reason;
  }
}

}  // namespace
}  // namespace folprom::support
