// From files to pictures: levels of detail, limits, warnings, sheets.
#include "apps/render/picture.h"

#include <gtest/gtest.h>

#include <limits>

#include "apps/render/sheet.h"
#include "tests/support/codec.h"
#include "tests/support/ply.h"
#include "tests/support/surfaces.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/render/pictures.h"

namespace folprom::render {
namespace {

using support::CoordinateType;

class PictureTest : public ::testing::Test {
 protected:
  std::string Path(const std::string& name) const { return folder_.File(name); }
  std::string Scan(const support::Mesh& mesh) const {
    support::WritePly(Path("scan.ply"), mesh, CoordinateType::kFloat);
    return Path("scan.ply");
  }
  std::string Encoded(const support::Mesh& mesh) const {
    std::filesystem::remove(Path("scan.folp"));
    support::Encode(Scan(mesh), Path("scan.folp"), {});
    return Path("scan.folp");
  }
  Sheet SheetOf(const std::string& path, std::vector<double> rates,
                PictureOptions options = Small(40, 40)) const {
    const auto runner = parallel::MakeSerialRunner();
    parallel::Progress progress;
    return DrawSheet(path, options, rates, *runner, progress);
  }

  support::TemporaryFolder folder_;
};

TEST_F(PictureTest, AFinerLevelLooksMoreLikeTheScan) {
  const support::Mesh mesh = support::BumpySphere(4000, false, 3);
  const std::string folp = Encoded(mesh);
  const Image scan = DrawFile(Path("scan.ply"), Small()).image;
  double last = 255;
  uint64_t vertices = 0;
  for (const uint64_t most : {100, 500, 2000}) {
    PictureOptions options = Small();
    options.decode.max_vertices = most;
    const Picture picture = DrawFile(folp, options);
    EXPECT_GT(picture.vertices, vertices);
    EXPECT_LE(picture.vertices, most);
    const double difference = Difference(picture.image, scan);
    EXPECT_LT(difference, 0.8 * last) << most;
    vertices = picture.vertices;
    last = difference;
  }
  const Picture whole = DrawFile(folp, Small());
  EXPECT_EQ(whole.vertices, mesh.positions.size());
  EXPECT_LT(Difference(whole.image, scan), 0.5 * last);
  EXPECT_TRUE(whole.warnings.empty());
}

TEST_F(PictureTest, LooksAtTheBoxThatIsAskedFor) {
  const std::string scan = Scan(support::BumpySphere(500, false, 3));
  const Picture own = DrawFile(scan, Small());
  PictureOptions options = Small();
  options.box = own.box;
  EXPECT_EQ(DrawFile(scan, options).image.pixels(), own.image.pixels());
  for (size_t i = 0; i < 3; ++i) {
    options.box->lo[i] -= 10;
    options.box->hi[i] += 10;
  }
  EXPECT_LT(InkedPixels(DrawFile(scan, options).image), InkedPixels(own.image) / 4);
}

TEST_F(PictureTest, WarnsOfWhatIsNotFinite) {
  support::Mesh mesh = support::BumpySphere(500, false, 3);
  const auto added = mesh.positions.size();
  mesh.positions.push_back({0, std::numeric_limits<double>::quiet_NaN(), 0});
  mesh.positions.push_back({std::numeric_limits<double>::infinity(), 0, 0});
  mesh.faces.push_back({0, 1, added});
  const Picture picture = DrawFile(Scan(mesh), Small());
  ASSERT_EQ(picture.warnings.size(), 1u);
  EXPECT_NE(picture.warnings[0].find(
                "2 vertices are not finite and left out of the picture, with 1 face"),
            std::string::npos)
      << picture.warnings[0];
  mesh.positions.resize(added);
  mesh.faces.pop_back();
  EXPECT_EQ(DrawFile(Scan(mesh), Small()).image.pixels(), picture.image.pixels());
}

TEST_F(PictureTest, WarnsOfAnEmptyMesh) {
  const Picture picture = DrawFile(Scan({}), Small());
  EXPECT_EQ(InkedPixels(picture.image), 0u);
  ASSERT_EQ(picture.warnings.size(), 1u);
  EXPECT_NE(picture.warnings[0].find("scan.ply: has no vertices"), std::string::npos);
}

TEST_F(PictureTest, DrawsEverySmallShape) {
  EXPECT_GT(InkedPixels(DrawFile(Scan({{{1, 2, 3}}, {}, true}), Small()).image), 0u);
  EXPECT_GT(InkedPixels(DrawFile(Encoded({{{1, 2, 3}}, {}, true}), Small()).image), 0u);
  const support::Mesh line = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, true};
  EXPECT_GT(InkedPixels(DrawFile(Encoded(line), Small()).image), 0u);
  const support::Mesh triangle = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, true};
  EXPECT_GT(InkedPixels(DrawFile(Encoded(triangle), Small()).image), 500u);
}

TEST_F(PictureTest, RefusesWhatNeedsMoreThanTheMemoryLimit) {
  PictureOptions options = Small();
  options.decode.limits.memory_bytes = 100'000;
  try {
    DrawFile(Scan(support::BumpySphere(2000, false, 3)), options);
    FAIL() << "not refused";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().kind, ErrorKind::kLimit);
    EXPECT_NE(failure.error().message.find("scan.ply"), std::string::npos);
  }
}

TEST_F(PictureTest, RefusesABoxTooLargeToMeasure) {
  support::Mesh mesh = {{{-1.7e308, 0, 0}, {1.7e308, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, false};
  support::WritePly(Path("huge.ply"), mesh, CoordinateType::kDouble);
  try {
    DrawFile(Path("huge.ply"), Small());
    FAIL() << "not refused";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().kind, ErrorKind::kInput);
  }
}

TEST_F(PictureTest, ASheetShowsRisingLevelsAndTheWholeMesh) {
  const support::Mesh mesh = support::BumpySphere(4000, false, 3);
  const std::string folp = Encoded(mesh);
  const Sheet sheet = SheetOf(folp, {});
  ASSERT_GE(sheet.entries.size(), 5u);
  ASSERT_LE(sheet.entries.size(), 6u);
  EXPECT_EQ(sheet.entries.back().vertices, mesh.positions.size());
  for (size_t i = 1; i < sheet.entries.size(); ++i) {
    EXPECT_GT(sheet.entries[i].vertices, sheet.entries[i - 1].vertices);
    EXPECT_GT(sheet.entries[i].bytes, sheet.entries[i - 1].bytes);
    EXPECT_GT(sheet.entries[i].bits_per_vertex, sheet.entries[i - 1].bits_per_vertex);
  }
  EXPECT_EQ(std::filesystem::file_size(folp), sheet.entries.back().bytes);
  // Three columns; something is drawn in each field.
  EXPECT_GE(sheet.image.width(), 3 * 40u);
  EXPECT_GE(sheet.image.height(), 2 * 40u);
  EXPECT_GT(InkedPixels(sheet.image), sheet.entries.size() * 300);
}

TEST_F(PictureTest, ASheetTakesItsRates) {
  const support::Mesh mesh = support::BumpySphere(4000, false, 3);
  const Sheet sheet = SheetOf(Encoded(mesh), {2, 8, 1000});
  ASSERT_EQ(sheet.entries.size(), 3u);
  EXPECT_LE(sheet.entries[0].bits_per_vertex, 2);
  EXPECT_LE(sheet.entries[1].bits_per_vertex, 8);
  EXPECT_EQ(sheet.entries[2].vertices, mesh.positions.size());
}

TEST_F(PictureTest, ASheetShowsEvenAPoint) {
  const Sheet sheet = SheetOf(Encoded({{{1, 2, 3}}, {}, true}), {});
  EXPECT_EQ(sheet.entries.back().vertices, 1u);
}

}  // namespace
}  // namespace folprom::render
