// Tables that no encoder writes, under a checksum that fits.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/codec/layer_reader.h"
#include "parallel/progress.h"
#include "parallel/runner.h"
#include "tests/hostile/guarded_child.h"
#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace {

constexpr uint64_t kAllowedBytes = uint64_t{64} << 20;

/// Error of opening and decoding everything; kUsage when nothing is wrong.
ErrorKind ErrorOf(const Bytes& file) {
  ErrorKind error;
  DecodeLods(file, &error);
  return error;
}

/// The decoder ends with kCorrupt, in a process of its own, without taking memory.
void ExpectCorrupt(const Parts& parts, const std::string& what) {
  const Bytes file = PutTogether(parts);
  EXPECT_EQ(RunGuarded(1, 20, kAllowedBytes,
                       [&](size_t) { return ErrorOf(file) == ErrorKind::kCorrupt; }),
            "")
      << what;
}

/// DecodeFile of the parts: the kind of its error, kUsage when it succeeds. Nothing may be left.
ErrorKind DecodeFileError(const Parts& parts) {
  TemporaryFolder folder;
  WriteFile(folder.File("forged.folp"), PutTogether(parts));
  auto runner = parallel::MakeSerialRunner();
  parallel::Progress progress;
  DecodeOptions options;
  options.temporary_folder = folder.path();
  auto report =
      DecodeFile(folder.File("forged.folp"), folder.File("out.ply"), options, *runner, progress);
  if (report.ok()) return ErrorKind::kUsage;
  if (report.error().kind == ErrorKind::kCorrupt) {
    EXPECT_TRUE(report.error().message.starts_with(folder.File("forged.folp") + ": "))
        << report.error().message;
  }
  EXPECT_EQ(folder.Names(), std::vector<std::string>{"forged.folp"}) << report.error().message;
  return report.error().kind;
}

CodecParameters ParametersIn(const Parts& parts) {
  return ParametersOf(parts.table, parts.table.layers.size());
}

class ForgedTable : public SmallFileTest {
 protected:
  static Parts Small() { return TakeApart(SmallFile()); }

  template <class Change>
  static Parts WithSettings(Change change) {
    Parts parts = Small();
    CodecParameters parameters = ParametersIn(parts);
    change(parameters.settings);
    parts.table.codec = WriteParameters(parameters);
    return parts;
  }
};
INSTANTIATE_TEST_SUITE_P(Coder, ForgedTable, support::EveryCoder(), support::NameOfCoder);

TEST_P(ForgedTable, TakenApartAndPutTogetherIsTheSameFile) {
  EXPECT_EQ(PutTogether(Small()), SmallFile());
}

TEST_P(ForgedTable, WithSettingsOutOfRangeIsCorrupt) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  using S = CodecSettings;
  for (double S::*field : {&S::metric_a, &S::metric_b, &S::lloyd_threshold, &S::curvature_threshold,
                           &S::gaussian_ratio}) {
    for (double value : {nan, infinity, -infinity, -1.0, 1e300}) {
      ExpectCorrupt(WithSettings([&](S& s) { s.*field = value; }), std::to_string(value));
    }
  }
  for (uint32_t S::*field :
       {&S::subtree_vertices, &S::children, &S::lloyd_iterations, &S::quantisation_levels,
        &S::steps_per_octave, &S::rounds_per_step, &S::step_parts, &S::effort, &S::mixers}) {
    for (uint32_t value : {0u, 0xffffffffu, 0x80000000u}) {
      ExpectCorrupt(WithSettings([&](S& s) { s.*field = value; }), std::to_string(value));
    }
  }
  ExpectCorrupt(WithSettings([](S& s) { s.effort = 10; }), "effort 10");
  ExpectCorrupt(WithSettings([](S& s) { s.density_step = 5; }), "density step 5");
  ExpectCorrupt(WithSettings([](S& s) { s.density_step = 0xffffffffu; }), "huge density step");
  ExpectCorrupt(WithSettings([](S& s) { s.mixers = 4; }), "four mixers");
  ExpectCorrupt(WithSettings([](S& s) { s.children = 1; }), "one child");
  ExpectCorrupt(WithSettings([](S& s) { s.children = 9; }), "nine children");
  ExpectCorrupt(WithSettings([](S& s) { s.hierarchy = static_cast<Hierarchy>(7); }), "hierarchy");
  ExpectCorrupt(WithSettings([](S& s) { s.offsets = static_cast<Offsets>(255); }), "offsets");
  ExpectCorrupt(WithSettings([](S& s) { s.representative = static_cast<Representative>(3); }),
                "representative");
  ExpectCorrupt(WithSettings([](S& s) { s.models = static_cast<Models>(2); }), "models");
}

TEST_P(ForgedTable, WithAnyByteOfTheSettingsChangedEndsWell) {
  const Parts small = Small();
  // Each bit flipped, all bits set, none.
  const std::string faults =
      RunGuarded(small.table.codec.size() * 10, 20, kAllowedBytes, [&](size_t i) {
        Parts parts = small;
        uint8_t& byte = parts.table.codec[i / 10];
        const size_t change = i % 10;
        byte = static_cast<uint8_t>(change < 8 ? byte ^ (1u << change) : (change == 8 ? 0 : 255));
        const ErrorKind error = ErrorOf(PutTogether(std::move(parts)));
        return error == ErrorKind::kCorrupt || error == ErrorKind::kUsage;
      });
  EXPECT_EQ(faults, "");
}

TEST_P(ForgedTable, WithSettingsCutOrLengthenedIsCorrupt) {
  const Parts small = Small();
  for (size_t size = 0; size <= small.table.codec.size() + 9; ++size) {
    if (size == small.table.codec.size()) continue;
    Parts parts = small;
    parts.table.codec.resize(size);
    EXPECT_EQ(ErrorOf(PutTogether(std::move(parts))), ErrorKind::kCorrupt) << size;
  }
}

TEST_P(ForgedTable, WithAnotherNumberOfLayersThanTheScheduleIsCorrupt) {
  Parts more = Small();
  more.table.layers.push_back(more.table.layers.back());
  more.segments.resize(more.segments.size() + 2 * more.table.subtrees.size());
  ExpectCorrupt(more, "one more layer");
  Parts fewer = Small();
  fewer.table.layers.pop_back();
  fewer.segments.resize(fewer.segments.size() - 2 * fewer.table.subtrees.size());
  ExpectCorrupt(fewer, "one layer less");
  Parts none = Small();
  none.table.layers.clear();
  none.segments.clear();
  ExpectCorrupt(none, "no layer");
}

TEST_P(ForgedTable, WithAScheduleOfOtherPartsEndsWell) {
  // The sum stays that of the table; what is a split layer becomes a refinement and the reverse.
  const Parts small = Small();
  const CodecParameters honest = ParametersIn(small);
  for (uint32_t split = 0; split <= honest.schedule.layers(); ++split) {
    Parts parts = small;
    CodecParameters parameters = honest;
    parameters.schedule = LayerSchedule(
        honest.extent, honest.settings.steps_per_octave, honest.settings.rounds_per_step, split,
        honest.schedule.layers() - split, honest.schedule.first_steps(), honest.schedule.parted());
    parts.table.codec = WriteParameters(parameters);
    if (split == honest.schedule.split_layers()) {
      EXPECT_EQ(ErrorOf(PutTogether(parts)), ErrorKind::kUsage);
    } else {
      ExpectCorrupt(parts, std::to_string(split) + " split layers");
    }
  }
}

TEST_P(ForgedTable, WithASubtreeLargerThanTheSettingsAllowIsCorrupt) {
  uint32_t largest = 0;
  for (const auto& subtree : Small().table.subtrees) largest = std::max(largest, subtree.vertices);
  const auto with_limit = [](uint32_t vertices) {
    return WithSettings([&](CodecSettings& s) { s.subtree_vertices = vertices; });
  };
  EXPECT_EQ(ErrorOf(PutTogether(with_limit(largest))), ErrorKind::kUsage);
  ExpectCorrupt(with_limit(largest - 1), "one vertex fewer");
  EXPECT_EQ(DecodeFileError(with_limit(largest - 1)), ErrorKind::kCorrupt);
}

TEST_P(ForgedTable, WithOtherVertexCountsIsCorrupt) {
  for (uint32_t count : {1u, 2u, 50u, 1000000u, 0x7fffffffu, 0xffffffffu}) {
    for (size_t subtree : {size_t{0}, Small().table.subtrees.size() - 1}) {
      Parts parts = Small();
      uint32_t& vertices = parts.table.subtrees[subtree].vertices;
      parts.table.vertices = parts.table.vertices - vertices + count;
      vertices = count;
      for (auto& layer : parts.table.layers) {
        layer.vertices = std::min(layer.vertices, parts.table.vertices);
      }
      ExpectCorrupt(parts, std::to_string(count) + " in subtree " + std::to_string(subtree));
    }
  }
}

TEST_P(ForgedTable, WithHugeCountsInEveryPlaceAndNoBytesIsCorrupt) {
  Parts parts = Small();
  parts.table.vertices = 0;
  for (auto& subtree : parts.table.subtrees) {
    subtree.vertices = 0xffffffffu;
    parts.table.vertices += subtree.vertices;
  }
  parts.table.faces = io::kMaxCount;
  for (auto& layer : parts.table.layers) {
    layer.vertices = parts.table.vertices;
    layer.faces = io::kMaxCount;
  }
  for (Bytes& segment : parts.segments) segment.clear();
  ExpectCorrupt(parts, "huge counts");
}

TEST_P(ForgedTable, WithHugeSegmentsThatAreNotThereHasNoCompleteLayer) {
  Parts parts = Small();
  const size_t header = io::ContainerReader::Open(SmallFile(), "small").value().header_bytes();
  // Sizes are part of the table, so the table is written with a file that is then cut to nothing.
  parts.segments.assign(parts.segments.size(), Bytes(5000));
  Bytes file = PutTogether(parts);
  file.resize(std::min(file.size(), 2 * header));
  EXPECT_EQ(ErrorOf(file), ErrorKind::kCorrupt);
}

TEST_P(ForgedTable, WithTheWidestLatticeEndsWell) {
  const Parts small = Small();
  const std::string faults = RunGuarded(200, 20, kAllowedBytes, [&](size_t i) {
    Parts parts = small;
    constexpr int32_t kWidest = (1 << 30) - 1;
    parts.table.extent = {kWidest, i % 2 == 0 ? kWidest : 0, i % 3 == 0 ? kWidest : 0};
    for (auto& subtree : parts.table.subtrees) {
      subtree.box_lo = {0, 0, 0};
      subtree.box_hi = parts.table.extent;
    }
    // As many layers as that lattice allows, so that the same number of segments stays.
    CodecParameters parameters = ParametersIn(small);
    parameters.settings.quantisation_levels = i % 5 == 0 ? 4096 : 2;
    parts.table.codec = WriteParameters(parameters);
    for (auto& segment : parts.segments) {
      for (auto& byte : segment) byte = static_cast<uint8_t>(byte * (i + 1));
    }
    const ErrorKind error = ErrorOf(PutTogether(std::move(parts)));
    return error == ErrorKind::kCorrupt || error == ErrorKind::kUsage;
  });
  EXPECT_EQ(faults, "");
}

TEST_P(ForgedTable, WithCountsOfALayerThatDifferFromItsMeshIsCorruptAsAFile) {
  const size_t last = Small().table.layers.size() - 1;
  for (int64_t difference : {-1, 1, 1000}) {
    Parts faces = Small();
    faces.table.layers[last].faces += static_cast<uint64_t>(difference);
    EXPECT_EQ(DecodeFileError(faces), ErrorKind::kCorrupt) << difference << " faces";
  }
  Parts fewer = Small();
  for (auto& layer : fewer.table.layers) {
    layer.vertices = std::min<uint64_t>(layer.vertices, fewer.table.vertices - 1);
  }
  EXPECT_EQ(DecodeFileError(fewer), ErrorKind::kCorrupt) << "one vertex fewer";
}

TEST_P(ForgedTable, WithMoreFacesThanADiskHoldsIsRefusedAsAFile) {
  for (uint64_t faces : {uint64_t{1} << 40, io::kMaxCount}) {
    Parts parts = Small();
    parts.table.faces = faces;
    parts.table.layers.back().faces = faces;
    const ErrorKind error = DecodeFileError(parts);
    EXPECT_TRUE(error == ErrorKind::kCorrupt || error == ErrorKind::kLimit)
        << static_cast<int>(error);
  }
}

TEST_P(ForgedTable, WithEitherCoordinateTypeEndsWellAsAFile) {
  for (const uint8_t type : {uint8_t{6}, uint8_t{7}}) {
    Parts parts = Small();
    parts.table.coordinate_type = type;
    const ErrorKind error = DecodeFileError(parts);
    EXPECT_TRUE(error == ErrorKind::kUsage || error == ErrorKind::kCorrupt)
        << static_cast<int>(type) << " gives " << static_cast<int>(error);
  }
}

TEST_P(ForgedTable, WithADigestOfAnotherMeshIsNotLossless) {
  for (int part : {0, 1}) {
    Parts parts = Small();
    ++(part == 0 ? parts.table.digest.vertices : parts.table.digest.faces);
    TemporaryFolder folder;
    WriteFile(folder.File("forged.folp"), PutTogether(parts));
    auto runner = parallel::MakeSerialRunner();
    parallel::Progress progress;
    auto report = VerifyFile(folder.File("forged.folp"), "", {}, *runner, progress);
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_FALSE(report->lossless);
    EXPECT_FALSE(report->reason.empty());
  }
}

TEST_P(ForgedTable, WithNeighboursThatShareNothingEndsWell) {
  // Seams between all subtrees, and none at all.
  for (bool all : {true, false}) {
    Parts parts = Small();
    for (uint32_t s = 0; s < parts.table.subtrees.size(); ++s) {
      auto& lower = parts.table.subtrees[s].lower_neighbours;
      lower.clear();
      for (uint32_t other = 0; all && other < s; ++other) lower.push_back(other);
    }
    const Bytes file = PutTogether(parts);
    EXPECT_EQ(RunGuarded(1, 20, kAllowedBytes,
                         [&](size_t) {
                           const ErrorKind error = ErrorOf(file);
                           return error == ErrorKind::kCorrupt || error == ErrorKind::kUsage;
                         }),
              "")
        << all;
  }
}

/// So many subtrees of two vertices, all alike, of which the file has next to nothing.
Bytes ManySubtrees(Parts parts, size_t count) {
  io::SubtreeRecord subtree = parts.table.subtrees[0];
  subtree.vertices = 2;
  subtree.lower_neighbours.clear();
  parts.table.subtrees.assign(count, subtree);
  parts.table.vertices = 2 * count;
  parts.segments.assign(parts.table.layers.size() * count * 2, {});
  for (auto& layer : parts.table.layers) {
    layer.vertices = std::min(layer.vertices, parts.table.vertices);
  }
  for (size_t s = 0; s < count; ++s) parts.segments[2 * s] = {0x5a};
  return PutTogether(std::move(parts));
}

TEST_P(ForgedTable, WithManySubtreesTakesNoMemoryForThemAll) {
  for (const size_t count : {100u, 180u, 1000u, 20000u}) {
    const Bytes file = ManySubtrees(Small(), count);
    const uint64_t allowed = kAllowedBytes + 64 * uint64_t{file.size()};
    EXPECT_EQ(RunGuarded(1, 5, allowed,
                         [&](size_t) {
                           const ErrorKind error = ErrorOf(file);
                           return error == ErrorKind::kCorrupt || error == ErrorKind::kLimit;
                         }),
              "")
        << count << " subtrees in " << file.size() << " bytes";
  }
  const Bytes file = ManySubtrees(Small(), 1000);
  const auto refused = MemoryDecoder::Open(file);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::kLimit) << refused.error().message;
  EXPECT_TRUE(MemoryDecoder::Open(file, uint64_t{1} << 30).ok()) << "the limit can be raised";
}

TEST_P(ForgedTable, OfAMeshWithoutVerticesDecodesToNothingOrIsCorrupt) {
  Parts parts = Small();
  parts.table.vertices = parts.table.faces = 0;
  parts.table.subtrees.clear();
  parts.segments.clear();
  for (auto& layer : parts.table.layers) layer.vertices = layer.faces = 0;
  const ErrorKind error = ErrorOf(PutTogether(parts));
  EXPECT_TRUE(error == ErrorKind::kCorrupt || error == ErrorKind::kUsage);
}

}  // namespace
}  // namespace folprom::hostile
