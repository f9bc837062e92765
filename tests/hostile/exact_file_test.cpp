// An exact file with rests, cut, flipped and forged.
#include <gtest/gtest.h>

#include <limits>

#include "engine/codec/layer_reader.h"
#include "io/container/reader.h"
#include "io/formats/mesh_source.h"
#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace {

const Bytes& ExactFile() {
  static const Bytes file = [] {
    TestMesh mesh = RoughTorus(16, 10);
    mesh.positions[3] = {std::numeric_limits<double>::infinity(), -0.0, 5e-324};
    EncodeOptions options = SmallOptions(60);
    options.exact = true;
    return Encoded(mesh, options);
  }();
  return file;
}

TEST(ExactFile, HasRests) {
  const io::FileTable table = TakeApart(ExactFile()).table;
  const CodecParameters parameters = ParametersOf(table, table.layers.size());
  EXPECT_TRUE(parameters.has_rests());
  ErrorKind error;
  const auto lods = DecodeLods(ExactFile(), &error);
  EXPECT_EQ(lods.back().positions.size(), 162u);
}

TEST(ExactFile, CutGivesItsCompleteLayers) {
  ErrorKind error;
  const auto whole = DecodeLods(ExactFile(), &error);
  auto container = io::ContainerReader::Open(ExactFile(), "whole").value();
  for (size_t bytes = 0; bytes < ExactFile().size(); bytes += 5) {
    size_t complete = 0;
    while (complete < whole.size() && container.LayerEnd(complete) <= bytes) ++complete;
    const Bytes cut(ExactFile().begin(), ExactFile().begin() + static_cast<ptrdiff_t>(bytes));
    const auto lods = DecodeLods(cut, &error);
    ASSERT_EQ(lods.size(), complete) << bytes;
    if (complete < whole.size()) {
      ASSERT_EQ(error, ErrorKind::kCorrupt) << bytes;
    }
    for (size_t layer = 0; layer < complete; ++layer) ASSERT_TRUE(lods[layer] == whole[layer]);
  }
}

TEST(ExactFile, WithAFlippedBitNeverGivesAWrongLod) {
  ErrorKind error;
  const auto whole = DecodeLods(ExactFile(), &error);
  for (size_t bit = 0; bit < ExactFile().size() * 8; bit += 29) {
    Bytes file = ExactFile();
    file[bit / 8] = static_cast<uint8_t>(file[bit / 8] ^ (1u << (bit % 8)));
    const auto lods = DecodeLods(file, &error);
    ASSERT_LT(lods.size(), whole.size()) << "bit " << bit;
    ASSERT_TRUE(error == ErrorKind::kCorrupt || error == ErrorKind::kInput) << "bit " << bit;
    for (size_t layer = 0; layer < lods.size(); ++layer) {
      ASSERT_TRUE(lods[layer] == whole[layer]) << "bit " << bit;
    }
  }
}

template <class Change>
void ExpectCorrupt(Change change) {
  Parts parts = TakeApart(ExactFile());
  change(parts.table);
  const auto decoder = MemoryDecoder::Open(PutTogether(parts));
  ASSERT_FALSE(decoder.ok());
  EXPECT_EQ(decoder.error().kind, ErrorKind::kCorrupt) << decoder.error().message;
}

TEST(ExactFile, UnderAnotherLatticeIsCorrupt) {
  ExpectCorrupt([](io::FileTable& table) { table.unit *= 2; });
  ExpectCorrupt([](io::FileTable& table) { table.origin[1] += table.unit / 2; });
  ExpectCorrupt([](io::FileTable& table) { table.origin[2] = 1e300; });
  ExpectCorrupt([](io::FileTable& table) { table.origin[0] = 1e17; });
  ExpectCorrupt([](io::FileTable& table) {
    CodecParameters parameters = ParametersOf(table, table.layers.size());
    ++parameters.exact->step.exponent;
    table.codec = WriteParameters(parameters);
  });
}

TEST(ExactFile, WhoseTableHidesTheRestsIsCorrupt) {
  Parts parts = TakeApart(ExactFile());
  CodecParameters parameters = ParametersOf(parts.table, parts.table.layers.size());
  parameters.exact->step.has_rests = false;
  parts.table.codec = WriteParameters(parameters);
  const Bytes file = PutTogether(parts);
  ErrorKind error;
  EXPECT_LT(DecodeLods(file, &error).size(), parts.table.layers.size());
  EXPECT_EQ(error, ErrorKind::kCorrupt);
}

}  // namespace
}  // namespace folprom::hostile
