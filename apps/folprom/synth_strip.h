// Joins rows of samples by strips of triangles and numbers the samples that have a triangle.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/folprom/synth_rows.h"
#include "io/formats/mesh_source.h"

namespace folprom::cli {

class SurfaceSink;

/// Takes the rows of one part in order; holds three rows and two strips.
class StripMesher {
 public:
  /// `sink` may be null: then it only counts. `first_vertex`: number of the part's first vertex.
  StripMesher(bool ring, uint64_t first_vertex, SurfaceSink* sink);

  /// Where the next row is to be filled in.
  SampleRow* next_row() { return &upper_.samples; }
  void AddRow();
  /// After the last row.
  void Finish();

  uint64_t vertex_count() const { return next_vertex_ - first_vertex_; }
  uint64_t face_count() const { return faces_; }

 private:
  struct Row {
    SampleRow samples;
    std::vector<uint8_t> used;  ///< some triangle has the sample
    std::vector<uint64_t> ids;  ///< of the used samples
  };
  /// Corners are sample numbers, kUpper added for those of the strip's upper row.
  using StripTriangle = std::array<uint32_t, 3>;
  static constexpr uint32_t kUpper = uint32_t{1} << 31;

  void JoinRows(Row* lower, Row* upper, std::vector<StripTriangle>* strip) const;
  static bool Spans(const SampleRow& lower, const SampleRow& upper, const StripTriangle& triangle);
  void NumberRow(Row* row);
  void SendFaces(const Row& lower, const Row& upper, const std::vector<StripTriangle>& strip);

  const bool ring_;
  const uint64_t first_vertex_;
  SurfaceSink* const sink_;
  uint64_t rows_ = 0;
  uint64_t next_vertex_;
  uint64_t faces_ = 0;
  Row lower_, middle_, upper_;  ///< numbered; joined below; being joined
  std::vector<StripTriangle> lower_strip_, upper_strip_;
  std::vector<double> positions_;
  std::vector<io::Triangle> triangles_;
};

}  // namespace folprom::cli
