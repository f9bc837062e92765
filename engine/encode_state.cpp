#include "engine/encode_state.h"

#include <array>

#include "io/container/checksum.h"

namespace folprom {
namespace {

template <class T>
uint64_t HashOf(std::span<const T> values) {
  return io::XxHash64({reinterpret_cast<const uint8_t*>(values.data()), values.size_bytes()});
}

// One list of fields for both directions: each calls `field` with every number of the value.
template <class Outcome, class Field>
void VisitMeters(Outcome& meters, Field field) {
  field(meters.split), field(meters.root), field(meters.refinement), field(meters.exceptions);
  field(meters.seams), field(meters.rests);
  field(meters.offsets.theta), field(meters.offsets.rho), field(meters.offsets.z);
  field(meters.connectivity.connected), field(meters.connectivity.pivots);
  field(meters.connectivity.sides);
}

template <class State, class Field>
void VisitPlain(State& summary, Field field) {
  field(summary.vertices), field(summary.faces), field(summary.cross_faces);
  for (auto* corner : {&summary.box_lo, &summary.box_hi}) {
    field(corner->x), field(corner->y), field(corner->z);
  }
}

template <class Step, class Field>
void VisitStep(Step& step, Field field) {
  field(step.radix), field(step.exponent), field(step.is_float), field(step.has_rests);
}

template <class Resolution, class Field>
void VisitNumbers(Resolution& resolution, Field field) {
  for (auto& value : resolution.lattice.origin) field(value);
  field(resolution.lattice.unit);
  for (auto& value : resolution.lattice.extent) field(value);
  field(resolution.tolerance);
}

void WriteResolution(const Resolution& resolution, RecordWriter* record) {
  const auto put = [&](const auto& value) { record->Put(value); };
  VisitNumbers(resolution, put);
  record->Put(resolution.lattice.exact.has_value());
  if (!resolution.lattice.exact) return;
  VisitStep(resolution.lattice.exact->step, put);
  for (int64_t first : resolution.lattice.exact->first) record->Put(first);
}

void ReadResolution(RecordReader* record, Resolution* resolution) {
  const auto take = [&](auto& value) { record->Take(&value); };
  VisitNumbers(*resolution, take);
  resolution->lattice.exact.reset();
  if (!record->Take<bool>()) return;
  ExactLattice& exact = resolution->lattice.exact.emplace();
  VisitStep(exact.step, take);
  for (int64_t& first : exact.first) record->Take(&first);
}

}  // namespace

ChunkHashes HashesOf(const SubtreeChunk& chunk) {
  const std::array<uint64_t, 4> inner{HashOf(chunk.positions), HashOf(chunk.faces),
                                      HashOf(chunk.exact), HashOf(chunk.attributes)};
  return {HashOf(std::span<const uint64_t>(inner)), HashOf(chunk.cross_faces)};
}

void Write(const PartitionState& state, RecordWriter* record) {
  WriteResolution(state.resolution, record);
  record->Put(state.typical_edge);
  record->Put(state.peak_spill_bytes);
  record->Put(uint64_t{state.summaries.size()});
  for (const SubtreeSummary& summary : state.summaries) {
    VisitPlain(summary, [&](const auto& value) { record->Put(value); });
    record->PutAll(summary.neighbours);
  }
  record->PutAll(state.ranges);
  record->PutAll(state.hashes);
}

void Read(RecordReader* record, PartitionState* state) {
  ReadResolution(record, &state->resolution);
  record->Take(&state->typical_edge);
  record->Take(&state->peak_spill_bytes);
  state->summaries.clear();
  for (auto left = record->Take<uint64_t>(); left > 0; --left) {
    SubtreeSummary& summary = state->summaries.emplace_back();
    VisitPlain(summary, [&](auto& value) { record->Take(&value); });
    record->TakeAll(&summary.neighbours);
  }
  record->TakeAll(&state->ranges);
  record->TakeAll(&state->hashes);
}

void Write(const SubtreeOutcome& outcome, RecordWriter* record) {
  record->PutAll(outcome.inner_bytes);
  record->PutAll(outcome.distance);
  record->PutAll(outcome.vertices);
  record->PutAll(outcome.faces);
  record->PutFlags(outcome.active);
  record->Put(outcome.digest.vertices);
  record->Put(outcome.digest.faces);
  VisitMeters(outcome.meters, [&](uint64_t value) { record->Put(value); });
  record->PutAll(outcome.meters.attributes);
  record->Put(outcome.inner_hash);
  record->Put(outcome.border_hash);
}

void Read(RecordReader* record, SubtreeOutcome* outcome) {
  record->TakeAll(&outcome->inner_bytes);
  record->TakeAll(&outcome->distance);
  record->TakeAll(&outcome->vertices);
  record->TakeAll(&outcome->faces);
  record->TakeFlags(&outcome->active);
  record->Take(&outcome->digest.vertices);
  record->Take(&outcome->digest.faces);
  VisitMeters(outcome->meters, [&](uint64_t& value) { record->Take(&value); });
  record->TakeAll(&outcome->meters.attributes);
  record->Take(&outcome->inner_hash);
  record->Take(&outcome->border_hash);
}

void Write(const SeamOutcome& outcome, RecordWriter* record) {
  record->PutAll(outcome.bytes);
  record->PutAll(outcome.faces);
  record->PutFlags(outcome.active);
  record->Put(outcome.face_digest);
  record->Put(outcome.meter);
  record->Put(outcome.hash);
}

void Read(RecordReader* record, SeamOutcome* outcome) {
  record->TakeAll(&outcome->bytes);
  record->TakeAll(&outcome->faces);
  record->TakeFlags(&outcome->active);
  record->Take(&outcome->face_digest);
  record->Take(&outcome->meter);
  record->Take(&outcome->hash);
}

}  // namespace folprom
