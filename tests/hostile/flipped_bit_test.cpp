// A flipped bit is found, wherever it is.
#include <gtest/gtest.h>

#include "io/container/reader.h"
#include "parallel/progress.h"
#include "parallel/runner.h"
#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace {

Bytes Flipped(Bytes file, size_t bit) {
  file[bit / 8] = static_cast<uint8_t>(file[bit / 8] ^ (1u << (bit % 8)));
  return file;
}

/// Does some part of the file refuse to be read.
bool IsRefused(const Bytes& file) {
  auto container = io::ContainerReader::Open(file, "flipped");
  if (!container) {
    return container.error().kind == ErrorKind::kCorrupt ||
           container.error().kind == ErrorKind::kInput;
  }
  for (size_t layer = 0; layer < container->table().layers.size(); ++layer) {
    for (size_t subtree = 0; subtree < container->table().subtrees.size(); ++subtree) {
      for (auto part : {io::SegmentPart::kInner, io::SegmentPart::kSeam}) {
        auto segment = container->Segment(layer, subtree, part);
        if (!segment) return segment.error().kind == ErrorKind::kCorrupt;
      }
    }
  }
  return false;
}

using FlippedBit = SmallFileTest;
INSTANTIATE_TEST_SUITE_P(Coder, FlippedBit, support::EveryCoder(), support::NameOfCoder);

TEST_P(FlippedBit, IsRefusedEverywhere) {
  for (size_t bit = 0; bit < SmallFile().size() * 8; ++bit) {
    ASSERT_TRUE(IsRefused(Flipped(SmallFile(), bit))) << "bit " << bit;
  }
}

TEST_P(FlippedBit, NeverGivesAWrongLod) {
  ErrorKind error;
  const auto whole = DecodeLods(SmallFile(), &error);
  for (size_t bit = 0; bit < SmallFile().size() * 8; bit += 13) {
    const auto lods = DecodeLods(Flipped(SmallFile(), bit), &error);
    ASSERT_LT(lods.size(), whole.size()) << "bit " << bit;
    ASSERT_TRUE(error == ErrorKind::kCorrupt || error == ErrorKind::kInput) << "bit " << bit;
    for (size_t layer = 0; layer < lods.size(); ++layer) {
      ASSERT_TRUE(lods[layer] == whole[layer]) << "bit " << bit;
    }
  }
}

TEST_P(FlippedBit, LeavesNoOutputBehind) {
  TemporaryFolder folder;
  auto runner = parallel::MakeSerialRunner();
  parallel::Progress progress;
  DecodeOptions options;
  options.temporary_folder = folder.path();
  for (size_t bit = 3; bit < SmallFile().size() * 8; bit += 401) {
    WriteFile(folder.File("flipped.folp"), Flipped(SmallFile(), bit));
    auto report =
        DecodeFile(folder.File("flipped.folp"), folder.File("out.ply"), options, *runner, progress);
    ASSERT_FALSE(report.ok()) << "bit " << bit;
    EXPECT_TRUE(report.error().kind == ErrorKind::kCorrupt ||
                report.error().kind == ErrorKind::kInput)
        << "bit " << bit << ": " << report.error().message;
    EXPECT_NE(report.error().message.find("flipped.folp"), std::string::npos)
        << report.error().message;
    ASSERT_EQ(folder.Names(), std::vector<std::string>{"flipped.folp"}) << "bit " << bit;
  }
}

}  // namespace
}  // namespace folprom::hostile
