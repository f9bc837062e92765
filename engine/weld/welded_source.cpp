#include "engine/weld/welded_source.h"

#include <algorithm>
#include <utility>

namespace folprom {

WeldedSource::WeldedSource(std::unique_ptr<io::MeshSource> scan, uint64_t memory_bytes,
                           std::unique_ptr<io::SpillDirectory> spill, parallel::Runner& runner,
                           parallel::Progress& progress)
    : DerivedSource(std::move(scan)),
      packed_(DerivedSource::scan().coordinate_type()),
      spill_(std::move(spill)),
      weld_(WeldPositions(DerivedSource::scan(), memory_bytes, *spill_, runner, progress)) {}

size_t WeldedSource::vertex_block_count() const {
  return weld_.count / io::kBlockVertices + (weld_.count % io::kBlockVertices > 0);
}

uint64_t WeldedSource::vertex_block_begin(size_t block) const {
  return std::min<uint64_t>(block * io::kBlockVertices, weld_.count);
}

Result<void> WeldedSource::ReadVertexBlock(size_t block, std::vector<double>* xyz) const {
  const uint64_t begin = vertex_block_begin(block);
  const size_t count = vertex_block_begin(block + 1) - begin, words = packed_.words();
  const auto all = io::MappedArray<uint32_t>(weld_.positions);
  xyz->resize(3 * count);
  for (size_t i = 0; i < count; ++i) packed_.Unpack(&all[(begin + i) * words], &(*xyz)[3 * i]);
  return {};
}

Result<void> WeldedSource::ReadVertexAttributes(size_t /*block*/,
                                                std::vector<uint8_t>* values) const {
  values->clear();
  return {};
}

Result<void> WeldedSource::ReadFaces(size_t block, std::vector<io::Triangle>* triangles,
                                     std::vector<uint8_t>* joins) const {
  const Result<void> read = DerivedSource::ReadFaces(block, triangles, joins);
  if (!read) return read;
  for (io::Triangle& triangle : *triangles) {
    for (uint64_t& vertex : triangle) vertex = NumberOf(vertex);
  }
  return {};
}

void WeldedSource::DropResident() const {
  DerivedSource::DropResident();
  weld_.numbers.DropResident();
  weld_.positions.DropResident();
}

}  // namespace folprom
