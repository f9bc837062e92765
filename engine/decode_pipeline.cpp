#include "engine/decode_pipeline.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/codec/border_file.h"
#include "engine/codec/layer_reader.h"
#include "parallel/memory_budget.h"

namespace folprom {
namespace {

/// Per vertex of a subtree: complex, cells and sets 560, results 60; exact positions twice; of each
/// attribute 8 as it is coded, and twice what the scan has.
constexpr uint64_t kBytesPerVertex = 620, kExactBytesPerVertex = 48, kAttributeBytesPerVertex = 24;

/// Memory of a seam for each byte of the border files that it reads: an event takes 40 bytes there,
/// and its vertex as many as one of a subtree in the complex.
constexpr uint64_t kSeamBytesPerByte = 14;

/// How many subtrees may be under way or waiting for their turn.
size_t WindowOf(const io::FileTable& table, const std::vector<uint32_t>& subtrees, bool off_lattice,
                uint64_t memory_bytes, int threads) {
  uint64_t largest = 1;
  for (uint32_t s : subtrees) largest = std::max<uint64_t>(largest, table.subtrees[s].vertices);
  uint64_t per_vertex = kBytesPerVertex + (off_lattice ? kExactBytesPerVertex : 0) +
                        kAttributeBytesPerVertex * table.schema.attributes.size();
  const uint64_t models = table.schema.attributes.size() * AttributeCoder::kModelBytes;
  uint64_t fitting = memory_bytes / 2 / (largest * per_vertex + models);
  return static_cast<size_t>(std::clamp<uint64_t>(fitting, 1, 3 * static_cast<uint64_t>(threads)));
}

struct DecodedPart {
  std::vector<Int3> positions;
  std::vector<ExactPosition> exact;
  std::vector<Face> faces;
  std::vector<uint32_t> border_vertices;
  std::vector<uint8_t> attributes;
};

class Pipeline {
 public:
  Pipeline(const io::ContainerReader& container, const CodecParameters& parameters,
           const DecodeSelection& selection, uint64_t memory_bytes,
           const std::string& temporary_folder, parallel::Runner& runner,
           parallel::Progress& progress, MeshSink& sink)
      : container_(container),
        table_(container.table()),
        parameters_(parameters),
        lattice_(LatticeOf(table_, parameters_)),
        error_bound_(static_cast<double>(table_.layers[selection.layers - 1].error_bound)),
        selection_(selection),
        has_border_(SubtreesWithBorder(table_)),
        memory_bytes_(memory_bytes),
        runner_(runner),
        progress_(progress),
        sink_(sink) {
    if (std::find(has_border_.begin(), has_border_.end(), true) != has_border_.end()) {
      spill_.emplace(temporary_folder);
    }
  }

  DecodedSegments Run() {
    DecodedSegments decoded;
    DecodeWanted();
    decoded.seams = NeededSeams();
    const std::vector<uint32_t> around = OthersBeside(decoded.seams);
    DecodeOthers(around);
    DecodeSeams(decoded.seams);
    std::set_union(selection_.wanted.begin(), selection_.wanted.end(), around.begin(), around.end(),
                   std::back_inserter(decoded.subtrees));
    return decoded;
  }

 private:
  bool IsWanted(uint32_t subtree) const {
    return std::binary_search(selection_.wanted.begin(), selection_.wanted.end(), subtree);
  }

  /// Vertices to be decoded; where neither all layers nor all subtrees are, about so many.
  uint64_t VerticesOf(const std::vector<uint32_t>& subtrees) const {
    uint64_t vertices = 0;
    for (uint32_t s : subtrees) vertices += table_.subtrees[s].vertices;
    if (vertices == 0) return 0;
    const double part = static_cast<double>(vertices) / static_cast<double>(table_.vertices);
    const uint64_t in_all =
        std::min(table_.layers[selection_.layers - 1].vertices, table_.vertices);
    return static_cast<uint64_t>(std::llround(part * static_cast<double>(in_all)));
  }

  /// Returns how many may be under way.
  size_t StartStage(const char* name, const std::vector<uint32_t>& subtrees) {
    progress_.StartStage(name, VerticesOf(subtrees), "vertices");
    const bool drawn = parameters_.has_rests() || parameters_.fits_lods();
    return WindowOf(table_, subtrees, drawn, memory_bytes_, runner_.threads());
  }

  /// Where in `wanted` the tasks go, one after the other. Of few the largest come first, so that
  /// what is left to the last threads is small; the results of all of them may have to wait then.
  std::vector<size_t> OrderOfTasks(size_t window) const {
    const std::vector<uint32_t>& wanted = selection_.wanted;
    std::vector<size_t> order(wanted.size());
    std::iota(order.begin(), order.end(), size_t{0});
    if (wanted.size() > 2 * window) return order;
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
      return table_.subtrees[wanted[a]].vertices > table_.subtrees[wanted[b]].vertices;
    });
    return order;
  }

  void DecodeWanted() {
    const std::vector<uint32_t>& wanted = selection_.wanted;
    const size_t window = StartStage("decode", wanted);
    const std::vector<size_t> order = OrderOfTasks(window);
    std::vector<DecodedPart> parts(wanted.size());
    std::vector<bool> is_ready(wanted.size(), false);
    size_t next = 0;
    // The sink gets them in ascending order, whichever come first.
    runner_.Ordered(
        wanted.size(), window, [&](size_t i) { parts[order[i]] = DecodeSubtree(wanted[order[i]]); },
        [&](size_t i) {
          is_ready[order[i]] = true;
          for (; next < parts.size() && is_ready[next]; ++next) {
            DecodedPart part = std::exchange(parts[next], {});
            sink_.AddSubtree({wanted[next], part.positions, part.exact, part.faces,
                              part.border_vertices, part.attributes});
          }
        });
  }

  /// Owners whose seams may have a face that the sink wants.
  std::vector<uint32_t> NeededSeams() const {
    std::vector<uint32_t> owners;
    for (uint32_t s : selection_.wanted) {
      const auto& lower = table_.subtrees[s].lower_neighbours;
      if (sink_.WantsFacesAcross(s) && std::any_of(lower.begin(), lower.end(), [&](uint32_t other) {
            return IsWanted(other) && sink_.WantsFacesAcross(other);
          })) {
        owners.push_back(s);
      }
    }
    return owners;
  }

  /// Lower neighbours of these owners that are not decoded yet.
  std::vector<uint32_t> OthersBeside(const std::vector<uint32_t>& owners) const {
    std::vector<uint32_t> others;
    for (uint32_t owner : owners) {
      for (uint32_t s : table_.subtrees[owner].lower_neighbours) {
        if (!IsWanted(s)) others.push_back(s);
      }
    }
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    return others;
  }

  /// For their borders alone.
  void DecodeOthers(const std::vector<uint32_t>& others) {
    if (others.empty()) return;
    const size_t window = StartStage("neighbours", others);
    runner_.Ordered(
        others.size(), window, [&](size_t i) { DecodeSubtree(others[i]); }, [](size_t) {});
  }

  DecodedPart DecodeSubtree(uint32_t subtree) {
    progress_.ThrowIfCancelled();
    SubtreeReader reader(container_, parameters_, subtree, has_border_[subtree]);
    const std::vector<Int3>& decoded = reader.state().positions();
    // Layer by layer, for a subtree takes seconds.
    for (size_t layer = 0, seen = 0; layer < selection_.layers; ++layer) {
      reader.DecodeLayer();
      progress_.Advance(decoded.size() - seen);
      seen = decoded.size();
    }
    DecodedPart part;
    part.positions = reader.state().positions();
    part.exact = reader.state().DrawnPositions(lattice_, error_bound_);
    part.attributes = reader.state().Attributes();
    reader.state().AppendFaces(&part.faces);
    if (has_border_[subtree]) {
      part.border_vertices = reader.state().BorderVertices();
      SpillBorder(*spill_, subtree, reader.state().border(), {});
    }
    return part;
  }

  void DecodeSeams(const std::vector<uint32_t>& owners) {
    progress_.StartStage("seams", owners.size());
    std::vector<std::vector<SeamFace>> faces(owners.size());
    parallel::MemoryBudget budget(memory_bytes_ / 2);
    runner_.Ordered(
        owners.size(), 4 * static_cast<size_t>(runner_.threads()),
        [&](size_t i) {
          const std::vector<uint32_t> members = MembersOf(owners[i]);
          const auto lease = budget.Acquire(kSeamBytesPerByte * BorderBytes(*spill_, members));
          progress_.ThrowIfCancelled();
          faces[i] = DecodeSeam(owners[i], members);
        },
        [&](size_t i) {
          sink_.AddSeam(faces[i]);
          faces[i] = {};
          progress_.Advance(1);
        });
  }

  std::vector<uint32_t> MembersOf(uint32_t owner) const {
    std::vector<uint32_t> members = table_.subtrees[owner].lower_neighbours;
    members.push_back(owner);
    return members;
  }

  std::vector<SeamFace> DecodeSeam(uint32_t owner, const std::vector<uint32_t>& members) {
    std::vector<BorderFile> borders;
    for (uint32_t member : members) borders.push_back(LoadBorder(*spill_, member));
    std::vector<SeamCoder::Participant> participants;
    for (size_t i = 0; i < members.size(); ++i) {
      participants.push_back({members[i], &borders[i].record});
    }
    SeamReader reader(container_, parameters_, owner, participants);
    for (size_t layer = 0; layer < selection_.layers; ++layer) reader.DecodeLayer();
    std::vector<SeamFace> faces;
    reader.state().AppendFaces(&faces);
    // Corners in subtrees that were only needed for the replay have nobody to receive them.
    std::erase_if(faces, [&](const SeamFace& face) {
      return !std::all_of(face.begin(), face.end(),
                          [&](const BorderRef& ref) { return IsWanted(ref.subtree); });
    });
    return faces;
  }

  const io::ContainerReader& container_;
  const io::FileTable& table_;
  const CodecParameters& parameters_;
  Lattice lattice_;
  double error_bound_;  ///< of the layer that is decoded
  const DecodeSelection& selection_;
  std::vector<bool> has_border_;
  uint64_t memory_bytes_;
  parallel::Runner& runner_;
  parallel::Progress& progress_;
  MeshSink& sink_;
  std::optional<io::SpillDirectory> spill_;
};

}  // namespace

std::vector<uint32_t> AllSubtrees(const io::FileTable& table) {
  std::vector<uint32_t> all(table.subtrees.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

std::vector<uint32_t> SubtreesInBox(const io::FileTable& table, size_t layers, const double* lo,
                                    const double* hi) {
  // A representative lies no further than the error bound from each vertex that it stands for; a
  // step for what is left over of exact coordinates, and one for arithmetic.
  double slack = static_cast<double>(table.layers[layers - 1].error_bound) / table.unit + 2;
  std::vector<uint32_t> found;
  for (uint32_t s = 0; s < table.subtrees.size(); ++s) {
    bool meets = true;
    for (size_t i = 0; i < 3; ++i) {
      meets &= static_cast<double>(table.subtrees[s].box_lo[i]) - slack <= hi[i] &&
               static_cast<double>(table.subtrees[s].box_hi[i]) + slack >= lo[i];
    }
    if (meets) found.push_back(s);
  }
  return found;
}

uint64_t BytesOf(const io::ContainerReader& container, size_t layers,
                 const DecodedSegments& segments) {
  const io::FileTable& table = container.table();
  // All but the layers themselves: header, and the tables up to the last one.
  uint64_t bytes = layers == 0 ? container.header_bytes() : container.LayerEnd(layers - 1);
  for (size_t layer = 0; layer < layers; ++layer) {
    bytes -= container.LayerEnd(layer) - container.LayerBegin(layer);
  }
  auto add = [&](const std::vector<uint32_t>& subtrees, io::SegmentPart part) {
    for (uint32_t s : subtrees) {
      for (size_t layer = 0; layer < layers; ++layer) {
        bytes += table.segment_bytes[table.SegmentIndex(layer, s, part)];
      }
    }
  };
  add(segments.subtrees, io::SegmentPart::kInner);
  add(segments.seams, io::SegmentPart::kSeam);
  return bytes;
}

DecodedSegments DecodeInto(const io::ContainerReader& container, const CodecParameters& parameters,
                           const DecodeSelection& selection, uint64_t memory_bytes,
                           const std::string& temporary_folder, parallel::Runner& runner,
                           parallel::Progress& progress, MeshSink& sink) {
  return Pipeline(container, parameters, selection, memory_bytes, temporary_folder, runner,
                  progress, sink)
      .Run();
}

}  // namespace folprom
