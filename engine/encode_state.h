// What an encoding has found out so far, beside what lies in its spill folder: enough to go on
// from.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/codec/cost_meters.h"
#include "engine/codec/encode_subtree.h"
#include "engine/partition/partition.h"
#include "engine/record_bytes.h"
#include "engine/resolution.h"
#include "io/container/file_table.h"

namespace folprom {

/// XXH3 of what the spill holds of a subtree after the partition.
struct ChunkHashes {
  uint64_t inner = 0;  ///< all but its cross faces
  uint64_t cross = 0;
  bool operator==(const ChunkHashes&) const = default;
};
ChunkHashes HashesOf(const SubtreeChunk& chunk);

/// After the partition.
struct PartitionState {
  Resolution resolution;
  double typical_edge = 0;  ///< lattice units, 0 without faces
  uint64_t peak_spill_bytes = 0;
  std::vector<SubtreeSummary> summaries;
  std::vector<io::AttributeRange> ranges;
  std::vector<ChunkHashes> hashes;  ///< by subtree
};

/// Of a subtree whose inner segments and border lie in the spill.
struct SubtreeOutcome {
  std::vector<uint32_t> inner_bytes;  ///< per layer
  std::vector<double> distance;
  std::vector<uint32_t> vertices;
  std::vector<uint64_t> faces;
  std::vector<bool> active;
  io::MeshDigest digest;
  CostMeters meters;
  uint64_t inner_hash = 0, border_hash = 0;  ///< XXH3 of the spilled files; no border: 0
};

/// Of a seam whose segments lie in the spill.
struct SeamOutcome {
  std::vector<uint32_t> bytes;  ///< per layer
  std::vector<uint64_t> faces;
  std::vector<bool> active;
  uint64_t face_digest = 0, meter = 0;
  uint64_t hash = 0;  ///< XXH3 of the spilled file
};

void Write(const PartitionState& state, RecordWriter* record);
void Write(const SubtreeOutcome& outcome, RecordWriter* record);
void Write(const SeamOutcome& outcome, RecordWriter* record);
/// Throw Failure kOutput where the record is cut.
void Read(RecordReader* record, PartitionState* state);
void Read(RecordReader* record, SubtreeOutcome* outcome);
void Read(RecordReader* record, SeamOutcome* outcome);

}  // namespace folprom
