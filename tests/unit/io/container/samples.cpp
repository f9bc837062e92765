#include "samples.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/memory_file.h"

namespace folprom::io {
namespace {

uint64_t Draw(std::mt19937_64* random, uint64_t lo, uint64_t hi) {
  return lo + (*random)() % (hi - lo + 1);
}

/// Small and large numbers alike.
uint64_t DrawAnyWidth(std::mt19937_64* random, int widest) {
  return (*random)() >> (64 - Draw(random, 1, static_cast<uint64_t>(widest)));
}

SubtreeRecord RandomSubtree(size_t number, const FileTable& table, std::mt19937_64* random) {
  SubtreeRecord subtree;
  subtree.vertices = static_cast<uint32_t>(std::max<uint64_t>(DrawAnyWidth(random, 32), 1));
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto extent = static_cast<uint64_t>(table.extent[axis]);
    const uint64_t lo = Draw(random, 0, extent);
    subtree.box_lo[axis] = static_cast<int32_t>(lo);
    subtree.box_hi[axis] = static_cast<int32_t>(Draw(random, lo, extent));
  }
  for (uint32_t i = 0; i < number; ++i) {
    if (Draw(random, 0, 2) == 0) subtree.lower_neighbours.push_back(i);
  }
  return subtree;
}

}  // namespace

FileTable RandomTable(uint64_t seed, bool few_bytes) {
  std::mt19937_64 random(seed);
  FileTable table;
  table.coordinate_type = static_cast<uint8_t>(Draw(&random, 6, 7));
  for (size_t axis = 0; axis < 3; ++axis) {
    table.origin[axis] = static_cast<double>(random()) * -1e-9;
    table.extent[axis] = static_cast<int32_t>(DrawAnyWidth(&random, 30));
  }
  table.unit = std::ldexp(1.1, static_cast<int>(Draw(&random, 0, 2000)) - 1000);
  table.tolerance = 0.1 * static_cast<double>(Draw(&random, 0, 9));
  table.codec.resize(Draw(&random, 0, 40));
  for (uint8_t& byte : table.codec) byte = static_cast<uint8_t>(random());
  table.digest = {random(), random()};
  for (uint64_t& bits : table.kind_bits) bits = DrawAnyWidth(&random, 64);
  table.subtrees.resize(Draw(&random, 0, few_bytes ? 3 : 20));
  for (size_t i = 0; i < table.subtrees.size(); ++i) {
    table.subtrees[i] = RandomSubtree(i, table, &random);
    table.vertices += table.subtrees[i].vertices;
  }
  table.faces = DrawAnyWidth(&random, 48);
  table.layers.resize(Draw(&random, 0, few_bytes ? 4 : 40));
  uint64_t vertices = 0;
  for (LayerRecord& layer : table.layers) {
    vertices = Draw(&random, vertices, table.vertices);
    layer = {NextErrorBound(static_cast<double>(random()) * 1e-12), vertices,
             DrawAnyWidth(&random, 48)};
  }
  table.segment_bytes.resize(table.layers.size() * table.subtrees.size() * 2);
  for (uint64_t& bytes : table.segment_bytes) {
    if (Draw(&random, 0, 3) == 0) continue;
    bytes = few_bytes ? Draw(&random, 0, 1500) >> Draw(&random, 0, 8) : DrawAnyWidth(&random, 32);
  }
  if (!table.HasSeams()) {
    for (size_t i = 1; i < table.segment_bytes.size(); i += 2) table.segment_bytes[i] = 0;
  }
  return table;
}

FileTable ScanLikeTable() {
  std::mt19937_64 random(7);
  FileTable table;
  table.faces = 871414;
  table.coordinate_type = 6;
  table.origin = {-0.1076, 0.0530, -0.0500};
  table.unit = 7.8125e-7;
  table.tolerance = 2.5e-5;
  table.extent = {131000, 92400, 58600};
  table.codec.resize(60, 5);
  table.digest = {random(), random()};
  table.kind_bits = {1200000, 2600000, 1900000, 1500000, 21000, 43000};
  for (uint32_t i = 0; i < 8; ++i) {
    SubtreeRecord subtree;
    subtree.vertices = static_cast<uint32_t>(Draw(&random, 45000, 65000));
    for (size_t axis = 0; axis < 3; ++axis) {
      subtree.box_lo[axis] = static_cast<int32_t>(Draw(&random, 0, 30000));
      subtree.box_hi[axis] = static_cast<int32_t>(Draw(&random, 31000, 58600));
    }
    for (uint32_t lower = i < 4 ? 0 : i - 4; lower < i; ++lower) {
      subtree.lower_neighbours.push_back(lower);
    }
    table.vertices += subtree.vertices;
    table.subtrees.push_back(subtree);
  }
  for (int i = 0; i < 30; ++i) {
    const double part = std::pow(2.0, -0.15 * (29 - i));
    LayerRecord layer;
    layer.error_bound = NextErrorBound(0.02 * std::pow(2.0, -0.25 * i));
    layer.vertices = static_cast<uint64_t>(part * static_cast<double>(table.vertices));
    layer.faces = 2 * layer.vertices + Draw(&random, 0, 200);
    table.layers.push_back(layer);
    for (int segment = 0; segment < 16; ++segment) {
      const double spread = 0.85 + 0.3 * static_cast<double>(Draw(&random, 0, 1000)) / 1000;
      const double largest = segment % 2 == 0 ? 12000 : 900;
      table.segment_bytes.push_back(static_cast<uint64_t>(largest * part * spread));
    }
  }
  return table;
}

FileTable ExampleTable() {
  FileTable table;
  table.vertices = 700;
  table.faces = 1396;
  table.coordinate_type = 6;
  table.origin = {-1, 0, 0.5};
  table.unit = 0.25;
  table.extent = {1000, 300, 0};
  table.tolerance = 8;
  table.codec = {0xc0, 0xde};
  table.digest = {0x0123456789abcdef, 0xfedcba9876543210};
  table.kind_bits = {100, 2000, 300, 40, 0, 5};
  table.layers = {{4, 100, 196}, {2, 700, 1396}};
  table.subtrees = {{400, {0, 0, 0}, {600, 300, 0}, {}}, {300, {500, 10, 0}, {1000, 300, 0}, {0}}};
  table.segment_bytes = {20, 0, 18, 3, 600, 0, 500, 7};
  return table;
}

std::vector<uint8_t> SampleSegment(const FileTable& table, size_t layer, size_t subtree,
                                   SegmentPart part) {
  const size_t index = table.SegmentIndex(layer, subtree, part);
  std::vector<uint8_t> bytes(table.segment_bytes[index]);
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<uint8_t>(index * 31 + i);
  return bytes;
}

std::vector<uint8_t> SampleFile(const FileTable& table) {
  std::vector<uint8_t> bytes;
  return support::WrittenContainer(table, [&](size_t layer, size_t subtree, SegmentPart part) {
    bytes = SampleSegment(table, layer, subtree, part);
    return std::span<const uint8_t>(bytes);
  });
}

}  // namespace folprom::io
