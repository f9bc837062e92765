#include "engine/section_encoder.h"

#include <algorithm>
#include <string>

#include "engine/entropy/bit_coder.h"
#include "engine/face_rows.h"
#include "engine/order/face_value_digest.h"
#include "engine/order/face_values.h"
#include "engine/order/order_coder.h"
#include "engine/order/polygon_digest.h"
#include "engine/order/polygon_joins.h"
#include "engine/order/polygon_set.h"
#include "io/container/block_code.h"

namespace folprom {
namespace {

constexpr const char* kSectionName = "section";

/// The scan in the numbers of its vertices along the curve, and the coding of its order.
class SectionEncoder {
 public:
  SectionEncoder(const SectionChoice& choice, const io::MeshSource& source,
                 const PartitionedScan& scan, const io::MappedFile& curve_places,
                 const io::SpillDirectory& spill, uint64_t memory_bytes,
                 parallel::Progress& progress)
      : choice_(choice),
        source_(source),
        scan_(scan),
        curve_places_(curve_places),
        space_(spill, "order", memory_bytes),
        streams_(spill, kSectionName, io::kSectionKinds, io::kSectionKinds << 20),
        row_stream_(spill, "face_values", 1, uint64_t{1} << 20),
        progress_(progress) {
    for (size_t s = 0; s < scan.subtree_count(); ++s) {
      first_.push_back(first_.empty() ? 0 : first_.back() + scan.summary(s - 1).vertices);
    }
  }

  EncodedSections Encode() {
    const uint64_t vertices = source_.vertex_count(), faces = source_.triangle_count();
    CheckOrderable(vertices, faces, source_.path());
    progress_.StartStage("order", vertices + 2 * faces);
    CollectPositions();
    CollectSequence();
    CollectFaces();
    const OrderMesh mesh = MakeOrderMesh(positions_, faces_, space_);
    EncodedSections result;
    result.polygons = faces;
    result.largest_face = faces > 0 ? 3 : 0;
    if (choice_.face_values) {
      result.face_ranges = ranges_;
      values_.emplace(mesh, source_.face_schema(), ranges_, space_);
    }
    if (choice_.order) result.Section(io::SectionKind::kOrder) = EncodeOrder(mesh);
    if (choice_.polygons) {
      result.Section(io::SectionKind::kPolygons) = EncodePolygons(mesh, &result);
    }
    if (choice_.face_values) {
      EncodeFaceValues(mesh);
      result.Section(io::SectionKind::kFaceValues) = value_record_;
    }
    streams_.Finish();
    return result;
  }

 private:
  std::span<const uint32_t> CurvePlaces(size_t subtree) const {
    return io::MappedArray<uint32_t>(curve_places_)
        .subspan(first_[subtree], scan_.summary(subtree).vertices);
  }

  void CollectPositions() {
    positions_ = space_.Positions(source_.vertex_count());
    for (size_t s = 0; s < scan_.subtree_count(); ++s) {
      progress_.ThrowIfCancelled();
      const SubtreeChunk chunk = scan_.Load(s);
      const auto places = CurvePlaces(s);
      for (size_t v = 0; v < places.size(); ++v) {
        positions_[first_[s] + places[v]] = chunk.positions[v];
      }
      space_.Stepped(places.size());
    }
  }

  void CollectSequence() {
    const std::span<const VertexRef> refs = scan_.vertex_map();
    const auto places = io::MappedArray<uint32_t>(curve_places_);
    sequence_ = space_.Words(refs.size());
    for (size_t i = 0; i < refs.size(); ++i) {
      const uint64_t first = first_[refs[i].subtree];
      sequence_[i] = static_cast<uint32_t>(first + places[first + refs[i].local]);
      space_.Stepped(1);
    }
  }

  void CollectFaces() {
    faces_ = space_.Faces(source_.triangle_count());
    size_t next = 0;
    std::vector<io::Triangle> triangles;
    std::vector<uint8_t> joins;
    if (choice_.polygons) {
      const auto words = space_.Words((faces_.size() + 3) / 4);
      joins_ = {reinterpret_cast<uint8_t*>(words.data()), faces_.size()};
    }
    for (size_t block = 0; block < source_.triangle_block_count(); ++block) {
      progress_.ThrowIfCancelled();
      source_.ReadPolygonBlock(block, &triangles, &joins).value();
      if (choice_.face_values) CollectRows(block);
      if (choice_.polygons) {
        std::ranges::copy(joins, joins_.begin() + static_cast<std::ptrdiff_t>(next));
      }
      for (const io::Triangle& triangle : triangles) {
        Face& face = faces_[next++];
        for (size_t i = 0; i < 3; ++i) face[i] = sequence_[triangle[i]];
        space_.Stepped(1);
      }
      source_.DropResident();
      progress_.Advance(triangles.size());
    }
    row_stream_.Finish();
    if (choice_.face_values) {
      rows_ = FaceRows(source_.face_schema(), faces_, space_.Adopt(row_stream_.Map(0)));
    }
  }

  void CollectRows(size_t block) {
    std::vector<uint8_t> rows;
    source_.ReadFaceAttributes(block, &rows).value();
    row_stream_.Append(0, rows.data(), rows.size());
    AddToRanges(source_.face_schema(), rows, &ranges_);
  }

  void AppendBlock(io::SectionKind kind, std::span<const uint8_t> bytes,
                   io::SectionRecord* record) {
    const std::vector<uint8_t> framed = io::FramedBlock(bytes);
    streams_.Append(static_cast<size_t>(kind), framed.data(), framed.size());
    record->bytes += framed.size();
  }

  io::SectionRecord EncodeOrder(const OrderMesh& mesh) {
    io::SectionRecord record;
    place_of_ = space_.Words(sequence_.size());
    // That of the faces in hand, a soup needs the sequence no more.
    OrderCoder coder(mesh, sequence_, place_of_, choice_.is_soup, space_);
    BitEncoder bits;
    while (const uint32_t count = coder.NextVertices()) {
      progress_.ThrowIfCancelled();
      coder.CodeVertices(bits);
      AppendBlock(io::SectionKind::kOrder, bits.TakeSegment(), &record);
      progress_.Advance(count);
    }
    size_t begin = 0;
    while (const uint32_t count = coder.NextFaces()) {
      progress_.ThrowIfCancelled();
      coder.CodeFaces(bits, faces_.subspan(begin, count));
      AppendBlock(io::SectionKind::kOrder, bits.TakeSegment(), &record);
      begin += count;
      progress_.Advance(count);
    }
    record.digest = coder.digest();
    return record;
  }

  /// By the places of its vertices where the order is kept, else by their numbers.
  Face DigestedFace(size_t i) const {
    Face face = faces_[i];
    if (choice_.order) {
      for (uint32_t& corner : face) corner = place_of_[corner];
    }
    return face;
  }

  /// In the scan's order where it is kept; else as a set.
  io::SectionRecord EncodePolygons(const OrderMesh& mesh, EncodedSections* result) {
    io::SectionRecord record;
    if (choice_.order) {
      EncodeJoins(&record);
    } else {
      EncodePolygonSet(mesh, &record);
    }
    PolygonDigest digest;
    for (size_t i = 0; i < faces_.size(); ++i) {
      digest.Add(DigestedFace(i), joins_[i] != 0);
      space_.Stepped(1);
    }
    digest.Close();
    record.digest = digest.digest();
    result->polygons = digest.polygons();
    result->largest_face = digest.largest();
    return record;
  }

  void EncodeJoins(io::SectionRecord* record) {
    BitEncoder bits;
    PolygonJoins coder;
    for (size_t begin = 0; begin < faces_.size(); begin += kOrderBlock) {
      const size_t count = std::min<size_t>(kOrderBlock, faces_.size() - begin);
      coder.Code(bits, faces_.subspan(begin, count), joins_.subspan(begin, count));
      AppendBlock(io::SectionKind::kPolygons, bits.TakeSegment(), record);
      space_.Stepped(count);
    }
  }

  /// With the values of their faces and corners.
  void EncodePolygonSet(const OrderMesh& mesh, io::SectionRecord* record) {
    BitEncoder bits;
    PolygonTruth truth(mesh, faces_, joins_, space_);
    PolygonSet coder(mesh, &truth, space_);
    std::vector<Face> triangles;
    std::vector<uint8_t> joins;
    std::vector<PolygonTruth::Fan> fans;
    while (!coder.AtEnd()) {
      progress_.ThrowIfCancelled();
      triangles.clear();
      joins.clear();
      fans.clear();
      coder.Code(bits, kOrderBlock, &triangles, &joins, &fans);
      AppendBlock(io::SectionKind::kPolygons, bits.TakeSegment(), record);
      if (values_) CodeRows(triangles, joins, rows_.OfPolygons(triangles, joins, fans));
      progress_.Advance(triangles.size());
    }
  }

  /// A block of the section of face values.
  void CodeRows(std::span<const Face> triangles, std::span<const uint8_t> joins,
                std::vector<uint8_t> rows) {
    BitEncoder bits;
    values_->Code(bits, triangles, joins, rows);
    AppendBlock(io::SectionKind::kFaceValues, bits.TakeSegment(), &value_record_);
  }

  /// But those of a set of polygons, which are coded with it.
  void EncodeFaceValues(const OrderMesh& mesh) {
    if (choice_.order) {
      for (size_t begin = 0; begin < faces_.size(); begin += kOrderBlock) {
        progress_.ThrowIfCancelled();
        const size_t count = std::min<size_t>(kOrderBlock, faces_.size() - begin);
        const auto rows = rows_.Of(begin, count);
        const auto joins =
            joins_.empty() ? std::span<const uint8_t>() : joins_.subspan(begin, count);
        CodeRows(faces_.subspan(begin, count), joins, {rows.begin(), rows.end()});
      }
    } else if (!choice_.polygons) {
      const PolygonTruth truth(mesh, faces_, {}, space_);
      for (uint32_t begin = 0; begin < mesh.face_count(); begin += kOrderBlock) {
        progress_.ThrowIfCancelled();
        const uint32_t count = std::min(kOrderBlock, mesh.face_count() - begin);
        CodeRows(mesh.faces.subspan(begin, count), {}, rows_.OfNumbers(truth, begin, count));
      }
    }
    FaceValueDigest digest(source_.face_schema());
    for (size_t i = 0; i < faces_.size(); ++i) {
      digest.Add(DigestedFace(i), !joins_.empty() && joins_[i] != 0, rows_.Of(i));
      space_.Stepped(1);
    }
    digest.Close();
    value_record_.digest = digest.digest();
  }

  const SectionChoice choice_;
  const io::MeshSource& source_;
  const PartitionedScan& scan_;
  const io::MappedFile& curve_places_;
  MappedSpace space_;
  io::SpillStreams streams_, row_stream_;
  parallel::Progress& progress_;
  std::vector<uint64_t> first_;   ///< vertex of each subtree
  std::span<Int3> positions_;     ///< by number along the curve
  std::span<uint32_t> sequence_;  ///< of the vertices of the scan, these numbers
  std::span<uint32_t> place_of_;  ///< its inverse, where the order is kept
  std::span<Face> faces_;         ///< in the scan's order, of these numbers
  std::span<uint8_t> joins_;      ///< of these, where there are polygons
  FaceRows rows_;                 ///< of these, where they have values
  std::vector<io::AttributeRange> ranges_;
  std::optional<FaceValueCoder> values_;
  io::SectionRecord value_record_;  ///< of what values_ coded
};

}  // namespace

EncodedSections EncodeSections(const SectionChoice& choice, const io::MeshSource& source,
                               const PartitionedScan& scan, const io::MappedFile& curve_places,
                               const io::SpillDirectory& spill, uint64_t memory_bytes,
                               parallel::Progress& progress) {
  return SectionEncoder(choice, source, scan, curve_places, spill, memory_bytes, progress).Encode();
}

io::MappedFile SectionFile(const io::SpillDirectory& spill, io::SectionKind kind) {
  return io::MapSpillFile(
      spill.File(std::string(kSectionName) + "." + std::to_string(static_cast<size_t>(kind))));
}

}  // namespace folprom
