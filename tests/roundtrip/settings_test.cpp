#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "folprom/settings_keys.h"
#include "tests/support/codec.h"
#include "tests/support/coders.h"
#include "tests/support/files.h"
#include "tests/support/meshes.h"
#include "tests/support/ply.h"
#include "tests/support/same_mesh.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

struct Case {
  std::string name;
  CodecSettings settings;
};
void PrintTo(const Case& given, std::ostream* out) { *out << given.name; }

std::string NameOf(std::string_view key, double value) {
  std::string text = std::string(key) + "_" + std::to_string(value);
  while (text.ends_with('0')) text.pop_back();
  if (text.ends_with('.')) text.pop_back();
  std::replace(text.begin(), text.end(), '.', '_');
  return text;
}

/// Each key of the config at both ends of its range, at each choice, on and off; all else as in
/// `coder`.
std::vector<Case> EverySetting(const CodecSettings& coder) {
  std::vector<Case> cases;
  for (const SettingKey& key : SettingKeys()) {
    std::visit(
        [&](auto member) {
          using Value = std::remove_reference_t<decltype(CodecSettings().*member)>;
          std::vector<double> values{key.lo, key.hi};
          if constexpr (std::is_same_v<Value, bool>) values = {0, 1};
          if constexpr (std::is_enum_v<Value>) {
            values.clear();
            for (size_t i = 0; i < key.choices.size(); ++i)
              values.push_back(static_cast<double>(i));
          }
          for (double value : values) {
            Case one{NameOf(key.name, value), coder};
            one.settings.*member = static_cast<Value>(value);
            // Lattice offsets go with the quadric hierarchy only.
            if (CheckSettings(one.settings)) cases.push_back(one);
          }
        },
        key.member);
  }
  return cases;
}

/// Settings whose effects meet.
std::vector<Case> Combinations() {
  std::vector<Case> cases;
  for (uint32_t children = 2; children <= 8; ++children) {
    CodecSettings settings = LloydSettings();
    settings.children = children;
    cases.push_back({"Children" + std::to_string(children), settings});
  }
  CodecSettings off = LloydSettings();
  off.normal_metric = off.adaptive_quantisation = off.predict_theta = off.predict_height = false;
  off.split_first = off.fan_cuts = off.pivot_order = off.nearer_child = false;
  off.representative = Representative::kCentre;
  cases.push_back({"EveryTechniqueOff", off});
  for (double first : {0.0, 0.3, 1.0}) {
    CodecSettings settings;
    settings.distortion_first = first;
    settings.steps_per_octave = first == 0 ? 1 : 4;
    cases.push_back({NameOf("QuadricLattice", first), settings});
  }
  for (uint32_t effort = 1; effort <= 9; ++effort) {
    CodecSettings settings = WithEffort({}, effort);
    settings.subtree_vertices = CodecSettings().subtree_vertices;
    cases.push_back({"Effort" + std::to_string(effort), settings});
  }
  CodecSettings coarse = LloydSettings();
  coarse.quantisation_levels = 2;
  coarse.children = 8;
  coarse.split_first = false;
  cases.push_back({"CoarseOffsetsRefinedAtOnce", coarse});
  CodecSettings fine = LloydSettings();
  fine.quantisation_levels = 4096;
  fine.children = 2;
  fine.adaptive_quantisation = false;
  cases.push_back({"FineOffsetsOfPairs", fine});
  CodecSettings plain = LloydSettings();
  plain.offsets = Offsets::kCartesian;
  plain.children = 7;
  plain.quantisation_levels = 5;
  plain.adaptive_quantisation = plain.predict_height = plain.split_first = false;
  cases.push_back({"CartesianOffsetsRefinedAtOnce", plain});
  CodecSettings many = LloydSettings();
  many.steps_per_octave = 8;
  many.rounds_per_step = 16;
  many.split_first = false;
  cases.push_back({"ManyLayersOfManyRounds", many});
  CodecSettings few = LloydSettings();
  few.steps_per_octave = few.rounds_per_step = 1;
  few.lloyd_iterations = 1;
  few.lloyd_threshold = 1;
  cases.push_back({"FewLayersOfPoorSplits", few});
  CodecSettings asked = LloydSettings();
  asked.distortion_first = 1;
  asked.representative = Representative::kCurvature;
  cases.push_back({"EverySplitAskedFor", asked});
  CodecSettings spaced = LloydSettings();
  spaced.distortion_first = 0;
  cases.push_back({"NoSplitAskedFor", spaced});
  return cases;
}

class SettingsTest : public ::testing::TestWithParam<Case> {
 protected:
  void ExpectLossless(const Mesh& mesh, uint32_t subtree_vertices, uint64_t least_subtrees) {
    TemporaryFolder folder;
    std::string scan = folder.File("scan.ply"), folp = folder.File("scan.folp");
    WritePly(scan, mesh, CoordinateType::kDouble);
    EncodeOptions options;
    options.bits = 20;
    options.codec = GetParam().settings;
    if (options.codec.subtree_vertices == CodecSettings().subtree_vertices) {
      options.codec.subtree_vertices = subtree_vertices;
      EXPECT_GE(Encode(scan, folp, options).subtrees, least_subtrees);
    } else {
      Encode(scan, folp, options);
    }
    VerifyReport by_digest = Verify(folp, "");
    EXPECT_TRUE(by_digest.lossless) << by_digest.reason;
    VerifyReport by_scan = Verify(folp, scan);
    EXPECT_TRUE(by_scan.lossless) << by_scan.reason;
    EXPECT_EQ(DifferenceOf(mesh, LodOf(folp), by_scan.tolerance), "");
  }
};

TEST_P(SettingsTest, BringsASphereWithHolesBack) {
  ExpectLossless(BumpySphere(1200, true, 1), 300, 4);
}

TEST_P(SettingsTest, BringsANonManifoldSoupBack) {
  ExpectLossless(NonManifoldSoup(250, 700, 2), 100, 3);
}

auto NameOfCase = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Key, SettingsTest, ::testing::ValuesIn(EverySetting({})), NameOfCase);
INSTANTIATE_TEST_SUITE_P(LloydKey, SettingsTest, ::testing::ValuesIn(EverySetting(LloydSettings())),
                         NameOfCase);
INSTANTIATE_TEST_SUITE_P(Combination, SettingsTest, ::testing::ValuesIn(Combinations()),
                         NameOfCase);

}  // namespace
}  // namespace folprom::support
