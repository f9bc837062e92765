#include "engine/codec/border_coder.h"

#include <utility>

#include "engine/entropy/bit_coder.h"

namespace folprom {

namespace {

/// Edges that have no face on one side, by the numbers: faces too many, none, one, more.
uint32_t GapOf(const Complex& complex, uint32_t vertex) {
  const uint64_t edges = complex.Degree(vertex), faces = complex.Corners(vertex).size();
  if (edges <= faces) return edges < faces ? 0 : 1;
  return edges - faces == 1 ? 2 : 3;
}

}  // namespace

uint32_t GapsOf(const Complex& complex, uint32_t first, uint32_t second) {
  return GapOf(complex, first) * 4 + GapOf(complex, second);
}

BorderCoder::BorderCoder() : both_({kGaps, kMostDegree + 1}, 1), side_({kGaps}) {}

void BorderCoder::AddRoot(const Int3& position) {
  record_.root_position = position;
  set_count_ = 1;
}

void BorderCoder::Visit(LearnedStateVisitor& visitor) {
  both_.Visit(visitor);
  side_.Visit(visitor);
}

template <class Coder>
void BorderCoder::CodeSplit(Coder& coder, const BorderSplit& split, uint32_t* first,
                            uint32_t* second) {
  BorderEvent event;
  event.border = *first;
  event.connected = split.connected ? 1 : 0;
  if (both_.Code(coder, {split.gaps, split.degree}, 0,
                 split.first_touches && split.second_touches)) {
    event.both = 1;
    event.first_position = split.first;
    event.second_position = split.second;
    *second = set_count_++;
  } else {
    const bool is_second = side_.Code(coder, {split.gaps}, 0, split.second_touches);
    event.first_position = event.second_position = is_second ? split.second : split.first;
    if (is_second) std::swap(*first, *second);
  }
  record_.events.push_back(event);
}

template void BorderCoder::CodeSplit<BitEncoder>(BitEncoder&, const BorderSplit&, uint32_t*,
                                                 uint32_t*);
template void BorderCoder::CodeSplit<BitDecoder>(BitDecoder&, const BorderSplit&, uint32_t*,
                                                 uint32_t*);

}  // namespace folprom
