#include "engine/codec/parameters.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

namespace folprom {
namespace {

constexpr int32_t kWidest = (1 << 30) - 1;
constexpr Int3 kExtent{100000, 250000, 7};

CodecParameters Some() {
  CodecParameters parameters;
  parameters.extent = kExtent;
  parameters.settings.hierarchy = Hierarchy::kLloyd;
  parameters.settings.offsets = Offsets::kCartesian;
  parameters.settings.children = 7;
  parameters.settings.metric_b = 3.5;
  parameters.settings.split_first = false;
  parameters.settings.representative = Representative::kCentre;
  parameters.settings.steps_per_octave = 3;
  parameters.settings = WithEffort(parameters.settings, 8);
  parameters.settings.distortion_first = 0.25;
  parameters.schedule =
      LayerSchedule(kExtent, 3, parameters.settings.rounds_per_step, 9, 4, 5, {6, 8, 4});
  return parameters;
}

void ExpectCorrupt(const std::vector<uint8_t>& bytes, const Int3& extent = kExtent) {
  try {
    ReadParameters(bytes, extent);
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.error().kind, ErrorKind::kCorrupt) << failure.error().message;
  }
}

TEST(CodecParameters, ComeBackFromTheirBytes) {
  const CodecParameters read = ReadParameters(WriteParameters(Some()), kExtent);
  EXPECT_EQ(read.settings.hierarchy, Hierarchy::kLloyd);
  EXPECT_EQ(read.settings.offsets, Offsets::kCartesian);
  EXPECT_EQ(read.settings.children, 7u);
  EXPECT_EQ(read.settings.metric_b, 3.5);
  EXPECT_FALSE(read.settings.split_first);
  EXPECT_EQ(read.settings.representative, Representative::kCentre);
  EXPECT_EQ(read.settings.distortion_first, 0.25);
  EXPECT_EQ(read.settings.effort, 8u);
  EXPECT_EQ(read.settings.density_step, Some().settings.density_step);
  EXPECT_EQ(read.settings.mixers, Some().settings.mixers);
  EXPECT_EQ(read.extent, kExtent);
  EXPECT_EQ(read.schedule.split_layers(), 9u);
  EXPECT_EQ(read.schedule.refine_layers(), 4u);
  EXPECT_EQ(read.schedule.first_steps(), 5u);
  EXPECT_EQ(read.schedule.parted().begin, 6u);
  EXPECT_EQ(read.schedule.parted().end, 8u);
  EXPECT_EQ(read.schedule.parted().parts, 4u);
  EXPECT_EQ(WriteParameters(read), WriteParameters(Some()));
}

TEST(CodecParameters, CutOrLengthenedAreCorrupt) {
  const std::vector<uint8_t> whole = WriteParameters(Some());
  for (size_t size = 0; size < whole.size(); ++size) {
    ExpectCorrupt({whole.begin(), whole.begin() + static_cast<ptrdiff_t>(size)});
  }
  std::vector<uint8_t> longer = whole;
  longer.push_back(0);
  ExpectCorrupt(longer);
}

CodecParameters SomeExact() {
  CodecParameters parameters = Some();
  parameters.settings.hierarchy = Hierarchy::kQuadric;
  parameters.settings.offsets = Offsets::kLattice;
  parameters.exact = ExactLattice{{2, -7, false, true}, {}};
  return parameters;
}

TEST(CodecParameters, OfAnExactLatticeComeBack) {
  const CodecParameters read = ReadParameters(WriteParameters(SomeExact()), kExtent);
  ASSERT_TRUE(read.exact.has_value());
  EXPECT_EQ(read.exact->step, SomeExact().exact->step);
  EXPECT_TRUE(read.has_rests());
  EXPECT_FALSE(ReadParameters(WriteParameters(Some()), kExtent).exact.has_value());
}

TEST(CodecParameters, OfNoExactLatticeAreCorrupt) {
  const std::vector<uint8_t> whole = WriteParameters(SomeExact());
  for (size_t cut = 1; cut < 6; ++cut) {
    ExpectCorrupt({whole.begin(), whole.end() - static_cast<ptrdiff_t>(cut)});
  }
  for (const ExactStep& step : {ExactStep{3, 0, false, true}, ExactStep{10, -1, false, true},
                                ExactStep{10, 23, false, true}, ExactStep{2, -127, false, true},
                                ExactStep{2, 1075, false, true}}) {
    CodecParameters parameters = SomeExact();
    parameters.exact->step = step;
    ExpectCorrupt(WriteParameters(parameters));
  }
  std::vector<uint8_t> flag(whole.begin(), whole.end() - 1);
  flag.push_back(2);
  ExpectCorrupt(flag);
  CodecParameters cylindrical = SomeExact();
  cylindrical.settings.offsets = Offsets::kCylindrical;
  ExpectCorrupt(WriteParameters(cylindrical));
}

TEST(CodecParameters, OutOfRangeAreCorrupt) {
  CodecParameters nan = Some();
  nan.settings.metric_a = std::numeric_limits<double>::quiet_NaN();
  ExpectCorrupt(WriteParameters(nan));
  CodecParameters children = Some();
  children.settings.children = 9;
  ExpectCorrupt(WriteParameters(children));
  for (auto [split, refine] : {std::pair{0u, 4u}, {9u, 100000u}, {100000u, 4u}, {~0u, 1u}}) {
    CodecParameters layers = Some();
    layers.schedule = LayerSchedule(kExtent, 3, 2, split, refine);
    ExpectCorrupt(WriteParameters(layers));
  }
  for (uint32_t first_steps : {0u, kMostFirstSteps + 1, 65535u}) {
    CodecParameters first = Some();
    first.schedule = LayerSchedule(kExtent, 3, 2, 9, 4, first_steps);
    ExpectCorrupt(WriteParameters(first));
  }
}

TEST(LayerSchedule, FallsFromLayerToLayerToTheLeafBound) {
  for (const Int3& extent : {Int3{1, 0, 0}, kExtent, Int3{kWidest, kWidest, kWidest}}) {
    for (double edge : {0.0, 50.0, 1e4}) {
      for (uint32_t per_octave = 1; per_octave <= 8; ++per_octave) {
        const LayerSchedule schedule(
            extent, per_octave, 2, SplitLayersFor(extent, edge, per_octave, Offsets::kCylindrical),
            RefineLayersFor(extent, edge, per_octave, Offsets::kCylindrical));
        double spacing = 2e9, bound = 2e9;
        for (uint32_t layer = 0; layer < schedule.layers(); ++layer) {
          if (layer < schedule.split_layers()) {
            EXPECT_LT(schedule.SplitSpacing(layer), spacing);
            spacing = schedule.SplitSpacing(layer);
          } else {
            EXPECT_LT(schedule.RefineBound(layer), bound);
            bound = schedule.RefineBound(layer);
          }
        }
        EXPECT_EQ(spacing, 0);
        EXPECT_NEAR(bound, kLeafBound, 1e-9);
      }
    }
  }
}

TEST(LayerSchedule, JoinsLayersOfFewVerticesUntilAStepAddsEnough) {
  constexpr uint32_t kPerOctave = 4, kLeast = 100;
  const uint32_t first = FirstStepsFor(kExtent, 100, 20000, kLeast, kPerOctave);
  ASSERT_GT(first, 1u);
  const uint32_t split = SplitLayersFor(kExtent, 100, kPerOctave, Offsets::kLattice, first);
  EXPECT_LT(split, SplitLayersFor(kExtent, 100, kPerOctave, Offsets::kLattice));
  const LayerSchedule schedule(kExtent, kPerOctave, 1, split, 0, first);
  // Vertices of a surface that has 20,000 where they are 100 apart.
  const auto vertices = [&](uint32_t layer) {
    const double spacing = schedule.SplitSpacing(layer);
    return 20000 * 100.0 * 100.0 / (spacing * spacing);
  };
  EXPECT_GE(vertices(0), kLeast);
  EXPECT_LT(vertices(0), kLeast * 1.5);
  for (uint32_t layer = 1; layer + 1 < split; ++layer) {
    EXPECT_GE(vertices(layer) - vertices(layer - 1), kLeast * 0.99) << layer;
    // Never more than a step more than that takes.
    EXPECT_LT(vertices(layer), (vertices(layer - 1) + vertices(0)) * 1.4143) << layer;
  }
}

TEST(LayerSchedule, TellsAStepInPartsOfTheSameSpacing) {
  constexpr uint32_t kPerOctave = 4;
  const PartedSteps parted{6, 9, 3};
  const LayerSchedule whole(kExtent, kPerOctave, 1, 14, 2, 5);
  const LayerSchedule parts(kExtent, kPerOctave, 1, 14, 2, 5, parted);
  std::vector<double> spacings;
  for (uint32_t layer = 0; layer + 1 < parts.split_layers(); ++layer) {
    const double spacing = parts.SplitSpacing(layer);
    if (parts.BeginsStep(layer)) {
      spacings.push_back(spacing);
    } else {
      EXPECT_EQ(spacing, spacings.back());
      EXPECT_EQ(parts.parts_left(layer) + 1, parts.parts_left(layer - 1));
    }
  }
  for (size_t i = 0; i < spacings.size(); ++i) {
    EXPECT_EQ(spacings[i], whole.SplitSpacing(static_cast<uint32_t>(i)));
  }
  EXPECT_TRUE(parts.BeginsStep(parts.split_layers() - 1));
  EXPECT_EQ(parts.parts_left(parts.split_layers() - 1), 0u);
  EXPECT_EQ(parts.SplitSpacing(parts.split_layers() - 1), 0);
}

TEST(LayerSchedule, PartsStepsFromTheFirstLayerToTheTypicalEdge) {
  CodecSettings settings;
  const uint32_t first = FirstStepsFor(kExtent, 100, 20000, 100, 4);
  const PartedSteps one = PartedStepsFor(kExtent, 100, first, settings, 1);
  const PartedSteps many = PartedStepsFor(kExtent, 100, first, settings, 40);
  EXPECT_EQ(one.begin, first);
  EXPECT_EQ(one.parts, settings.step_parts);
  EXPECT_GT(many.begin, one.begin);
  EXPECT_EQ(many.end, one.end);
  const uint32_t split = SplitLayersFor(kExtent, 100, 4, Offsets::kLattice, first, one);
  EXPECT_GT(split, SplitLayersFor(kExtent, 100, 4, Offsets::kLattice, first));
  const LayerSchedule schedule(kExtent, 4, 1, split, 0, first, one);
  for (uint32_t layer = 1; layer + 1 < split; ++layer) {
    if (schedule.parts_left(layer) > 0) {
      EXPECT_GE(schedule.SplitSpacing(layer), 100 / 1.19);
    }
  }
  CodecSettings off = settings;
  off.step_parts = 1;
  EXPECT_EQ(PartedStepsFor(kExtent, 100, first, off, 1).parts, 1u);
}

TEST(LayerSchedule, BeginsWithOneStepWhereSizesAreUnknown) {
  EXPECT_EQ(FirstStepsFor(kExtent, 0, 20000, 100, 4), 1u);
  EXPECT_EQ(FirstStepsFor(kExtent, 100, 0, 100, 4), 1u);
  EXPECT_EQ(FirstStepsFor(kExtent, 100, 20000, 0, 4), 1u);
  EXPECT_EQ(FirstStepsFor(kExtent, 1e9, 1, 1, 8), 1u);
  EXPECT_LE(FirstStepsFor({kWidest, 0, 0}, 1e-9, 1, 1000000, 8), kMostFirstSteps);
}

TEST(LayerSchedule, IsNeverLongerThanWhatAFileMayAnnounce) {
  // The table of a file holds at most 4096 layers.
  const Int3 widest{kWidest, kWidest, kWidest};
  EXPECT_LE(SplitLayersFor(widest, 0, 8, Offsets::kCylindrical) +
                RefineLayersFor(widest, 0, 8, Offsets::kCylindrical),
            4096u);
  for (double edge : {1.0, 64.0, 1e5, 1e9}) {
    for (uint32_t per_octave : {1u, 2u, 8u}) {
      EXPECT_LE(SplitLayersFor(widest, edge, per_octave, Offsets::kCylindrical),
                SplitLayersFor(widest, 0, per_octave, Offsets::kCylindrical));
      EXPECT_LE(RefineLayersFor(widest, edge, per_octave, Offsets::kCylindrical),
                RefineLayersFor(widest, 0, per_octave, Offsets::kCylindrical));
    }
  }
}

}  // namespace
}  // namespace folprom
