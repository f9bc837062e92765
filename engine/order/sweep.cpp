#include "engine/order/sweep.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

constexpr int kVertexBucketBits = 16;
constexpr uint32_t kVertexBuckets = uint32_t{1} << kVertexBucketBits;

}  // namespace

SweepMaker::SweepMaker(const OrderMesh& mesh, WorkSpace& space)
    : mesh_(mesh), codes_(kVertexCodes), space_(space) {}

SweepMaker::SweepMaker(const OrderMesh& mesh, std::span<const uint32_t> place_of, bool is_soup,
                       WorkSpace& space)
    : mesh_(mesh),
      place_of_vertex_(place_of),
      codes_(is_soup ? kSoupCodes : kFaceCodes),
      space_(space) {}

Sweep SweepMaker::Make(uint32_t code) {
  const uint32_t key = code / 2;
  if (key == 0) return {{}, {}, code % 2 == 1};
  const bool is_of_faces = !place_of_vertex_.empty();
  const uint32_t count = is_of_faces ? mesh_.face_count() : mesh_.vertex_count();
  if (place_of_.empty()) {
    place_of_ = space_.Words(count);
    sequence_ = space_.Words(count);
    counts_ = space_.Words(is_of_faces ? place_of_vertex_.size() : kVertexBuckets);
  }
  if (key != key_) {
    if (is_of_faces) {
      SortFaces(key == 2);
    } else {
      SortVertices(key - 1);
    }
    for (uint32_t place = 0; place < count; ++place) {
      place_of_[sequence_[place]] = place;
      space_.Stepped(1);
    }
  }
  key_ = key;
  return {place_of_, sequence_, code % 2 == 1};
}

template <class BucketOf, class Less>
void SweepMaker::Sort(BucketOf bucket_of, Less less) {
  const auto count = static_cast<uint32_t>(sequence_.size());
  std::ranges::fill(counts_, 0u);
  for (uint32_t i = 0; i < count; ++i) {
    ++counts_[bucket_of(i)];
    space_.Stepped(1);
  }
  std::inclusive_scan(counts_.begin(), counts_.end(), counts_.begin());
  for (uint32_t i = count; i-- > 0;) {
    sequence_[--counts_[bucket_of(i)]] = i;
    space_.Stepped(1);
  }
  for (size_t bucket = 0; bucket < counts_.size(); ++bucket) {
    const size_t end = bucket + 1 < counts_.size() ? counts_[bucket + 1] : count;
    std::ranges::sort(sequence_.subspan(counts_[bucket], end - counts_[bucket]), less);
    space_.Stepped(1);
  }
}

void SweepMaker::SortVertices(uint32_t axis) {
  int32_t most = 0;
  for (const Int3& p : mesh_.positions) most = std::max(most, At(p, axis));
  const auto bits = static_cast<int>(std::bit_width(static_cast<uint32_t>(most)));
  const int shift = std::max(bits - kVertexBucketBits, 0);
  Sort([&](uint32_t v) { return static_cast<uint32_t>(At(mesh_.positions[v], axis)) >> shift; },
       [&](uint32_t a, uint32_t b) {
         const int32_t at_a = At(mesh_.positions[a], axis), at_b = At(mesh_.positions[b], axis);
         return at_a != at_b ? at_a < at_b : a < b;
       });
}

void SweepMaker::SortFaces(bool by_largest) {
  const auto sorted_places = [&](uint32_t face) {
    Face places;
    for (size_t i = 0; i < 3; ++i) places[i] = place_of_vertex_[mesh_.faces[face][i]];
    std::ranges::sort(places);
    if (by_largest) std::swap(places[0], places[2]);
    return places;
  };
  Sort([&](uint32_t face) { return sorted_places(face)[0]; },
       [&](uint32_t a, uint32_t b) {
         const Face at_a = sorted_places(a), at_b = sorted_places(b);
         return at_a != at_b ? at_a < at_b : a < b;
       });
}

uint32_t ChooseSweep(SweepMaker& maker, uint32_t count, std::span<const uint32_t> numbers) {
  uint32_t best = 0;
  size_t best_bytes = ~size_t{0};
  for (uint32_t code = 0; code < maker.codes(); ++code) {
    Remaining remaining(count, maker.Make(code));
    BitEncoder coder;
    uint32_t last = 0;
    for (const uint32_t number : numbers) {
      if (!remaining.Has(number)) continue;
      last = remaining.Code(coder, last, number);
      remaining.Remove(last);
    }
    const size_t bytes = coder.TakeSegment().size();
    if (bytes >= best_bytes) continue;
    best_bytes = bytes;
    best = code;
  }
  return best;
}

}  // namespace folprom
