#include "engine/partition/scatter.h"

#include <algorithm>
#include <set>
#include <utility>

#include "engine/attributes/value.h"
#include "engine/partition/block_pool.h"
#include "engine/partition/subtree_groups.h"

namespace folprom::partition {
namespace {

template <class T>
void AppendGroups(const SubtreeGroups<T>& groups, io::SpillStreams& streams) {
  for (uint32_t subtree : groups.subtrees()) {
    const std::span<const T> items = groups.Items(subtree);
    streams.Append(subtree, items.data(), items.size_bytes());
  }
}

struct VertexBlock {
  std::vector<VertexRecord> records;
  std::vector<VertexRef> refs;
  SubtreeGroups<Int3> positions;
  std::vector<double> xyz;
  SubtreeGroups<ExactPosition> exact;
  std::vector<uint8_t> attributes;
  SubtreeGroups<uint32_t> places;  // in the block, of the vertices
  std::vector<uint8_t> sorted_attributes;
  std::vector<io::AttributeRange> ranges;
};

// A cross face and the subtrees that it touches: two or three different ones, ascending.
struct TouchedFace {
  CrossFace face;
  std::array<uint32_t, 3> subtree;
  uint32_t subtree_count;
};

using SubtreePair = std::pair<uint32_t, uint32_t>;  // ascending

struct FaceBlock {
  std::vector<io::Triangle> triangles;
  SubtreeGroups<Face> faces;
  std::vector<TouchedFace> cross_faces;
  std::vector<SubtreePair> pairs;  // ascending, each once
};

TouchedFace Touched(const CrossFace& face) {
  TouchedFace touched{face, {}, 0};
  for (size_t corner = 0; corner < 3; ++corner) {
    touched.subtree[corner] = face.vertex[corner].subtree;
  }
  std::sort(touched.subtree.begin(), touched.subtree.end());
  const auto end = std::unique(touched.subtree.begin(), touched.subtree.end());
  touched.subtree_count = static_cast<uint32_t>(end - touched.subtree.begin());
  return touched;
}

std::vector<SubtreePair> Pairs(std::span<const TouchedFace> faces) {
  std::vector<SubtreePair> pairs;
  for (const TouchedFace& face : faces) {
    for (uint32_t i = 0; i + 1 < face.subtree_count; ++i) {
      for (uint32_t j = i + 1; j < face.subtree_count; ++j) {
        const SubtreePair pair{face.subtree[i], face.subtree[j]};
        if (pairs.empty() || pairs.back() != pair) pairs.push_back(pair);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

// Looks vertices up at random places of the two mapped files.
class VertexLookup {
 public:
  VertexLookup(const Job& job, const io::MappedFile& records, const io::MappedFile& vertex_map)
      : records_(io::MappedArray<VertexRecord>(records)),
        refs_(io::MappedArray<VertexRef>(vertex_map)),
        resident_records_(records, job.memory_bytes / 16),
        resident_refs_(vertex_map, job.memory_bytes / 16) {}

  VertexRef Ref(uint64_t vertex) {
    resident_refs_.Touch(vertex * sizeof(VertexRef));
    return refs_[vertex];
  }
  Int3 Position(uint64_t vertex) {
    resident_records_.Touch(vertex * sizeof(VertexRecord));
    return records_[vertex].position;
  }

 private:
  std::span<const VertexRecord> records_;
  std::span<const VertexRef> refs_;
  ResidentPages resident_records_;
  ResidentPages resident_refs_;
};

void Classify(VertexLookup& lookup, size_t subtree_count, FaceBlock* block) {
  block->faces.Start(subtree_count, block->triangles.size());
  block->cross_faces.clear();
  for (const io::Triangle& corner : block->triangles) {
    const VertexRef a = lookup.Ref(corner[0]), b = lookup.Ref(corner[1]), c = lookup.Ref(corner[2]);
    if (a.subtree == b.subtree && b.subtree == c.subtree) {
      block->faces.Add(a.subtree, Face{a.local, b.local, c.local});
      continue;
    }
    const CrossFace face{
        {a, b, c},
        {lookup.Position(corner[0]), lookup.Position(corner[1]), lookup.Position(corner[2])}};
    block->cross_faces.push_back(Touched(face));
  }
  block->faces.Sort();
  block->pairs = Pairs(block->cross_faces);
}

void Append(const FaceBlock& block, io::SpillStreams& faces, io::SpillStreams& cross_faces,
            std::span<SubtreeSummary> subtrees) {
  AppendGroups(block.faces, faces);
  for (uint32_t subtree : block.faces.subtrees()) {
    subtrees[subtree].faces += block.faces.Items(subtree).size();
  }
  for (const TouchedFace& touched : block.cross_faces) {
    for (uint32_t i = 0; i < touched.subtree_count; ++i) {
      cross_faces.AppendValue(touched.subtree[i], touched.face);
      ++subtrees[touched.subtree[i]].cross_faces;
    }
  }
}

// The coordinates of the block as the scan has them, by subtree.
void CollectExact(Job& job, size_t index, size_t subtree_count, VertexBlock* block) {
  job.source.ReadVertexBlock(index, &block->xyz).value();
  job.resident_source.TouchedVertices(block->refs.size());
  block->exact.Start(subtree_count, block->refs.size());
  for (size_t i = 0; i < block->refs.size(); ++i) {
    const double* xyz = &block->xyz[3 * i];
    block->exact.Add(block->refs[i].subtree, {xyz[0], xyz[1], xyz[2]});
  }
  block->exact.Sort();
}

// Of no vertex yet.
constexpr io::AttributeRange kNoValues{~uint64_t{0}, 0};

// The attributes of the block as the scan has them, by subtree, and their ranges.
void CollectAttributes(Job& job, size_t index, size_t subtree_count, VertexBlock* block) {
  const io::VertexSchema& schema = job.source.vertex_schema();
  const size_t stride = schema.Stride();
  job.source.ReadVertexAttributes(index, &block->attributes).value();
  block->ranges.assign(schema.attributes.size(), kNoValues);
  size_t offset = 0;
  for (size_t a = 0; a < schema.attributes.size(); ++a) {
    const ScalarType type = schema.attributes[a].type;
    io::AttributeRange& range = block->ranges[a];
    for (size_t i = offset; i < block->attributes.size(); i += stride) {
      const uint64_t value = OrderedOf(type, &block->attributes[i]);
      range.least = std::min(range.least, value);
      range.most = std::max(range.most, value);
    }
    offset += ScalarSize(type);
  }
  block->places.Start(subtree_count, block->refs.size());
  for (uint32_t i = 0; i < block->refs.size(); ++i) block->places.Add(block->refs[i].subtree, i);
  block->places.Sort();
}

void AppendAttributes(VertexBlock* block, size_t stride, io::SpillStreams& streams) {
  for (const uint32_t subtree : block->places.subtrees()) {
    std::vector<uint8_t>& sorted = block->sorted_attributes;
    sorted.clear();
    for (const uint32_t place : block->places.Items(subtree)) {
      const auto begin = block->attributes.begin() + static_cast<std::ptrdiff_t>(place * stride);
      sorted.insert(sorted.end(), begin, begin + static_cast<std::ptrdiff_t>(stride));
    }
    streams.Append(subtree, sorted.data(), sorted.size());
  }
}

}  // namespace

std::vector<io::AttributeRange> ScatterVertices(Job& job, const OffsetFile& records,
                                                std::span<const uint32_t> subtree_of_voxel,
                                                size_t subtree_count, OffsetFile& vertex_map,
                                                const VertexStreams& streams) {
  const size_t stride = job.source.vertex_schema().Stride();
  std::vector<io::AttributeRange> ranges;
  if (streams.attributes != nullptr) {
    ranges.assign(job.source.vertex_schema().attributes.size(), kNoValues);
  }
  BlockPool<VertexBlock> pool;
  std::vector<uint32_t> next_local(subtree_count);
  const auto produce = [&](size_t index) {
    VertexBlock& block = pool.Begin(index);
    const uint64_t first = job.source.vertex_block_begin(index);
    const auto count = static_cast<size_t>(job.source.vertex_block_begin(index + 1) - first);
    block.records.resize(count);
    records.ReadRecords<VertexRecord>(first, block.records);
    block.refs.resize(count);
    block.positions.Start(subtree_count, count);
    for (size_t i = 0; i < count; ++i) {
      const VertexRecord& record = block.records[i];
      const uint32_t subtree = subtree_of_voxel[record.voxel];
      block.refs[i] = {subtree, block.positions.Add(subtree, record.position)};
    }
    block.positions.Sort();
    if (streams.exact != nullptr) CollectExact(job, index, subtree_count, &block);
    if (streams.attributes != nullptr) CollectAttributes(job, index, subtree_count, &block);
  };
  const auto consume = [&](size_t index) {
    VertexBlock& block = pool.At(index);
    for (VertexRef& ref : block.refs) ref.local += next_local[ref.subtree];
    vertex_map.WriteRecords<VertexRef>(job.source.vertex_block_begin(index), block.refs);
    AppendGroups(block.positions, *streams.positions);
    if (streams.exact != nullptr) AppendGroups(block.exact, *streams.exact);
    if (streams.attributes != nullptr) AppendAttributes(&block, stride, *streams.attributes);
    for (size_t a = 0; a < ranges.size(); ++a) {
      ranges[a].least = std::min(ranges[a].least, block.ranges[a].least);
      ranges[a].most = std::max(ranges[a].most, block.ranges[a].most);
    }
    for (uint32_t subtree : block.positions.subtrees()) {
      next_local[subtree] += static_cast<uint32_t>(block.positions.Items(subtree).size());
    }
    const size_t count = block.refs.size();
    pool.End(index);
    job.progress.Advance(count);
  };
  job.runner.Ordered(job.source.vertex_block_count(), job.Window(), produce, consume);
  return ranges;
}

void ScatterFaces(Job& job, const io::MappedFile& records, const io::MappedFile& vertex_map,
                  io::SpillStreams& faces, io::SpillStreams& cross_faces,
                  std::span<SubtreeSummary> subtrees) {
  BlockPool<FaceBlock> pool;
  VertexLookup lookup(job, records, vertex_map);
  std::set<SubtreePair> pairs;
  const auto produce = [&](size_t index) {
    FaceBlock& block = pool.Begin(index);
    job.source.ReadTriangleBlock(index, &block.triangles).value();
    job.resident_source.TouchedTriangles(block.triangles.size());
    Classify(lookup, subtrees.size(), &block);
  };
  const auto consume = [&](size_t index) {
    FaceBlock& block = pool.At(index);
    Append(block, faces, cross_faces, subtrees);
    pairs.insert(block.pairs.begin(), block.pairs.end());
    const size_t count = block.triangles.size();
    pool.End(index);
    job.progress.Advance(count);
  };
  job.runner.Ordered(job.source.triangle_block_count(), job.Window(), produce, consume);
  // In the order of the set both lists come out ascending: all lower neighbours come first.
  for (const auto& [low, high] : pairs) subtrees[high].neighbours.push_back(low);
  for (const auto& [low, high] : pairs) subtrees[low].neighbours.push_back(high);
}

}  // namespace folprom::partition
