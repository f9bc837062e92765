#include <array>
#include <charconv>
#include <iterator>
#include <string>
#include <type_traits>

#include "engine/attribute_bits.h"
#include "folprom/settings_keys.h"

namespace folprom {
namespace {

constexpr std::string_view kHierarchies[] = {"lloyd", "quadric"};
constexpr std::string_view kOffsets[] = {"cylindrical", "cartesian", "lattice"};
constexpr std::string_view kModels[] = {"full", "light"};
constexpr std::string_view kRepresentatives[] = {"curvature", "centre", "quadric"};

using S = CodecSettings;

constexpr SettingKey kKeys[] = {
    {"hierarchy", &S::hierarchy,
     "lloyd: vertex sets split top-down (section 2.1); quadric: contracted bottom-up, two a split",
     "", 0, 0, kHierarchies},
    {"offsets", &S::offsets,
     "rho, theta, z or x, y, z in the least-squares frame (section 2.2); lattice: exact, for "
     "quadric",
     "", 0, 0, kOffsets},
    {"subtree_vertices", &S::subtree_vertices,
     "largest subtree: unit of parallel work, memory and random access", "vertices", 1, 16777216},
    {"subtree_normals", &S::subtree_normals,
     "subtrees are cut by the metric of section 2.1; false: by Euclidean distance", ""},
    {"length_weight", &S::length_weight,
     "of area x length^2 beside the quadric error of a contraction; keeps rings regular", "", 0,
     10},
    {"children", &S::children, "K, children of a split (section 2)", "vertex sets", 2, 8},
    {"normal_metric", &S::normal_metric,
     "distances weigh normals by w_n (section 2.1); false: Euclidean distance", ""},
    {"metric_a", &S::metric_a, "a in w_n (section 2.1)", "", 0, 1},
    {"metric_b", &S::metric_b, "b in w_n (section 2.1)", "", 1, 64},
    {"lloyd_iterations", &S::lloyd_iterations, "at most this many Lloyd iterations a split",
     "iterations", 1, 100},
    {"lloyd_threshold", &S::lloyd_threshold,
     "Lloyd stops when the distortion falls by less than this part", "", 0, 1},
    {"representative", &S::representative,
     "curvature: a vertex of high curvature where curvature varies, else centre; centre: always; "
     "quadric: the point nearest to the tangent planes",
     "", 0, 0, kRepresentatives},
    {"curvature_threshold", &S::curvature_threshold,
     "T_c, deviation of curvature from which a representative is chosen by curvature", "", 0, 1},
    {"gaussian_ratio", &S::gaussian_ratio,
     "r_g, width of the Gaussian over the mean distance to the centre", "", 0.01, 100},
    {"quantisation_levels", &S::quantisation_levels, "Q, levels per coordinate of an offset",
     "levels", 2, 4096},
    {"adaptive_quantisation", &S::adaptive_quantisation,
     "steps from the neighbours' ranges, G = R / Q (section 2.2); false: one step for both", ""},
    {"predict_theta", &S::predict_theta, "predict angles from an even spread (section 2.3)", ""},
    {"predict_height", &S::predict_height, "predict heights from the parent (section 2.3)", ""},
    {"split_first", &S::split_first,
     "split sets of more than one vertex first, refine positions afterwards", ""},
    {"distortion_first", &S::distortion_first,
     "up to this part of a subtree's vertices sets are split by distortion, one flag each; then by "
     "spacing",
     "", 0, 1},
    {"fan_cuts", &S::fan_cuts,
     "splits of discs and half discs of faces at once, the likeliest first; flags for the others",
     ""},
    {"pivot_order", &S::pivot_order,
     "pivot flags in order of regularity (section 3); false: by vertex id", ""},
    {"nearer_child", &S::nearer_child, "side flags relative to the nearer child (section 3)", ""},
    {"trained", &S::trained,
     "models start from what other meshes taught them, with offsets = \"lattice\"; false: from "
     "nothing",
     ""},
    {"steps_per_octave", &S::steps_per_octave, "steps per halving of the vertex spacing", "steps",
     1, 8},
    {"least_layer", &S::least_layer,
     "vertices that a layer is expected to add; smaller ones are joined; 0: none are", "vertices",
     0, 1000000},
    {"step_parts", &S::step_parts,
     "most layers that a step of the spacing is; as many as pay for what the table says of a layer",
     "layers", 1, 8},
    {"rounds_per_step", &S::rounds_per_step,
     "rounds in which a step works down from its largest spacing, where sets are not split by "
     "distortion; at least one a layer",
     "rounds", 1, 16},
    {"effort", &S::effort,
     "1 fastest .. 9 smallest: sets subtree_vertices, density_step, mixers, models, step_parts, "
     "rounds_per_step, length_weight and distortion_first where they are not given beside it",
     "", 1, 9},
    {"density_step", &S::density_step,
     "between cells of the density over the tangent plane, with offsets = \"lattice\"; 0: none",
     "twentieths of the spacing", 0, 4},
    {"mixers", &S::mixers, "mixers that a decision averages, with offsets = \"lattice\"", "", 1, 3},
    {"models", &S::models,
     "of cuts, with fan_cuts, and of positions, with offsets = \"lattice\": full, from all that "
     "the "
     "ring looks like; light, from a few tables, faster",
     "", 0, 0, kModels},
    {"lod_fit", &S::lod_fit,
     "vertices of LODs are drawn off the mesh so that their faces are nearest to it, with offsets "
     "= "
     "\"lattice\"; false: at vertices of the mesh",
     ""},
};

std::string NumberText(double value) {
  std::array<char, 64> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 12)
          .ptr;
  return {text.data(), end};
}

Error OutOfRange(const SettingKey& key, const std::string& value) {
  std::string message = "setting " + std::string(key.name) + " is " + value + ", ";
  if (key.choices.empty()) {
    message += "must be " + NumberText(key.lo) + " .. " + NumberText(key.hi);
  } else {
    message += "must be below " + std::to_string(key.choices.size());
  }
  return {ErrorKind::kUsage, message};
}

template <class T>
Result<void> CheckValue(const SettingKey& key, T value) {
  if constexpr (std::is_enum_v<T>) {
    const auto index = static_cast<size_t>(value);
    if (index >= key.choices.size()) return OutOfRange(key, std::to_string(index));
  } else if constexpr (!std::is_same_v<T, bool>) {
    const auto number = static_cast<double>(value);
    // Negated, so that NaN fails.
    if (!(number >= key.lo && number <= key.hi)) return OutOfRange(key, NumberText(number));
  }
  return {};
}

}  // namespace

std::span<const SettingKey> SettingKeys() { return kKeys; }

CodecSettings WithEffort(CodecSettings settings, uint32_t effort) {
  struct Preset {
    uint32_t density_step, mixers, subtree_vertices, step_parts;
    double length_weight, distortion_first;
  };
  // Measured in tests/bench/RESULTS.md. Small subtrees are faster for they fit into the caches,
  // large ones smaller for they have fewer seams and models learn longer. The last looks at the
  // whole file alone: rings are even, and no early layer is told set by set.
  constexpr uint32_t k = 1024;
  constexpr Preset kPresets[] = {{0, 1, 64 * k, 1, 0.015, 0.05},  {4, 1, 64 * k, 4, 0.015, 0.05},
                                 {4, 1, 96 * k, 4, 0.015, 0.05},  {3, 2, 96 * k, 4, 0.015, 0.05},
                                 {2, 2, 144 * k, 4, 0.015, 0.05}, {2, 2, 512 * k, 4, 0.015, 0.05},
                                 {1, 2, 512 * k, 4, 0.015, 0.05}, {1, 3, 512 * k, 4, 0.03, 0.05},
                                 {1, 3, 1024 * k, 1, 0.1, 0}};
  settings.effort = effort;
  if (effort < 1 || effort > std::size(kPresets)) return settings;
  const Preset& preset = kPresets[effort - 1];
  settings.density_step = preset.density_step;
  settings.mixers = preset.mixers;
  settings.models = effort == 1 ? Models::kLight : Models::kFull;
  settings.subtree_vertices = preset.subtree_vertices;
  settings.step_parts = preset.step_parts;
  // Whose rounds of equal work are sorted and measured for; one is a tenth faster.
  settings.rounds_per_step = effort == 1 ? 1 : CodecSettings().rounds_per_step;
  settings.length_weight = preset.length_weight;
  settings.distortion_first = preset.distortion_first;
  return settings;
}

Result<void> CheckSettings(const CodecSettings& settings) {
  for (const SettingKey& key : kKeys) {
    const Result<void> checked =
        std::visit([&](auto member) { return CheckValue(key, settings.*member); }, key.member);
    if (!checked) return checked.error();
  }
  if (settings.offsets == Offsets::kLattice && settings.hierarchy != Hierarchy::kQuadric) {
    return Error{ErrorKind::kUsage, "offsets = \"lattice\" needs hierarchy = \"quadric\""};
  }
  return {};
}

Result<void> CheckOptions(const EncodeOptions& options) {
  if (options.bits < 1 || options.bits > 24) {
    return Error{ErrorKind::kUsage,
                 "bits is " + std::to_string(options.bits) + ", must be 1 .. 24"};
  }
  // Negated, so that NaN fails.
  if (!(options.tolerance >= 0 && options.tolerance <= kLargestTolerance)) {
    return Error{ErrorKind::kUsage, "tolerance is " + NumberText(options.tolerance) +
                                        ", must be 0 .. " + NumberText(kLargestTolerance)};
  }
  if (options.exact && options.codec.offsets != Offsets::kLattice) {
    return Error{ErrorKind::kUsage,
                 "exact needs offsets = \"lattice\" and hierarchy = \"quadric\", the defaults"};
  }
  if (options.keep_order && options.codec.offsets != Offsets::kLattice) {
    return Error{
        ErrorKind::kUsage,
        "keep_order needs offsets = \"lattice\" and hierarchy = \"quadric\", the defaults"};
  }
  if (const auto bits = ParseAttributeBits(options.attribute_bits); !bits) return bits.error();
  return CheckSettings(options.codec);
}

}  // namespace folprom
