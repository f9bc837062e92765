// Real scans, and files that other programs' tests call malformed.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "plain_reader.h"
#include "support.h"

namespace folprom::io {
namespace {

using testing::AllBlocks;
using testing::FileContent;
using testing::Mesh;
using testing::SharedData;

Result<Mesh> ReadScan(const std::string& name) {
  Result<std::unique_ptr<MeshSource>> source = MeshSource::Open(SharedData() + name);
  if (!source) return source.error();
  return AllBlocks(**source);
}

// Each triangle from its lowest index on, sorted: equal for meshes of the same oriented triangles.
std::vector<Triangle> OrientedSet(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) std::ranges::rotate(t, std::ranges::min_element(t));
  std::ranges::sort(triangles);
  return triangles;
}

class SharedScan : public ::testing::Test {
 protected:
  void SetUp() override {
    if (SharedData().empty()) GTEST_SKIP() << "no shared data (set FOLPROM_SHARED)";
  }
};

TEST_F(SharedScan, StripsGiveTheTrianglesOfTheSameMeshInFaces) {
  const Mesh faces = ReadScan("scans/igea.ply").value();
  const Mesh strips = ReadScan("scans/igea_tristrips.ply").value();
  EXPECT_EQ(strips.triangles.size(), 268686u);
  EXPECT_EQ(strips.xyz, faces.xyz);
  EXPECT_EQ(OrientedSet(strips.triangles), OrientedSet(faces.triangles));
}

TEST_F(SharedScan, ScansHaveTheirKnownSizes) {
  struct Known {
    const char* name;
    size_t vertices, triangles;
  };
  for (const Known& known :
       {Known{"scans/dragon_vrip.ply", 437645, 871414},
        Known{"scans/lidar_site1.ply", 517360, 1033826}, Known{"scans/horse.ply", 19851, 39698},
        Known{"scans/venus_head.ply", 8268, 16532}, Known{"scans/fandisk.ply", 6475, 12946},
        Known{"hard/dragon_vrip_res2.ply", 100250, 202520},
        Known{"hard/abominevole.ply", 5021, 50706}, Known{"hard/truck.ply", 2956, 4770},
        Known{"hard/blobby-shuffled.ply", 2027, 4050}, Known{"hard/Laurana50k.ply", 27861, 49954},
        Known{"hard/bun_zipper.ply", 35947, 69451}, Known{"hard/box_longline.obj", 8, 944},
        Known{"hard/chair_model.obj", 3186, 12756}, Known{"hard/conrod__meshlab.stl", 19326, 6442},
        Known{"hard/soup_bunny.stl", 208353, 69451}, Known{"hard/dangling_edge2.off", 7, 8}}) {
    const Mesh mesh = ReadScan(known.name).value();
    EXPECT_EQ(mesh.xyz.size() / 3, known.vertices) << known.name;
    EXPECT_EQ(mesh.triangles.size(), known.triangles) << known.name;
  }
}

TEST_F(SharedScan, OtherFormatsGiveWhatAPlainReaderGives) {
  const auto expect_same = [](const std::string& name, const Mesh& plain) {
    const Mesh mesh = ReadScan(name).value();
    EXPECT_TRUE(mesh.xyz == plain.xyz) << name;
    EXPECT_TRUE(mesh.triangles == plain.triangles) << name;
  };
  const auto content = [](const char* name) { return FileContent(SharedData() + name); };
  for (const char* name : {"hard/box_longline.obj", "hard/chair_model.obj"}) {
    expect_same(name, testing::PlainObj(content(name), true));
  }
  for (const char* name : {"hard/conrod__meshlab.stl", "hard/soup_bunny.stl"}) {
    expect_same(name, testing::PlainBinaryStl(content(name)));
  }
  expect_same("hard/dangling_edge2.off",
              testing::PlainOff(content("hard/dangling_edge2.off"), true));
  expect_same("malformed/bad_beetle.off",
              testing::PlainBinaryOff(content("malformed/bad_beetle.off"), false));
}

TEST_F(SharedScan, MalformedFilesGiveAnInputErrorOrAMesh) {
  for (const auto& entry : std::filesystem::directory_iterator(SharedData() + "malformed")) {
    const std::string name = entry.path().filename().string();
    const Result<Mesh> mesh = ReadScan("malformed/" + name);
    // The first is a binary OFF as many programs write it.
    const bool is_readable = name == "bad_beetle.off" ||
                             (name.starts_with("odd_") && name != "odd_ply_empty_header.ply" &&
                              name != "odd_empty-4.obj" && name != "odd_malformed.obj");
    EXPECT_EQ(mesh.ok(), is_readable) << name << ": " << (mesh.ok() ? "" : mesh.error().message);
    if (!mesh.ok()) {
      EXPECT_EQ(mesh.error().kind, ErrorKind::kInput);
      EXPECT_TRUE(mesh.error().message.starts_with(entry.path().string() + ": "));
      std::cout << "  " << mesh.error().message << '\n';
    }
  }
}

}  // namespace
}  // namespace folprom::io
