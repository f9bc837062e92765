#include "engine/encode_estimate.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "engine/codec/encode_subtree.h"
#include "engine/kept_attributes.h"
#include "engine/mesh/types.h"
#include "engine/run_guarded.h"
#include "engine/weld/position_weld.h"
#include "engine/weld/soup.h"
#include "folprom/folprom.h"
#include "io/spill/spill.h"
#include "parallel/runner.h"

namespace folprom {
namespace {

uint64_t SubtreesOf(const ExpectedScan& scan, const EncodeOptions& options) {
  // The cut leaves subtrees a little smaller than allowed.
  const double vertices = static_cast<double>(scan.vertices);
  const double most = static_cast<double>(options.codec.subtree_vertices);
  return vertices <= most ? 1 : static_cast<uint64_t>(std::ceil(1.08 * vertices / most));
}

uint64_t AttributeStride(const ExpectedScan& scan, const EncodeOptions& options) {
  return KeepsAttributes(options) ? scan.source.vertex_schema().Stride() : 0;
}

/// Sides of the box of a few blocks, those that are finite, in falling order.
std::array<double, 3> SampledSides(const io::MeshSource& source) {
  constexpr size_t kBlocks = 8;
  const size_t blocks = source.vertex_block_count(), step = std::max<size_t>(blocks / kBlocks, 1);
  std::array<double, 3> lo, hi;
  lo.fill(INFINITY);
  hi.fill(-INFINITY);
  std::vector<double> xyz;
  for (size_t block = 0; block < blocks; block += step) {
    source.ReadVertexBlock(block, &xyz).value();
    for (size_t i = 0; i < xyz.size(); ++i) {
      if (!std::isfinite(xyz[i])) continue;
      lo[i % 3] = std::min(lo[i % 3], xyz[i]);
      hi[i % 3] = std::max(hi[i % 3], xyz[i]);
    }
  }
  source.DropResident();
  std::array<double, 3> sides;
  for (size_t i = 0; i < 3; ++i) sides[i] = std::max(hi[i] - lo[i], 0.0);
  std::sort(sides.begin(), sides.end(), std::greater<>());
  return sides;
}

/// Steps of the lattice between neighbouring vertices of a surface that fills the box as most scans
/// do; at least 1.
double SpacingInSteps(const ExpectedScan& scan, const EncodeOptions& options) {
  const auto [a, b, c] = SampledSides(scan.source);
  if (!(a > 0) || !std::isfinite(a) || scan.vertices == 0) return 1;
  constexpr double kExactSteps = 1 << 20;  // decimals of common scans are about as fine
  constexpr double kMostSteps = 1 << 30;   // the working lattice has no more
  // In sides of a, so that nothing overflows or vanishes whatever the unit.
  double step = 1 / static_cast<double>((uint64_t{1} << options.bits) - 1);
  if (options.tolerance > 0) step = 2 * (options.tolerance / a);
  if (options.exact) step = 1 / kExactSteps;
  const double area = std::max(b / a + b / a * (c / a) + c / a, 0.01);
  const double spacing = std::sqrt(area / static_cast<double>(scan.vertices));
  return std::clamp(spacing / step, 1.0, kMostSteps);
}

std::string Text(uint64_t bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f MiB", static_cast<double>(bytes) / (1 << 20));
  return text;
}

[[noreturn]] void ThrowNoRoom(const std::string& folder, const std::string& what, uint64_t needed,
                              uint64_t free) {
  throw Failure(ErrorKind::kOutput, folder + ": no room: " + what + " take about " + Text(needed) +
                                        ", " + Text(free) + " are free");
}

/// A rough sheet of side x side vertices a unit apart, cut into triangles at random, as a binary
/// PLY file: a regular one would be coded faster than scans are.
std::vector<uint8_t> SheetFile(uint32_t side) {
  char header[256];
  const int size = std::snprintf(
      header, sizeof header,
      "ply\nformat binary_little_endian 1.0\nelement vertex %u\nproperty float x\nproperty float "
      "y\nproperty float z\nelement face %u\nproperty list uchar int vertex_indices\nend_header\n",
      side * side, 2 * (side - 1) * (side - 1));
  std::vector<uint8_t> bytes(header, header + size);
  const auto put = [&](const auto& value) {
    bytes.resize(bytes.size() + sizeof value);
    std::memcpy(bytes.data() + bytes.size() - sizeof value, &value, sizeof value);
  };
  uint32_t random = 1;
  const auto dice = [&] {
    random = random * 1664525 + 1013904223;
    return static_cast<float>(random >> 8) / static_cast<float>(1 << 24);
  };
  const auto jitter = [&] { return 0.9F * dice(); };
  for (uint32_t v = 0; v < side * side; ++v) {
    const auto x = static_cast<float>(v % side), y = static_cast<float>(v / side);
    put(x + jitter());
    put(y + jitter());
    put(10 * std::sin(x / 17) * std::cos(y / 13) + jitter());
  }
  const auto face = [&](uint32_t a, uint32_t b, uint32_t c) {
    put(uint8_t{3});
    put(a);
    put(b);
    put(c);
  };
  for (uint32_t v = 0; v < side * (side - 1); ++v) {
    if (v % side + 1 == side) continue;
    const bool rises = dice() < 0.5F;
    face(v, v + 1, rises ? v + side : v + side + 1);
    face(rises ? v + 1 : v, v + side + 1, v + side);
  }
  return bytes;
}

/// One thread, now, with these settings.
double SecondsPerVertex(EncodeOptions options, double spacing_in_steps,
                        parallel::Progress& progress) {
  constexpr uint32_t kSide = 256;
  const io::SpillDirectory folder(options.temporary_folder);
  io::WriteSpillFile(folder, "sheet.ply", SheetFile(kSide));
  options.temporary_folder = folder.path();
  if (!options.exact) options.tolerance = 0.5 / spacing_in_steps;
  const auto runner = parallel::MakeSerialRunner();
  const auto begin = std::chrono::steady_clock::now();
  EncodeFile(folder.File("sheet.ply"), folder.File("sheet.folp"), options, *runner, progress)
      .value();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  return seconds.count() / (kSide * kSide);
}

/// Before it is welded: that a surface is closed, and has no edges that part it.
ExpectedScan Expect(const io::MeshSource& source, const EncodeOptions& options) {
  const WeldKind kind = WeldFor(source, options);
  ExpectedScan scan{source, source.vertex_count(), kind != WeldKind::kAsItIs};
  if (kind == WeldKind::kSoup || (kind == WeldKind::kSurface && IsSoup(source))) {
    scan.vertices = source.triangle_count() / 2 + 2;
  }
  return scan;
}

/// Memory of one subtree under way.
uint64_t SubtreeBytes(const ExpectedScan& scan, const EncodeOptions& options) {
  const uint64_t vertices = std::max<uint64_t>(scan.vertices, 1);
  SubtreeSummary summary;
  summary.vertices =
      static_cast<uint32_t>(std::min<uint64_t>(scan.vertices, options.codec.subtree_vertices));
  summary.faces = static_cast<uint64_t>(static_cast<double>(scan.source.triangle_count()) *
                                        summary.vertices / static_cast<double>(vertices));
  CodecParameters parameters;
  if (options.exact) parameters.exact.emplace();
  if (AttributeStride(scan, options) > 0) {
    parameters.attributes.resize(scan.source.vertex_schema().attributes.size());
  }
  return EncodeSubtreeBytes(summary, parameters);
}

/// Of the partition: what its passes keep mapped and buffered.
uint64_t PartitionBytes(const ExpectedScan& scan, const EncodeOptions& options) {
  const uint64_t memory = options.limits.memory_bytes;
  const uint64_t mapped = std::min(memory / 8, 16 * scan.vertices) +
                          std::min(memory / 16, 16 * scan.vertices) +
                          std::min(memory / 16, 8 * scan.vertices);
  const uint64_t buffers = std::min(memory / 8, SubtreesOf(scan, options) * (128 << 10));
  return mapped + buffers;
}

}  // namespace

uint64_t EstimateSpillBytes(const ExpectedScan& scan, const EncodeOptions& options) {
  // Records of the passes, positions and the map of vertices; where a lattice may leave rests, the
  // coordinates themselves.
  uint64_t vertex_bytes = 16 + sizeof(Int3) + sizeof(VertexRef) + AttributeStride(scan, options);
  if (options.exact) vertex_bytes += sizeof(ExactPosition);
  // Cross faces, in two subtrees each or three: a border grows with the root of the vertices.
  const uint64_t subtrees = SubtreesOf(scan, options);
  const auto border = static_cast<uint64_t>(
      subtrees == 1 ? 0 : 10 * std::sqrt(static_cast<double>(options.codec.subtree_vertices)));
  return scan.vertices * vertex_bytes + scan.source.triangle_count() * sizeof(Face) +
         subtrees * border * sizeof(CrossFace);
}

uint64_t EstimateFileBytes(const ExpectedScan& scan, const EncodeOptions& options) {
  const double bits =
      6 + 2.2 * std::log2(SpacingInSteps(scan, options)) + (options.exact ? 6 : 0) +
      4 * static_cast<double>(AttributeStride(scan, options));  // half of what they have
  return static_cast<uint64_t>(bits / 8 * static_cast<double>(scan.vertices)) + 1024;
}

void CheckRoom(const RoomNeeded& spill, const RoomNeeded& output) {
  if (spill.volume.id == output.volume.id) {
    const uint64_t both = spill.bytes + output.bytes;
    if (both > spill.volume.free_bytes) {
      ThrowNoRoom(spill.folder, "temporary files and output", both, spill.volume.free_bytes);
    }
    return;
  }
  if (spill.bytes > spill.volume.free_bytes) {
    ThrowNoRoom(spill.folder, "temporary files", spill.bytes, spill.volume.free_bytes);
  }
  if (output.bytes > output.volume.free_bytes) {
    ThrowNoRoom(output.folder, "the bytes of the output", output.bytes, output.volume.free_bytes);
  }
}

Result<EncodeEstimate> EstimateEncode(const std::string& input, const EncodeOptions& options,
                                      parallel::Runner& runner, parallel::Progress& progress) {
  return RunGuarded<EncodeEstimate>([&] {
    CheckOptions(options).value();
    const auto source = io::MeshSource::Open(input, options.limits).value();
    EncodeEstimate estimate;
    const ExpectedScan scan = Expect(*source, options);
    estimate.vertices = scan.vertices;
    estimate.faces = source->triangle_count();
    estimate.spill_bytes = EstimateSpillBytes(scan, options);
    if (scan.is_welded) {
      // What is left of the weld is there while the rest of the work is done.
      estimate.spill_bytes =
          std::max(WeldSpillBytes(*source), estimate.spill_bytes +
                                                source->vertex_count() * sizeof(uint64_t) +
                                                scan.vertices * sizeof(ExactPosition));
    }
    estimate.file_bytes = EstimateFileBytes(scan, options);
    constexpr uint64_t kProgramBytes = uint64_t{40} << 20;
    const uint64_t one = SubtreeBytes(scan, options);
    const uint64_t at_once = std::clamp<uint64_t>(
        options.limits.memory_bytes * 3 / 4 / one, 1,
        std::min(SubtreesOf(scan, options), static_cast<uint64_t>(runner.threads())));
    estimate.memory_bytes = kProgramBytes + std::max(at_once * one, PartitionBytes(scan, options));
    const double per_vertex = SecondsPerVertex(options, SpacingInSteps(scan, options), progress);
    estimate.seconds =
        per_vertex * static_cast<double>(estimate.vertices) / static_cast<double>(at_once);
    return estimate;
  });
}

}  // namespace folprom
