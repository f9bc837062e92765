// A scan whose vertices of equal coordinates are one.
#pragma once

#include <memory>
#include <vector>

#include "engine/weld/packed_position.h"
#include "engine/weld/position_weld.h"
#include "io/formats/derived_source.h"
#include "io/spill/spill.h"

namespace folprom {

/// Its vertices stand in the order in which the scan has them first, its faces as in the scan. Of a
/// scan whose vertices have attributes, these are lost. Thread-safe as the scan.
class WeldedSource final : public io::DerivedSource {
 public:
  /// Welds; see WeldPositions. spill: empty.
  WeldedSource(std::unique_ptr<io::MeshSource> scan, uint64_t memory_bytes,
               std::unique_ptr<io::SpillDirectory> spill, parallel::Runner& runner,
               parallel::Progress& progress);

  /// The vertex that one of the scan became.
  uint64_t NumberOf(uint64_t vertex) const {
    return io::MappedArray<uint64_t>(weld_.numbers)[vertex];
  }
  uint64_t spill_bytes() const { return spill_->SizeBytes(); }
  uint64_t peak_spill_bytes() const { return weld_.peak_spill_bytes; }

  uint64_t vertex_count() const override { return weld_.count; }
  size_t vertex_block_count() const override;
  uint64_t vertex_block_begin(size_t block) const override;
  Result<void> ReadVertexBlock(size_t block, std::vector<double>* xyz) const override;
  /// Nothing: see above.
  Result<void> ReadVertexAttributes(size_t block, std::vector<uint8_t>* values) const override;
  void DropResident() const override;

 private:
  Result<void> ReadFaces(size_t block, std::vector<io::Triangle>* triangles,
                         std::vector<uint8_t>* joins) const override;

  PackedPosition packed_;
  std::unique_ptr<io::SpillDirectory> spill_;
  PositionWeld weld_;
};

}  // namespace folprom
