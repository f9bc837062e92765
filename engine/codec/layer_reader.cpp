#include "engine/codec/layer_reader.h"

#include <cmath>
#include <string>
#include <utility>

#include "engine/attributes/value_spans.h"
#include "io/formats/mesh_source.h"

namespace folprom {
namespace {

/// work() decodes the segment; what it finds wrong gets the file and the place before it.
template <class Work>
void DecodeSegment(const io::ContainerReader& container, size_t layer, size_t subtree,
                   io::SegmentPart part, BitDecoder* bits, Work work) {
  bits->StartSegment(container.Segment(layer, subtree, part).value());
  try {
    work();
    bits->FinishSegment();
  } catch (const Failure& failure) {
    if (failure.error().kind != ErrorKind::kCorrupt) throw;
    throw Failure(ErrorKind::kCorrupt,
                  container.PlaceOf(layer, subtree, part) + failure.error().message);
  }
}

/// What the table says of an exact lattice; origin and unit must be those of its step.
void CompleteExact(const io::FileTable& table, ExactLattice* exact) {
  ExactStep& step = exact->step;
  step.is_float = static_cast<ScalarType>(table.coordinate_type) == ScalarType::kFloat32;
  bool agrees = table.unit == step.Unit();
  for (size_t axis = 0; agrees && axis < 3; ++axis) {
    const double first = std::floor(step.Scaled(table.origin[axis]) + 0.5);
    agrees = std::fabs(first) <= static_cast<double>(ExactLattice::kLargestWhole);
    if (!agrees) break;
    exact->first[axis] = static_cast<int64_t>(first);
    agrees = step.Quotient(exact->first[axis], 0) == table.origin[axis];
  }
  if (!agrees) {
    throw Failure(ErrorKind::kCorrupt, "the lattice of the table is not that of the coder");
  }
}

SubtreeShape ShapeOf(const io::FileTable& table, size_t subtree, bool has_border) {
  const io::SubtreeRecord& record = table.subtrees[subtree];
  return {record.vertices,
          {record.box_lo[0], record.box_lo[1], record.box_lo[2]},
          {record.box_hi[0], record.box_hi[1], record.box_hi[2]},
          has_border,
          table.faces};
}

}  // namespace

CodecParameters ParametersOf(const io::FileTable& table, size_t layers_total) {
  CodecParameters parameters =
      ReadParameters(table.codec, {table.extent[0], table.extent[1], table.extent[2]});
  if (parameters.exact) CompleteExact(table, &*parameters.exact);
  parameters.attributes = ValueSpansOf(table.schema, table.attribute_ranges);
  if (!parameters.attributes.empty() && parameters.settings.offsets != Offsets::kLattice) {
    throw Failure(ErrorKind::kCorrupt, "attributes in a file of other offsets than the lattice's");
  }
  if (parameters.schedule.layers() != layers_total) {
    throw Failure(ErrorKind::kCorrupt, "the coder's settings announce " +
                                           std::to_string(parameters.schedule.layers()) +
                                           " layers, the table " + std::to_string(layers_total));
  }
  for (size_t s = 0; s < table.subtrees.size(); ++s) {
    if (table.subtrees[s].vertices <= parameters.settings.subtree_vertices) continue;
    throw Failure(ErrorKind::kCorrupt, "subtree " + std::to_string(s) + " has " +
                                           std::to_string(table.subtrees[s].vertices) +
                                           " vertices, the coder's settings allow " +
                                           std::to_string(parameters.settings.subtree_vertices));
  }
  return parameters;
}

Lattice LatticeOf(const io::FileTable& table, const CodecParameters& parameters) {
  return {table.origin, table.unit, table.extent, parameters.exact};
}

std::vector<bool> SubtreesWithBorder(const io::FileTable& table) {
  std::vector<bool> border(table.subtrees.size(), false);
  for (size_t s = 0; s < table.subtrees.size(); ++s) {
    for (uint32_t lower : table.subtrees[s].lower_neighbours) border[lower] = border[s] = true;
  }
  return border;
}

SubtreeReader::SubtreeReader(const io::ContainerReader& container,
                             const CodecParameters& parameters, size_t subtree, bool has_border)
    : container_(container),
      subtree_(subtree),
      coder_(parameters, ShapeOf(container.table(), subtree, has_border)) {}

void SubtreeReader::DecodeLayer() {
  DecodeSegment(container_, coder_.layers_done(), subtree_, io::SegmentPart::kInner, &bits_,
                [&] { coder_.CodeLayer(bits_, nullptr, nullptr); });
}

SeamReader::SeamReader(const io::ContainerReader& container, const CodecParameters& parameters,
                       size_t owner, std::vector<SeamCoder::Participant> participants)
    : container_(container),
      owner_(owner),
      coder_(parameters, std::move(participants), container.table().faces) {}

void SeamReader::DecodeLayer() {
  DecodeSegment(container_, layer_, owner_, io::SegmentPart::kSeam, &bits_,
                [&] { coder_.CodeLayer(bits_, nullptr, nullptr); });
  ++layer_;
}

}  // namespace folprom
