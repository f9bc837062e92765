// Keeps the resident part of large mappings small. Hints to the kernel; no result depends on it.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "io/files/mapped_file.h"
#include "io/formats/mesh_source.h"

namespace folprom::partition {

/// For a mapping that is read at random. A touched page brings up to 64 KiB around it along, so the
/// mapping is watched in regions of that size. Thread-safe.
class ResidentPages {
 public:
  /// Drops all pages each time regions of more than `limit_bytes` were touched.
  ResidentPages(const io::MappedFile& file, uint64_t limit_bytes);
  ~ResidentPages() { file_.DropResident(); }

  void Touch(size_t offset) {
    std::atomic<uint8_t>& touched = touched_[offset >> kRegionBits];
    if (touched.load(std::memory_order_relaxed) == 0) Mark(touched);
  }

 private:
  static constexpr int kRegionBits = 16;
  void Mark(std::atomic<uint8_t>& region);

  const io::MappedFile& file_;
  const uint64_t limit_regions_;
  std::vector<std::atomic<uint8_t>> touched_;
  std::atomic<uint64_t> count_{0};
  std::mutex dropping_;
};

/// For the scan itself, which is read block by block. Thread-safe.
class ResidentSource {
 public:
  ResidentSource(const io::MeshSource& source, uint64_t limit_bytes)
      : source_(source), limit_(limit_bytes) {}
  ~ResidentSource() { source_.DropResident(); }

  void TouchedVertices(uint64_t count) { Touched(count * kVertexBytes); }
  void TouchedTriangles(uint64_t count) { Touched(count * kTriangleBytes); }

 private:
  // What a record takes in the richest files that are common: coordinates as text or as doubles
  // with normals and colours.
  static constexpr uint64_t kVertexBytes = 64;
  static constexpr uint64_t kTriangleBytes = 32;
  void Touched(uint64_t bytes);

  const io::MeshSource& source_;
  const uint64_t limit_;
  std::atomic<uint64_t> touched_{0};
};

}  // namespace folprom::partition
