// Segments that are not what an encoder writes, under checksums that fit.
#include <gtest/gtest.h>

#include <random>

#include "engine/codec/layer_reader.h"
#include "parallel/progress.h"
#include "parallel/runner.h"
#include "tests/hostile/guarded_child.h"
#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace {

// Far above what a case takes, far below a hang that a user would wait for.
constexpr unsigned kCpuSeconds = 20;
constexpr uint64_t kAllowedBytes = (uint64_t{64} << 20);

/// Ends with an error of the file's kind or with some mesh whose faces name its vertices.
bool EndsWell(std::span<const uint8_t> file) {
  auto decoder = MemoryDecoder::Open(file);
  if (!decoder) return decoder.error().kind == ErrorKind::kCorrupt;
  while (decoder->decoded_layers() < decoder->layer_count()) {
    Result<void> layer = decoder->DecodeNextLayer();
    if (!layer) return layer.error().kind == ErrorKind::kCorrupt;
    const DecodedMesh mesh = decoder->Mesh();
    for (const auto& face : mesh.faces) {
      for (uint64_t vertex : face) {
        if (vertex >= mesh.positions.size()) return false;
      }
    }
  }
  return true;
}

/// The small mesh under other settings, each of which opens other paths of the decoder.
Bytes FileOfKind(size_t kind) {
  EncodeOptions options = LloydOptions();
  switch (kind) {
    case 0:
      break;
    case 1:
      options.codec.children = 2;
      break;
    case 2:
      options.codec.children = 8;
      options.codec.subtree_vertices = 400;
      break;
    case 3:
      options.codec.split_first = false;
      options.codec.rounds_per_step = 1;
      break;
    case 4:
      options.codec.predict_theta = options.codec.predict_height = false;
      options.codec.adaptive_quantisation = false;
      options.codec.quantisation_levels = 4096;
      break;
    case 5:
      options = SmallOptions(80);
      break;
    case 6:
      options = SmallOptions(150);
      options.exact = true;  // of noise: every coordinate leaves a rest
      break;
    case 7:
      options = SmallOptions(80);
      options.codec.density_step = 0;
      options.codec.models = Models::kLight;
      break;
    case 8:
      options = SmallOptions(150);
      options.codec.density_step = 1;
      options.codec.mixers = 2;
      break;
    case 9:
      options = SmallOptions(300);
      options.codec.fan_cuts = options.codec.pivot_order = options.codec.trained = false;
      break;
    default:
      options.codec.fan_cuts = options.codec.pivot_order = options.codec.nearer_child = false;
      options.codec.quantisation_levels = 2;
      options.codec.subtree_vertices = 20;
      break;
  }
  return Encoded(RoughTorus(25, 12), options);
}
constexpr size_t kKinds = 11;

const std::vector<Parts>& AllKinds() {
  static const std::vector<Parts> kinds = [] {
    std::vector<Parts> made;
    for (size_t kind = 0; kind < kKinds; ++kind) made.push_back(TakeApart(FileOfKind(kind)));
    return made;
  }();
  return kinds;
}

/// Bytes of several characters: even, all alike, mostly ones or zeros, short runs.
Bytes RandomBytes(std::mt19937_64& random, size_t size) {
  Bytes bytes(size);
  const uint64_t character = random() % 5;
  const auto fill = static_cast<uint8_t>(random());
  for (auto& byte : bytes) {
    switch (character) {
      case 0:
        byte = static_cast<uint8_t>(random());
        break;
      case 1:
        byte = fill;
        break;
      case 2:
        byte = static_cast<uint8_t>(random() & random() & random());
        break;
      case 3:
        byte = static_cast<uint8_t>(random() | random() | random());
        break;
      default:
        byte = random() % 8 == 0 ? static_cast<uint8_t>(random()) : fill;
        break;
    }
  }
  return bytes;
}

TEST(DamagedSegment, WithOneFlippedBitEndsWell) {
  const auto& kinds = AllKinds();
  const std::string faults = RunGuarded(3000, kCpuSeconds, kAllowedBytes, [&](size_t i) {
    std::mt19937_64 random(i);
    Parts parts = kinds[i % kKinds];
    Bytes* segment = nullptr;
    do {
      segment = &parts.segments[random() % parts.segments.size()];
    } while (segment->empty());
    uint64_t bit = random() % (segment->size() * 8);
    (*segment)[bit / 8] = static_cast<uint8_t>((*segment)[bit / 8] ^ (1u << (bit % 8)));
    return EndsWell(PutTogether(std::move(parts)));
  });
  EXPECT_EQ(faults, "");
}

using DamagedFile = SmallFileTest;
INSTANTIATE_TEST_SUITE_P(Coder, DamagedFile, support::EveryCoder(), support::NameOfCoder);

TEST_P(DamagedFile, IsNamedOnceWithFileLayerAndSubtree) {
  const Bytes whole = SmallFile();
  const Parts small = TakeApart(whole);
  Parts longer = small;
  Bytes& segment = longer.segments[longer.table.SegmentIndex(2, 1, io::SegmentPart::kInner)];
  segment.resize(segment.size() + 20, 0xff);
  // Under the checksum that fits, and not.
  Bytes damaged = whole;
  const auto container = io::ContainerReader::Open(whole, "whole").value();
  size_t begin = 0;
  for (size_t layer = 0; layer <= 2; ++layer) {
    const auto bytes = container.Segment(layer, 1, io::SegmentPart::kInner).value();
    begin = static_cast<size_t>(bytes.data() - whole.data());
  }
  damaged[begin] = static_cast<uint8_t>(damaged[begin] ^ 1);
  TemporaryFolder folder;
  auto runner = parallel::MakeSerialRunner();
  for (const Bytes& file : {PutTogether(longer), damaged}) {
    WriteFile(folder.File("d.folp"), file);
    parallel::Progress progress;
    DecodeOptions options;
    options.temporary_folder = folder.path();
    const auto report =
        DecodeFile(folder.File("d.folp"), folder.File("out.ply"), options, *runner, progress);
    ASSERT_FALSE(report.ok());
    const std::string& message = report.error().message;
    EXPECT_EQ(report.error().kind, ErrorKind::kCorrupt);
    EXPECT_TRUE(message.starts_with(folder.File("d.folp") + ": layer 2, subtree ")) << message;
    EXPECT_EQ(message.find("subtree"), message.rfind("subtree")) << message;
    EXPECT_EQ(message.find("d.folp"), message.rfind("d.folp")) << message;
  }
}

TEST(DamagedSegment, CutOrLengthenedEndsWell) {
  const auto& kinds = AllKinds();
  const std::string faults = RunGuarded(1000, kCpuSeconds, kAllowedBytes, [&](size_t i) {
    std::mt19937_64 random(i + 10000);
    Parts parts = kinds[i % kKinds];
    for (int changes = 0; changes < 3; ++changes) {
      Bytes& segment = parts.segments[random() % parts.segments.size()];
      segment.resize(random() % 2 == 0 ? random() % (segment.size() + 1)
                                       : segment.size() + random() % 40);
    }
    return EndsWell(PutTogether(std::move(parts)));
  });
  EXPECT_EQ(faults, "");
}

TEST(DamagedSegment, ExchangedForAnotherEndsWell) {
  const auto& kinds = AllKinds();
  const std::string faults = RunGuarded(1000, kCpuSeconds, kAllowedBytes, [&](size_t i) {
    std::mt19937_64 random(i + 20000);
    Parts parts = kinds[i % kKinds];
    for (int changes = 0; changes < 4; ++changes) {
      size_t a = random() % parts.segments.size(), b = random() % parts.segments.size();
      std::swap(parts.segments[a], parts.segments[b]);
    }
    return EndsWell(PutTogether(std::move(parts)));
  });
  EXPECT_EQ(faults, "");
}

TEST(DamagedSegment, OfRandomBytesEndsWell) {
  const auto& kinds = AllKinds();
  const std::string faults = RunGuarded(2000, kCpuSeconds, kAllowedBytes, [&](size_t i) {
    std::mt19937_64 random(i + 30000);
    Parts parts = kinds[i % kKinds];
    // Whole files of noise, and noise after a sound beginning.
    size_t first = random() % 3 == 0 ? 0 : random() % parts.segments.size();
    for (size_t s = first; s < parts.segments.size(); ++s) {
      parts.segments[s] = RandomBytes(random, random() % 200);
    }
    return EndsWell(PutTogether(std::move(parts)));
  });
  EXPECT_EQ(faults, "");
}

TEST(DamagedSegment, OfRandomBytesUnderALargeTableEndsWell) {
  const auto& kinds = AllKinds();
  const std::string faults = RunGuarded(1000, kCpuSeconds, 2 * kAllowedBytes, [&](size_t i) {
    std::mt19937_64 random(i + 40000);
    Parts parts = kinds[i % kKinds];
    // Nothing but the coded bits says that these vertices do not exist. Fewer than the layers have
    // would not get past the table.
    parts.table.vertices = 0;
    for (auto& subtree : parts.table.subtrees) {
      subtree.vertices = static_cast<uint32_t>(400 + (random() >> (33 + random() % 20)));
      parts.table.vertices += subtree.vertices;
    }
    for (auto& segment : parts.segments) segment = RandomBytes(random, random() % 1000);
    return EndsWell(PutTogether(std::move(parts)));
  });
  EXPECT_EQ(faults, "");
}

}  // namespace
}  // namespace folprom::hostile
