#include "engine/codec/parameters.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>
#include <variant>

#include "engine/entropy/fixed_math.h"
#include "engine/mesh/lattice.h"
#include "folprom/settings_keys.h"

namespace folprom {
namespace {

constexpr double kLog2 = 0.69314718055994530942;

/// Cells in split layers are this much smaller than the spacing when leaves do not wait.
constexpr double kCellsPerSpacing = 16;

/// New vertices of lattice offsets have this many cells per spacing.
constexpr double kLatticeCellsPerSpacing = 12;

/// The first layer's spacing as a part of the longest side: layers before it would hold a few dozen
/// vertices, less than the table says of them.
constexpr double kFirstSpacing = 4;

/// Steps that a schedule is worked out for; one of more is refused when it is read.
constexpr uint32_t kMostSteps = 4096;

/// Typical edges: where sets lie no further apart most are single vertices, and a step is little.
constexpr double kLeastParted = 1;

double HalvedBy(double value, double octaves) {
  uint32_t whole = static_cast<uint32_t>(octaves);
  value = value * ExpExact(-(octaves - static_cast<double>(whole)) * kLog2);
  for (uint32_t i = 0; i < whole; ++i) value = value / 2;
  return value;
}

/// Steps after the layer that begins when `done` are done.
uint32_t NextStep(uint32_t done, uint32_t first_steps, uint32_t layers_per_octave) {
  if (first_steps == 1) return done + 1;
  // Vertices over those after the first layer. Two octaves on a step adds more than one of them.
  const auto vertices = [&](uint32_t steps) {
    return ExpExact(2 * kLog2 * static_cast<double>(steps - first_steps) / layers_per_octave);
  };
  if (done - first_steps >= 2 * layers_per_octave) return done + 1;
  const double grown = vertices(done) + 1;
  while (vertices(++done) < grown) {
  }
  return done;
}

/// Layers that the steps behind the first `done` are.
uint32_t PartsAfter(uint32_t done, const PartedSteps& parted) {
  return done >= parted.begin && done < parted.end ? parted.parts : 1;
}

double Longest(const Int3& extent) {
  return static_cast<double>(std::max({extent.x, extent.y, extent.z, 1}));
}

}  // namespace

LayerSchedule::LayerSchedule(const Int3& extent, uint32_t layers_per_octave,
                             uint32_t rounds_per_layer, uint32_t split_layers,
                             uint32_t refine_layers, uint32_t first_steps, PartedSteps parted)
    : longest_(Longest(extent)),
      layers_per_octave_(layers_per_octave),
      rounds_per_layer_(rounds_per_layer),
      split_layers_(split_layers),
      refine_layers_(refine_layers),
      first_steps_(first_steps),
      parted_(parted) {
  uint32_t done = 0, next = first_steps;
  while (split_.size() + 1 < split_layers && split_.size() < kMostSteps) {
    const uint32_t parts = PartsAfter(done, parted);
    for (uint32_t part = 0; part < parts && split_.size() + 1 < split_layers; ++part) {
      split_.push_back({done, next, part, parts});
    }
    done = next;
    next = NextStep(done, first_steps, layers_per_octave);
  }
}

uint32_t LayerSchedule::rounds(uint32_t layer) const {
  if (layer >= split_layers_ || IsLastSplitLayer(layer)) return 1;
  return std::max(rounds_per_layer_ / Of(layer).parts, 1u);
}

double LayerSchedule::SplitSpacing(uint32_t layer) const {
  if (IsLastSplitLayer(layer)) return 0;
  return HalvedBy(longest_ / kFirstSpacing,
                  static_cast<double>(Of(layer).after) / static_cast<double>(layers_per_octave_));
}

double LayerSchedule::RefineBound(uint32_t layer) const {
  if (layer < split_layers_) {
    return std::max(kLeafBound, SplitSpacing(layer) / kCellsPerSpacing);
  }
  double bound = kLeafBound;
  uint32_t steps = layers() - 1 - layer;
  bound = bound * ExpExact(static_cast<double>(steps % layers_per_octave_) * kLog2 /
                           static_cast<double>(layers_per_octave_));
  for (uint32_t i = 0; i < steps / layers_per_octave_; ++i) bound = bound * 2;
  return bound;
}

uint32_t LayerSchedule::LatticeShift(uint32_t layer) const {
  if (layer >= split_layers_) return layers() - 1 - layer;
  // The last split layer has no spacing of its own.
  uint32_t measured = IsLastSplitLayer(layer) && layer > 0 ? layer - 1 : layer;
  auto cells = static_cast<uint64_t>(SplitSpacing(measured) / kLatticeCellsPerSpacing);
  return cells < 2 ? 0 : static_cast<uint32_t>(std::bit_width(cells)) - 1;
}

uint32_t FirstStepsFor(const Int3& extent, double typical_edge, uint64_t vertices,
                       uint32_t least_layer, uint32_t layers_per_octave) {
  if (!(typical_edge > 0) || vertices == 0 || least_layer == 0) return 1;
  const double apart = typical_edge * std::sqrt(static_cast<double>(vertices) / least_layer);
  const double ratio = std::max(Longest(extent) / kFirstSpacing / apart, 1.0);
  const double steps = Log2Exact(ratio) * layers_per_octave;
  return static_cast<uint32_t>(std::clamp(std::ceil(steps), 1.0, double{kMostFirstSteps}));
}

PartedSteps PartedStepsFor(const Int3& extent, double typical_edge, uint32_t first_steps,
                           const CodecSettings& settings, uint64_t subtrees) {
  if (settings.step_parts == 1 || first_steps == 1) return {};
  // Tables and checksums take this many times as much for a layer as those of a single subtree.
  const double cost = (3 + static_cast<double>(std::min<uint64_t>(subtrees, 1u << 20))) / 4;
  const double per_octave = settings.layers_per_octave;
  const double begin = first_steps + std::floor(Log2Exact(cost) * per_octave / 2);
  const double octaves =
      Log2Exact(std::max(Longest(extent) / kFirstSpacing / (kLeastParted * typical_edge), 1.0));
  const double end = std::floor(octaves * per_octave);
  if (!(begin < end)) return {};
  return {static_cast<uint32_t>(begin), static_cast<uint32_t>(end), settings.step_parts};
}

uint32_t SplitLayersFor(const Int3& extent, double typical_edge, uint32_t layers_per_octave,
                        Offsets offsets, uint32_t first_steps, PartedSteps parted) {
  double least = offsets == Offsets::kLattice ? 1 : 2 * kUnitsPerTolerance;
  double finest = std::max(typical_edge / 2, least);
  double octaves = std::max(Log2Exact(Longest(extent) / finest), 0.0);
  const uint32_t steps = static_cast<uint32_t>(octaves * layers_per_octave) + 1;
  uint32_t layers = 2;
  for (uint32_t done = first_steps; done < steps;) {
    const uint32_t next = NextStep(done, first_steps, layers_per_octave);
    layers += PartsAfter(done, parted);
    done = next;
  }
  return layers;
}

uint32_t RefineLayersFor(const Int3& extent, double typical_edge, uint32_t layers_per_octave,
                         Offsets offsets) {
  if (offsets == Offsets::kLattice) {
    // A bit per layer, from the cells of the last split layer on.
    double cells = (typical_edge > 0 ? typical_edge : Longest(extent)) / kLatticeCellsPerSpacing;
    return static_cast<uint32_t>(std::bit_width(static_cast<uint64_t>(cells))) + 1;
  }
  double coarsest = typical_edge > 0 ? typical_edge / 16 : Longest(extent);
  double octaves = std::max(Log2Exact(coarsest / kLeafBound), 0.0);
  return static_cast<uint32_t>(octaves * layers_per_octave) + 1;
}

const InitialStatistics* CodecParameters::start() const {
  if (statistics != nullptr) return statistics;
  const bool starts = settings.trained && settings.offsets == Offsets::kLattice;
  return starts ? &InitialStatistics::Trained() : nullptr;
}

OffsetSettings CodecParameters::offsets() const {
  return {children(),
          settings.quantisation_levels,
          settings.adaptive_quantisation,
          settings.predict_theta,
          settings.predict_height,
          settings.offsets == Offsets::kCartesian};
}

LatticeSettings CodecParameters::lattice() const {
  return {settings.density_step, settings.mixers};
}

ConnectivitySettings CodecParameters::connectivity() const {
  return {settings.fan_cuts, settings.pivot_order, settings.nearer_child};
}

namespace {

/// Visit(member) for each setting in the order of the table of keys; one list for both directions.
template <class Visit>
void ForEachMember(Visit visit) {
  for (const SettingKey& key : SettingKeys()) {
    std::visit([&](auto member) { visit(member); }, key.member);
  }
}

size_t BitmapBytes() { return (SettingKeys().size() + 7) / 8; }

static_assert(std::endian::native == std::endian::little, "fields are stored little-endian");

void Append(std::vector<uint8_t>* bytes, const void* data, size_t size) {
  const uint8_t* begin = static_cast<const uint8_t*>(data);
  bytes->insert(bytes->end(), begin, begin + size);
}

}  // namespace

std::vector<uint8_t> WriteParameters(const CodecParameters& parameters) {
  const CodecSettings defaults;
  std::vector<uint8_t> bytes(BitmapBytes(), 0);
  size_t key = 0;
  ForEachMember([&](auto member) {
    const auto& value = parameters.settings.*member;
    if (value != defaults.*member) {
      bytes[key / 8] = static_cast<uint8_t>(bytes[key / 8] | 1u << key % 8);
      if constexpr (!std::is_same_v<std::decay_t<decltype(value)>, bool>) {
        Append(&bytes, &value, sizeof value);
      }
    }
    ++key;
  });
  const LayerSchedule& schedule = parameters.schedule;
  std::vector<uint32_t> counts{schedule.split_layers(), schedule.refine_layers(),
                               schedule.first_steps()};
  if (parameters.settings.step_parts > 1) {
    counts.insert(counts.end(), {schedule.parted().begin, schedule.parted().end});
  }
  for (uint32_t count : counts) {
    const auto stored = static_cast<uint16_t>(std::min(count, 0xffffu));
    Append(&bytes, &stored, sizeof stored);
  }
  if (parameters.exact) {
    const ExactStep& step = parameters.exact->step;
    const auto radix = static_cast<uint8_t>(step.radix);
    const auto has_rests = static_cast<uint8_t>(step.has_rests);
    Append(&bytes, &radix, sizeof radix);
    Append(&bytes, &step.exponent, sizeof step.exponent);
    Append(&bytes, &has_rests, sizeof has_rests);
  }
  return bytes;
}

namespace {

/// Values from the front of the settings' bytes.
class Fields {
 public:
  explicit Fields(std::span<const uint8_t> bytes) : bytes_(bytes) {}

  size_t left() const { return bytes_.size(); }
  template <class T>
  T Take() {
    if (bytes_.size() < sizeof(T)) {
      throw Failure(ErrorKind::kCorrupt, "settings of the coder end early");
    }
    T value;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
    return value;
  }

 private:
  std::span<const uint8_t> bytes_;
};

/// Radix, exponent and has_rests from their 6 bytes.
ExactLattice ReadExact(const CodecSettings& settings, Fields* fields) {
  ExactLattice exact;
  const auto radix = fields->Take<uint8_t>();
  exact.step.exponent = fields->Take<int32_t>();
  const auto has_rests = fields->Take<uint8_t>();
  const int32_t least = radix == 2 ? ExactStep::kLeastBits : 0;
  const int32_t most = radix == 2 ? ExactStep::kMostBits : ExactStep::kMostDecimals;
  if ((radix != 2 && radix != 10) || exact.step.exponent < least || exact.step.exponent > most ||
      has_rests > 1 || settings.offsets != Offsets::kLattice) {
    throw Failure(ErrorKind::kCorrupt, "settings of the coder: exact lattice out of range");
  }
  exact.step.radix = radix;
  exact.step.has_rests = has_rests == 1;
  return exact;
}

}  // namespace

CodecParameters ReadParameters(std::span<const uint8_t> bytes, const Int3& extent) {
  CodecParameters parameters;
  parameters.extent = extent;
  Fields fields(bytes);
  std::vector<uint8_t> differs(BitmapBytes());
  for (uint8_t& eight : differs) eight = fields.Take<uint8_t>();
  size_t key = 0;
  ForEachMember([&](auto member) {
    auto& value = parameters.settings.*member;
    if (differs[key / 8] >> key % 8 & 1) {
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, bool>) {
        value = !value;
      } else {
        const auto usual = value;
        value = fields.Take<std::decay_t<decltype(value)>>();
        if (value == usual) {
          throw Failure(ErrorKind::kCorrupt, "settings of the coder: a usual value is spelt out");
        }
      }
    }
    ++key;
  });
  if (key % 8 != 0 && differs.back() >> key % 8 != 0) {
    throw Failure(ErrorKind::kCorrupt, "settings of the coder: a key that does not exist");
  }
  const auto split_layers = fields.Take<uint16_t>(), refine_layers = fields.Take<uint16_t>();
  const auto first_steps = fields.Take<uint16_t>();
  PartedSteps parted;
  parted.parts = parameters.settings.step_parts;
  if (parted.parts > 1) {
    parted.begin = fields.Take<uint16_t>();
    parted.end = fields.Take<uint16_t>();
  }
  if (fields.left() > 0) parameters.exact = ReadExact(parameters.settings, &fields);
  if (fields.left() > 0) {
    throw Failure(ErrorKind::kCorrupt, "settings of the coder are longer than expected");
  }
  Result<void> checked = CheckSettings(parameters.settings);
  if (!checked.ok()) {
    throw Failure(ErrorKind::kCorrupt, "settings of the coder: " + checked.error().message);
  }
  uint32_t per_octave = parameters.settings.layers_per_octave;
  Offsets offsets = parameters.settings.offsets;
  if (split_layers < 1 ||
      split_layers > SplitLayersFor(extent, 0, per_octave, offsets, 1, parted) ||
      refine_layers > RefineLayersFor(extent, 0, per_octave, offsets)) {
    throw Failure(ErrorKind::kCorrupt, "settings of the coder: number of layers out of range");
  }
  if (first_steps < 1 || first_steps > kMostFirstSteps) {
    throw Failure(ErrorKind::kCorrupt, "settings of the coder: steps of the first layer");
  }
  parameters.schedule = LayerSchedule(extent, per_octave, parameters.settings.rounds_per_layer,
                                      split_layers, refine_layers, first_steps, parted);
  return parameters;
}

}  // namespace folprom
