#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "ply_builder.h"
#include "support.h"

namespace folprom::io {
namespace {

using enum ScalarType;
using testing::InputErrorOf;
using testing::kAllFormats;
using testing::MeshOf;
using testing::PlyBuilder;
using testing::TypeName;

constexpr ScalarType kAllTypes[] = {kInt8,  kUint8,  kInt16,   kUint16,
                                    kInt32, kUint32, kFloat32, kFloat64};

// Values that fill the type, so that a wrong byte order or sign shows.
std::vector<double> ValuesOf(ScalarType type) {
  switch (type) {
    case kInt8:
      return {-128, 127, 3};
    case kUint8:
      return {255, 0, 130};
    case kInt16:
      return {-32768, 258, 32767};
    case kUint16:
      return {65535, 258, 32768};
    case kInt32:
      return {-2147483648.0, 16909060, 2147483647};
    case kUint32:
      return {4294967295.0, 16909060, 2147483648.0};
    case kFloat32:
      return {static_cast<double>(0.1f), -1.5e30f, 1e-40f};
    case kFloat64:
      return {0.1, -1.5e300, 5e-324};
  }
  return {};
}

std::string Points(PlyFormat format, ScalarType type, bool second_family, bool reversed) {
  PlyBuilder ply(format);
  const std::string name = TypeName(type, second_family);
  ply.Header("element vertex 2").Header("property uchar before");
  for (const char* axis : {"x", "y", "z"}) {
    const std::string shown =
        reversed ? std::string(1, static_cast<char>('x' + 'z' - *axis)) : axis;
    ply.Header("property " + name + " " + shown);
  }
  ply.Header("property short after").Body();
  for (int record = 0; record < 2; ++record) {
    ply.Value(kUint8, 7);
    for (const double value : ValuesOf(type)) ply.Value(type, value);
    ply.Value(kInt16, -2).End();
  }
  return ply.bytes();
}

TEST(PlyCoordinates, OfEveryTypeComeFromEveryFormat) {
  for (const PlyFormat format : kAllFormats) {
    for (const ScalarType type : kAllTypes) {
      for (const bool second : {false, true}) {
        const testing::TemporaryFolder folder;
        const auto source =
            testing::OpenBytes(folder, Points(format, type, second, second)).value();
        EXPECT_EQ(source->coordinate_type(), type);
        std::vector<double> expected = ValuesOf(type);
        if (second) std::swap(expected[0], expected[2]);
        expected.insert(expected.end(), expected.begin(), expected.begin() + 3);
        EXPECT_EQ(testing::AllBlocks(*source).value().xyz, expected) << static_cast<int>(type);
      }
    }
  }
}

TEST(PlyCoordinates, OfMixedTypesAnnounceATypeThatHoldsAll) {
  const auto type_of = [](const char* x, const char* y) {
    const testing::TemporaryFolder folder;
    PlyBuilder ply(PlyFormat::kAscii);
    ply.Header("element vertex 0").Header(std::string("property ") + x + " x");
    ply.Header(std::string("property ") + y + " y").Header("property char z").Body();
    return testing::OpenBytes(folder, ply.bytes()).value()->coordinate_type();
  };
  EXPECT_EQ(type_of("float", "char"), kFloat32);
  EXPECT_EQ(type_of("float", "double"), kFloat64);
  EXPECT_EQ(type_of("float", "int"), kFloat64);
  EXPECT_EQ(type_of("uint", "float"), kFloat64);
  EXPECT_EQ(type_of("short", "int"), kInt32);
}

TEST(PlyFormats, AgreeOnAFileWithAllThatAFileCanHave) {
  for (const PlyFormat format : kAllFormats) {
    const testing::TemporaryFolder folder;
    const auto source = testing::OpenBytes(folder, testing::MixedFile(format)).value();
    const testing::Mesh mesh = testing::AllBlocks(*source).value();
    EXPECT_EQ(mesh.xyz, testing::MixedPositions());
    EXPECT_EQ(mesh.triangles, testing::MixedTriangles());
    EXPECT_EQ(source->notes().polygons_triangulated, 1u);
    EXPECT_EQ(source->notes().polygons_dropped, 1u);
    EXPECT_EQ(source->notes().strips, 0u);
    EXPECT_EQ(source->notes().ignored_properties,
              (std::vector<std::string>{"camera.matrix", "camera.view", "vertex.tags",
                                        "edge.vertex1", "edge.vertex2", "tail.weights"}));
    const FaceSchema& schema = source->face_schema();
    ASSERT_EQ(schema.attributes.size(), 2u);
    EXPECT_EQ(schema.attributes[0].name, "area");
    EXPECT_EQ(schema.attributes[1].name, "red");
    EXPECT_EQ(schema.before_indices, 1u);
    source->DropResident();
    EXPECT_EQ(testing::AllBlocks(*source).value().xyz, testing::MixedPositions());
  }
}

std::string AsciiPoint(const std::string& type, const std::string& values) {
  return "ply\nformat ascii 1.0\nelement vertex 1\nproperty " + type + " x\nproperty " + type +
         " y\nproperty " + type + " z\nend_header\n" + values;
}

TEST(PlyText, RoundsFloatsOnceAndToTheNearest) {
  // The nearest double of this lies on the tie of two floats: rounding twice would go down.
  const std::string value = "1.00000005960464477540";
  const testing::Mesh mesh = MeshOf(AsciiPoint("float", value + " 0.1 16777217")).value();
  EXPECT_EQ(mesh.xyz,
            (std::vector<double>{1.00000011920928955078125, static_cast<double>(0.1f), 16777216}));
}

TEST(PlyText, PassesOnInfinityNanAndValuesTooLargeOrSmall) {
  const std::vector<double> xyz = MeshOf(AsciiPoint("float", "nan +inf -Infinity")).value().xyz;
  EXPECT_TRUE(std::isnan(xyz[0]));
  EXPECT_EQ(xyz[1], std::numeric_limits<double>::infinity());
  EXPECT_EQ(xyz[2], -std::numeric_limits<double>::infinity());
  EXPECT_EQ(MeshOf(AsciiPoint("float", "1e60 -1e60 1e-300")).value().xyz,
            (std::vector<double>{HUGE_VAL, -HUGE_VAL, 0}));
}

TEST(PlyCoordinates, KeepTheBitsOfANan) {
  // Quiet and signalling, positive and negative, and what they are widened to.
  const uint32_t floats[] = {0x7fc00000, 0x7f812345, 0xffbfffff};
  const uint64_t widened[] = {0x7ff8000000000000, 0x7ff02468a0000000, 0xfff7ffffe0000000};
  for (const char* order : {"little", "big"}) {
    std::string bytes = std::string("ply\nformat binary_") + order +
                        "_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                        "property float z\nend_header\n";
    for (uint32_t value : floats) {
      for (int byte = 0; byte < 4; ++byte) {
        const int shift = *order == 'l' ? 8 * byte : 24 - 8 * byte;
        bytes.push_back(static_cast<char>(value >> shift & 0xff));
      }
    }
    const std::vector<double> xyz = MeshOf(bytes).value().xyz;
    ASSERT_EQ(xyz.size(), 3u);
    for (size_t i = 0; i < 3; ++i) EXPECT_EQ(std::bit_cast<uint64_t>(xyz[i]), widened[i]) << order;
  }
}

TEST(PlyText, TakesSignsTabsBlankLinesAndNoLastLineEnd) {
  EXPECT_EQ(MeshOf(AsciiPoint("float", " \n\t\n\t+1.5\t -.5e1  3. ")).value().xyz,
            (std::vector<double>{1.5, -5, 3}));
  EXPECT_EQ(MeshOf(AsciiPoint("int", "+1 -2 3\n\n\n")).value().xyz,
            (std::vector<double>{1, -2, 3}));
}

TEST(PlyText, NamesTheLineOfAValueThatDoesNotParse) {
  const auto expect_fault = [](const std::string& type, const std::string& values,
                               const std::string& reason) {
    const std::string message = InputErrorOf(AsciiPoint(type, values));
    EXPECT_NE(message.find(reason), std::string::npos) << message << " for " << values;
  };
  expect_fault("float", "1 2 x\n", "vertex 0: line 8: \"x\" is not a number");
  expect_fault("float", "\n\n1 2 3x\n", "line 10: \"3x\" is not a number");
  expect_fault("float", "1 2 ++3\n", "not a number");
  expect_fault("float", "1 2 +-3\n", "not a number");
  expect_fault("float", "1 2 +\n", "not a number");
  expect_fault("float", "1 2\n3\n", "line 8: the line has fewer values");
  expect_fault("float", "1 2 3 4\n", "line 8: the line has more values");
  expect_fault("float", "1 2   ", "line 8: the file ends in it");
  expect_fault("int", "1 2 3.5\n", "not an integer");
  expect_fault("uchar", "1 2 256\n", "out of the range");
  expect_fault("uchar", "1 2 -1\n", "out of the range");
  expect_fault("int", "1 2 99999999999999999999\n", "not an integer");
}

}  // namespace
}  // namespace folprom::io
