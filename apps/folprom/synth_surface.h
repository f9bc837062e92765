// A scan-like surface of any size, made row by row in two passes that recompute everything by
// hashing: memory grows with the square root of the vertex count, a few megabytes for a billion.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "apps/folprom/synth_rows.h"
#include "io/formats/mesh_source.h"
#include "parallel/progress.h"

namespace folprom::cli {

/// Receives a surface in blocks: vertices and faces each in order, no face before its vertices.
class SurfaceSink {
 public:
  virtual ~SurfaceSink() = default;
  virtual void AddVertices(std::span<const double> xyz) = 0;
  virtual void AddFaces(std::span<const io::Triangle> faces) = 0;
};

enum class SynthKind : uint8_t {
  kScan,  ///< several components with relief of many scales, holes, noise and irregular sampling
  kRange  ///< depth images of an object, each a regular grid with holes, noise and jumps of depth
};

/// Every edge has one or two faces, oriented alike; no vertex is without a face. The same kind,
/// vertices and seed give the same surface on every machine. Methods throw parallel::Cancelled.
class SynthSurface {
 public:
  static constexpr uint64_t kMinVertices = 4;
  static constexpr uint64_t kMaxVertices = (uint64_t{1} << 32) - 1;  ///< as a PLY file can index

  /// First pass: counts what the holes take, and gives the rest to the last component, so that
  /// there are exactly `vertices` (kMinVertices .. kMaxVertices).
  SynthSurface(SynthKind kind, uint64_t vertices, uint64_t seed, parallel::Progress& progress);

  uint64_t vertex_count() const { return vertices_; }
  uint64_t face_count() const { return faces_; }

  /// Second pass: sends all to the sink.
  void Generate(SurfaceSink& sink, parallel::Progress& progress) const;

 private:
  void PlanScan(uint64_t vertices, uint64_t seed, parallel::Progress& progress);
  void PlanRange(uint64_t vertices, uint64_t seed, parallel::Progress& progress);
  /// Unless it has more than `most` vertices, or none.
  void Add(std::unique_ptr<RowSource> part, uint64_t most, parallel::Progress& progress);

  std::vector<std::unique_ptr<RowSource>> parts_;
  uint64_t vertices_ = 0;
  uint64_t faces_ = 0;
};

}  // namespace folprom::cli
