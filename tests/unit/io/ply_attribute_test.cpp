// What a PLY file has of each vertex beside its position, and the remarks in its header.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/formats/mesh_writer.h"
#include "ply_builder.h"
#include "support.h"

namespace folprom::io {
namespace {

using enum ScalarType;
using testing::kAllFormats;
using testing::OpenBytes;
using testing::PlyBuilder;
using testing::TemporaryFolder;
using testing::TypeName;

template <class T>
void Append(T value, std::vector<uint8_t>* bytes) {
  const auto* begin = reinterpret_cast<const uint8_t*>(&value);
  bytes->insert(bytes->end(), begin, begin + sizeof value);
}

/// Two vertices with an attribute of each type around the coordinates.
std::string EveryType(PlyFormat format, bool second_family) {
  PlyBuilder ply(format);
  ply.Header("comment one").Header("obj_info two").Header("element vertex 2");
  ply.Header("property " + TypeName(kInt8, second_family) + " a0");
  ply.Header("property " + TypeName(kUint8, second_family) + " a1").Header("property float x");
  ply.Header("property float y").Header("property list uchar int tags");
  for (const ScalarType type : {kInt16, kUint16, kInt32, kUint32, kFloat32}) {
    ply.Header("property " + TypeName(type, second_family) + " a" +
               std::to_string(static_cast<int>(type)));
  }
  ply.Header("property float z").Header("property " + TypeName(kFloat64, second_family) + " a7");
  ply.Body();
  for (const double sign : {1.0, -1.0}) {
    ply.Value(kInt8, sign * 100).Value(kUint8, 200).Value(kFloat32, 1).Value(kFloat32, 2);
    ply.List(kUint8, kInt32, {7, 8}).Value(kInt16, sign * 30000).Value(kUint16, 60000);
    ply.Value(kInt32, sign * 2e9).Value(kUint32, 4e9).Value(kFloat32, sign * 0.5);
    ply.Value(kFloat32, 3).Value(kFloat64, sign * 1e-300).End();
  }
  return ply.bytes();
}

TEST(PlyAttributes, OfEveryTypeAndFormatAreRead) {
  std::vector<uint8_t> expected;
  for (const int sign : {1, -1}) {
    Append(static_cast<int8_t>(sign * 100), &expected);
    Append(uint8_t{200}, &expected);
    Append(static_cast<int16_t>(sign * 30000), &expected);
    Append(uint16_t{60000}, &expected);
    Append(int32_t{sign * 2000000000}, &expected);
    Append(uint32_t{4000000000}, &expected);
    Append(static_cast<float>(sign) * 0.5f, &expected);
    Append(sign * 1e-300, &expected);
  }
  for (const PlyFormat format : kAllFormats) {
    for (const bool second_family : {false, true}) {
      const TemporaryFolder folder;
      const auto source = OpenBytes(folder, EveryType(format, second_family)).value();
      const VertexSchema& schema = source->vertex_schema();
      ASSERT_EQ(schema.attributes.size(), 8u);
      for (size_t a = 0; a < 8; ++a) {
        EXPECT_EQ(schema.attributes[a].name, std::string("a").append(std::to_string(a)));
        EXPECT_EQ(schema.attributes[a].type, static_cast<ScalarType>(a));
      }
      EXPECT_EQ(schema.before_position, 2u);
      EXPECT_EQ(schema.Stride(), 26u);
      EXPECT_EQ(source->notes().ignored_properties, std::vector<std::string>{"vertex.tags"});
      EXPECT_EQ(source->remarks(), (std::vector<std::string>{"comment one", "obj_info two"}));
      std::vector<uint8_t> values;
      source->ReadVertexAttributes(0, &values).value();
      EXPECT_EQ(values, expected);
    }
  }
}

TEST(PlyAttributes, KeepTheBitsOfANan) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
      "property float y\nproperty float z\nproperty float f\nproperty double d\nend_header\n" +
      std::string(12, '\0');
  std::vector<uint8_t> nans;
  Append(uint32_t{0xffbfffff}, &nans);
  Append(uint64_t{0x7ff0000000000001}, &nans);
  bytes.append(nans.begin(), nans.end());
  const TemporaryFolder folder;
  std::vector<uint8_t> values;
  OpenBytes(folder, bytes).value()->ReadVertexAttributes(0, &values).value();
  EXPECT_EQ(values, nans);
}

TEST(PlyAttributes, OfTextThatDoNotParseNameTheLine) {
  const TemporaryFolder folder;
  const auto source =
      OpenBytes(folder,
                "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                "property float z\nproperty uchar red\nend_header\n1 2 3 255\n1 2 3 256\n")
          .value();
  std::vector<uint8_t> values;
  const auto read = source->ReadVertexAttributes(0, &values);
  ASSERT_FALSE(read.ok());
  EXPECT_EQ(read.error().kind, ErrorKind::kInput);
  EXPECT_NE(read.error().message.find("line 10"), std::string::npos) << read.error().message;
}

TEST(PlyAttributes, BeyondTheLimitsAreNamedAsNotKept) {
  std::string header = "ply\nformat ascii 1.0\nelement vertex 0\nproperty char x\n";
  header += "property char y\nproperty char z\nproperty char " + std::string(256, 'n') + "\n";
  for (int i = 0; i < 256; ++i) header += "property char a" + std::to_string(i) + "\n";
  header += "element other 1\nproperty char c\nend_header\n1\n";
  const TemporaryFolder folder;
  const auto source = OpenBytes(folder, header).value();
  EXPECT_EQ(source->vertex_schema().attributes.size(), kMostAttributes);
}

TEST(PlyAttributes, WrittenComeBackWhereTheyStood) {
  const TemporaryFolder folder;
  const std::string path = folder.File("out.ply");
  MeshShape shape{
      3, 0, kFloat32, {{{"a", kInt16}, {"b", kFloat64}, {"c", kUint8}}, 1}, {}, {"comment c"}};
  auto writer = MeshWriter::Create(path, shape, false).value();
  std::vector<uint8_t> values;
  for (uint8_t v = 0; v < 33; ++v) values.push_back(v);
  const std::vector<double> xyz{1, 2, 3, 4, 5, 6, 7, 8, 9};
  const std::span<const double> all(xyz);
  writer->AppendVertices(all.first(6), std::span<const uint8_t>(values).first(22)).value();
  EXPECT_FALSE(writer->AppendVertices(all.last(3), {}).ok());
  writer->AppendVertices(all.last(3), std::span<const uint8_t>(values).last(11)).value();
  writer->Commit().value();
  EXPECT_TRUE(writer->Warnings().empty());
  const auto source = MeshSource::Open(path).value();
  EXPECT_TRUE(source->vertex_schema() == shape.schema);
  EXPECT_EQ(source->remarks(), shape.remarks);
  std::vector<uint8_t> read;
  source->ReadVertexAttributes(0, &read).value();
  EXPECT_EQ(read, values);
  std::vector<double> positions;
  source->ReadVertexBlock(0, &positions).value();
  EXPECT_EQ(positions, xyz);
}

}  // namespace
}  // namespace folprom::io
