#include "engine/codec/parameters.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>
#include <variant>

#include "folprom/settings_keys.h"

namespace folprom {

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
  return {settings.density_step, settings.mixers, has_light_models()};
}

ConnectivitySettings CodecParameters::connectivity() const {
  return {settings.fan_cuts, settings.pivot_order, settings.nearer_child, has_light_models()};
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
  uint32_t per_octave = parameters.settings.steps_per_octave;
  Offsets offsets = parameters.settings.offsets;
  if (split_layers < 1 ||
      split_layers > SplitLayersFor(extent, 0, per_octave, offsets, 1, parted) ||
      refine_layers > RefineLayersFor(extent, 0, per_octave, offsets)) {
    throw Failure(ErrorKind::kCorrupt, "settings of the coder: number of layers out of range");
  }
  if (first_steps < 1 || first_steps > kMostFirstSteps) {
    throw Failure(ErrorKind::kCorrupt, "settings of the coder: steps of the first layer");
  }
  parameters.schedule = LayerSchedule(extent, per_octave, parameters.settings.rounds_per_step,
                                      split_layers, refine_layers, first_steps, parted);
  return parameters;
}

}  // namespace folprom
