#include "engine/verify_values.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/attributes/value.h"
#include "folprom/float_bits.h"

namespace folprom {
namespace {

/// Of a step: rounding to the type, of which a step is at least 4 spacings, may add an eighth.
constexpr double kHalf = 0.5 + 0.125;

}  // namespace

bool AreValuesAlike(const io::FileTable& table, std::span<const uint8_t> decoded,
                    std::span<const uint8_t> original) {
  if (decoded.size() != original.size()) return false;
  const size_t stride = table.schema.Stride();
  size_t offset = 0;
  for (size_t a = 0; a < table.schema.attributes.size(); ++a) {
    const ScalarType type = table.schema.attributes[a].type;
    const double step = table.attribute_ranges[a].step;
    for (size_t at = offset; at < decoded.size(); at += stride) {
      const uint64_t back = OrderedOf(type, &decoded[at]), was = OrderedOf(type, &original[at]);
      if (step == 0 ? back != was
                    : !(std::fabs(RealOf(type, back) - RealOf(type, was)) <= kHalf * step)) {
        return false;
      }
    }
    offset += ScalarSize(type);
  }
  return true;
}

std::string AttributesDiffer(const io::FileTable& table) {
  const bool any_rounded = std::ranges::any_of(
      table.attribute_ranges, [](const io::AttributeRange& range) { return range.step > 0; });
  return std::string("an attribute differs from that of the scan in its bits") +
         (any_rounded ? ", or by more than half a step" : "");
}

void CountAttributes(const io::FileTable& table, VerifyReport* report) {
  report->attributes = table.schema.attributes.size();
  for (const io::AttributeRange& range : table.attribute_ranges) {
    report->rounded_attributes += range.step > 0 ? 1 : 0;
  }
}

void CoordinateCheck::Add(double decoded, double original) {
  if (is_float) decoded = WidenFloat(std::bit_cast<float>(NarrowToFloatBits(decoded)));
  if (std::bit_cast<uint64_t>(decoded) == std::bit_cast<uint64_t>(original)) return;
  same_bits = false;
  // A NaN would be lost among the errors of other vertices.
  const double error = std::fabs(decoded - original);
  largest_error = std::max(largest_error,
                           std::isfinite(error) ? error : std::numeric_limits<double>::infinity());
}

void CoordinateCheck::Judge(const FolpFile& file, bool same_bits, VerifyReport* report) {
  if (file.lattice().exact) {
    if (!same_bits) report->reason = "a coordinate differs from that of the scan in its bits";
    return;
  }
  // The last digits of the subtraction itself are no error of the coder.
  if (report->max_position_error > report->tolerance * (1 + 1e-9)) {
    report->reason = "a position is off by more than the tolerance";
  }
}

}  // namespace folprom
