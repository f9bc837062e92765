#include "engine/codec/due_model.h"

#include <algorithm>

#include "engine/entropy/bit_coder.h"
#include "engine/entropy/fixed_math.h"

namespace folprom {
namespace {

constexpr uint32_t kLengths = 24, kShares = 6;

/// Quarter octaves; the round's spacing itself is 16.
uint32_t LengthBucket(double ratio) {
  const int bucket = HalfOctave(static_cast<uint64_t>(std::min(256 * ratio * ratio, 1e9)));
  return static_cast<uint32_t>(std::clamp(bucket, 0, static_cast<int>(kLengths) - 1));
}

uint32_t ShareBucket(const DueSigns& signs) {
  const uint64_t known = uint64_t{signs.split} + signs.waiting;
  return known == 0 ? 0 : 1 + static_cast<uint32_t>(uint64_t{4} * signs.split / known);
}

}  // namespace

DueModel::DueModel()
    : model_({kLengths * kLengths, kLengths * 2 * kShares, kLengths * kLengths * 2,
              kLengths * 2 * 4, kLengths * kShares * 2},
             2) {}

template <class Coder>
bool DueModel::Code(Coder& coder, const DueSigns& signs, bool due) {
  const uint32_t near = LengthBucket(signs.spacing), reach = LengthBucket(signs.scale);
  const uint32_t bent = LengthBucket(signs.distortion), asked = signs.asked ? 1 : 0;
  const uint32_t share = ShareBucket(signs);
  return model_.Code(
      coder,
      {near * kLengths + reach, (near * 2 + asked) * kShares + share,
       (near * kLengths + bent) * 2 + asked, (reach * 2 + asked) * 4 + std::min(signs.split, 3u),
       (bent * kShares + share) * 2 + asked},
      asked, due);
}

template bool DueModel::Code<BitEncoder>(BitEncoder&, const DueSigns&, bool);
template bool DueModel::Code<BitDecoder>(BitDecoder&, const DueSigns&, bool);

}  // namespace folprom
