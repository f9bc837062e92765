// Pictures as PNG, read back by libpng; captions; the choice of levels.
#include <gtest/gtest.h>
#include <png.h>

#include "apps/render/caption.h"
#include "apps/render/levels.h"
#include "apps/render/png_code.h"
#include "tests/support/random.h"
#include "tests/unit/render/pictures.h"

namespace folprom::render {
namespace {

Image Noise(uint32_t width, uint32_t height, bool opaque) {
  support::Random random(3);
  Image image(width, height);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      image.At(x, y) = {static_cast<uint8_t>(random.Below(256)),
                        static_cast<uint8_t>(opaque ? 255 : random.Below(256))};
    }
  }
  return image;
}

TEST(PngCode, ComesBackPixelByPixel) {
  for (const bool opaque : {true, false}) {
    for (const uint32_t width : {1U, 2U, 61U}) {
      const Image image = Noise(width, 17, opaque);
      const std::vector<uint8_t> png = PngOf(image);
      png_image header = {};
      header.version = PNG_IMAGE_VERSION;
      ASSERT_TRUE(png_image_begin_read_from_memory(&header, png.data(), png.size()));
      EXPECT_EQ(header.width, width);
      EXPECT_EQ(header.height, 17u);
      EXPECT_EQ(header.format, opaque ? PNG_FORMAT_GRAY : PNG_FORMAT_GA);
      header.format = PNG_FORMAT_GA;
      std::vector<uint8_t> samples(PNG_IMAGE_SIZE(header));
      ASSERT_TRUE(png_image_finish_read(&header, nullptr, samples.data(), 0, nullptr));
      for (size_t i = 0; i < image.pixels().size(); ++i) {
        const Pixel pixel{samples[2 * i], samples[2 * i + 1]};
        ASSERT_EQ(pixel, image.pixels()[i]);
      }
    }
  }
}

TEST(PngCode, IsSmallerThanThePixels) {
  EXPECT_LT(PngOf(PictureOf(Ball(1, 30))).size(), 96 * 72 / 2);
}

TEST(Caption, StaysInThePicture) {
  Image image(20, 10);
  Write(&image, 0, 0, "Wide and high", 0);
  EXPECT_GT(InkedPixels(image), 10u);
  Image aside(20, 10);
  Write(&aside, 20, 0, "W", 0);
  Write(&aside, 0, 10, "W", 0);
  EXPECT_EQ(InkedPixels(aside), 0u);
}

TEST(Caption, EachLetterIsItsOwn) {
  std::vector<std::vector<Pixel>> letters;
  for (char c = ' '; c <= '~'; ++c) {
    Image image(kLetterWidth, kLetterHeight);
    Write(&image, 0, 0, std::string(1, c), 0);
    EXPECT_EQ(InkedPixels(image) == 0, c == ' ') << c;
    for (const auto& other : letters) EXPECT_NE(image.pixels(), other) << c;
    letters.push_back(image.pixels());
  }
}

TEST(Caption, FitsIntoItsRoom) {
  EXPECT_EQ(Fitted("scan.folp", 9 * kLetterWidth), "scan.folp");
  EXPECT_EQ(Fitted("scan.folp", 9 * kLetterWidth - 1), "scan....");
  EXPECT_EQ(Fitted("scan.folp", 2 * kLetterWidth), "sc");
  EXPECT_EQ(Fitted("scan.folp", 0), "");
  EXPECT_EQ(Fitted("B\xc3\xbcste\n", 100 * kLetterWidth), "B?ste?");
}

FileInfo FileOf(const std::vector<uint64_t>& vertices) {
  FileInfo info;
  for (const uint64_t count : vertices) {
    LayerInfo layer;
    layer.vertices = count;
    layer.bits_per_vertex = static_cast<double>(count) / 100;
    info.layers.push_back(layer);
  }
  info.layers_present = info.layers_total = info.layers.size();
  return info;
}

TEST(Levels, SpreadByEvenFactors) {
  std::vector<uint64_t> vertices;
  for (int i = 0; i <= 16; ++i) vertices.push_back(uint64_t{1} << i);
  const FileInfo info = FileOf(vertices);
  EXPECT_EQ(SpreadLevels(info, 4), (std::vector<uint32_t>{9, 11, 13, 15}));
  EXPECT_EQ(SpreadLevels(info, 1), (std::vector<uint32_t>{9}));
  vertices.resize(11);  // 1,024 vertices: from 26 on
  EXPECT_EQ(SpreadLevels(FileOf(vertices), 3), (std::vector<uint32_t>{6, 7, 9}));
}

TEST(Levels, AreEachThereOnce) {
  EXPECT_EQ(SpreadLevels(FileOf({10, 20, 30}), 5), (std::vector<uint32_t>{1, 2}));
  EXPECT_TRUE(SpreadLevels(FileOf({10}), 5).empty());
  EXPECT_TRUE(SpreadLevels(FileOf({}), 5).empty());
  FileInfo cut = FileOf({400, 4000, 40'000, 400'000});
  cut.layers_present = 2;
  EXPECT_EQ(SpreadLevels(cut, 5), (std::vector<uint32_t>{1}));
}

TEST(Levels, FitIntoTheirRates) {
  const FileInfo info = FileOf({50, 100, 200, 400});  // 0.5, 1, 2, 4 bits per vertex
  const double rates[] = {3, 0.1, 1, 99};
  EXPECT_EQ(LevelsAt(info, rates), (std::vector<uint32_t>{1, 2, 3, 4}));
  const double same[] = {1, 1.5};
  EXPECT_EQ(LevelsAt(info, same), (std::vector<uint32_t>{2}));
}

}  // namespace
}  // namespace folprom::render
