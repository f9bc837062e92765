#include "io/formats/ply_source.h"

#include <algorithm>
#include <utility>

#include "io/formats/ply_ascii_cursor.h"
#include "io/formats/ply_binary_cursor.h"
#include "io/formats/ply_blocks.h"
#include "io/formats/ply_face_rows.h"
#include "io/formats/ply_header.h"
#include "io/formats/ply_layout.h"
#include "io/formats/ply_skip.h"
#include "io/formats/ply_triangles.h"
#include "io/formats/ply_value.h"
#include "io/result_of.h"

namespace folprom::io {
namespace {

constexpr uint8_t kNotCoordinate = 3;

template <class Cursor>
void ReadVertices(Cursor& cursor, const PlyElementPlan& plan, uint64_t begin, uint64_t count,
                  double* xyz) {
  const std::vector<PlyProperty>& properties = plan.element->properties;
  std::vector<uint8_t> axes(properties.size(), kNotCoordinate);
  for (uint8_t axis = 0; axis < 3; ++axis) axes[plan.coordinates[axis]] = axis;

  for (uint64_t i = 0; i < count; ++i, xyz += 3) {
    cursor.BeginRecord(begin + i);
    for (size_t p = 0; p < properties.size(); ++p) {
      const PlyProperty& property = properties[p];
      if (axes[p] != kNotCoordinate) {
        xyz[axes[p]] = cursor.Real(property.type);
      } else {
        SkipProperty(property, cursor);
      }
    }
    cursor.EndRecord();
  }
}

/// Records of one size: a coordinate at a time, with the type known outside of the loop.
template <bool kBigEndian>
void ReadFixedVertices(const uint8_t* records, const PlyElementPlan& plan, uint64_t count,
                       double* xyz) {
  const std::vector<PlyProperty>& properties = plan.element->properties;
  for (size_t axis = 0; axis < 3; ++axis) {
    const uint8_t* value = records;
    for (size_t p = 0; p < plan.coordinates[axis]; ++p) value += ScalarSize(properties[p].type);
    WithScalarType(properties[plan.coordinates[axis]].type, [&]<class T>(T) {
      for (uint64_t i = 0; i < count; ++i) {
        xyz[3 * i + axis] = ToDouble(Load<T, kBigEndian>(value + i * plan.smallest_record));
      }
    });
  }
}

template <class Cursor>
void ReadAttributes(Cursor& cursor, const PlyElementPlan& plan, uint64_t begin, uint64_t count,
                    uint8_t* values) {
  const std::vector<PlyProperty>& properties = plan.element->properties;
  std::vector<bool> kept(properties.size(), false);
  for (const size_t p : plan.attributes) kept[p] = true;

  for (uint64_t i = 0; i < count; ++i) {
    cursor.BeginRecord(begin + i);
    for (size_t p = 0; p < properties.size(); ++p) {
      const PlyProperty& property = properties[p];
      if (kept[p]) {
        values = ReadValue(cursor, property.type, values);
      } else {
        SkipProperty(property, cursor);
      }
    }
    cursor.EndRecord();
  }
}

template <class Cursor>
class TriangleReader {
 public:
  TriangleReader(Cursor& cursor, const PlyElementPlan& plan, const PlyTriangleBlock& block,
                 uint64_t vertex_count, std::vector<Triangle>* out, std::vector<uint8_t>* joins)
      : cursor_(cursor),
        plan_(plan),
        block_(block),
        triangulator_(plan, vertex_count),
        list_(plan.element->properties[plan.index_list]),
        out_(*out),
        joins_(joins) {}

  void Read() {
    out_.clear();
    out_.reserve(block_.triangles);
    uint64_t record = block_.record;
    if (block_.items_left > 0) {
      ReadItems(block_.items_left, block_.state);
      if (Done()) return;
      FinishRecord();
      ++record;
    }
    for (; !Done(); ++record) {
      cursor_.BeginRecord(record);
      SkipProperties(0, plan_.index_list);
      ReadList(cursor_.Count(list_.count_type));
      if (Done()) return;
      FinishRecord();
    }
  }

 private:
  bool Done() const { return out_.size() >= block_.triangles; }

  void SkipProperties(size_t begin, size_t end) {
    for (; begin < end; ++begin) SkipProperty(plan_.element->properties[begin], cursor_);
  }

  void FinishRecord() {
    SkipProperties(plan_.index_list + 1, plan_.element->properties.size());
    cursor_.EndRecord();
  }

  void ReadList(uint64_t count) {
    if (plan_.role == PlyRole::kStrips) {
      ReadItems(count, {});
    } else if (count == 3) {
      cursor_.ThreeIntegers(list_.type, [this](int64_t a, int64_t b, int64_t c) {
        const PlyPlace& place = cursor_.place();
        out_.push_back({triangulator_.Vertex(a, place), triangulator_.Vertex(b, place),
                        triangulator_.Vertex(c, place)});
        AddJoin(false);
      });
    } else if (count < 3) {
      cursor_.SkipItems(list_.type, count);
    } else {
      ReadItems(count, {});
    }
  }

  void ReadItems(uint64_t count, PlyListState state) {
    Triangle triangle;
    for (; count > 0 && !Done(); --count) {
      const int64_t index = cursor_.Integer(list_.type);
      if (!triangulator_.Push(index, cursor_.place(), state, triangle)) continue;
      out_.push_back(triangle);
      AddJoin(plan_.role == PlyRole::kFaces && state.seen > 3);
    }
  }

  void AddJoin(bool is_joined) {
    if (joins_ != nullptr) joins_->push_back(is_joined ? 1 : 0);
  }

  Cursor& cursor_;
  const PlyElementPlan& plan_;
  const PlyTriangleBlock& block_;
  const PlyTriangulator triangulator_;
  const PlyProperty& list_;
  std::vector<Triangle>& out_;
  std::vector<uint8_t>* joins_;  ///< may be null
};

class PlySource final : public MeshSource {
 public:
  PlySource(MappedFile file, const Limits& limits)
      : file_(std::move(file)),
        header_(ParsePlyHeader(file_.bytes(), file_.path(), limits)),
        layout_(PlanPlyLayout(header_, file_.path())),
        blocks_(IndexPlyBlocks(file_, header_, layout_)) {
    const bool has_strips =
        std::ranges::count(layout_.elements, PlyRole::kStrips, &PlyElementPlan::role) > 0;
    for (PlyElementPlan& plan : layout_.elements) {
      if (plan.role == PlyRole::kVertices) vertices_ = plan;
      if (plan.role == PlyRole::kFaces) {
        PlanFaceAttributes(blocks_.per_corner, !has_strips && !blocks_.cuts_faces, plan, layout_);
      }
    }
    blocks_.notes.ignored_properties = std::move(layout_.ignored_properties);
    blocks_.notes.remarks_dropped = header_.remarks_dropped;
  }

  const std::string& path() const override { return file_.path(); }
  uint64_t vertex_count() const override { return layout_.vertex_count; }
  uint64_t triangle_count() const override { return blocks_.triangle_count; }
  ScalarType coordinate_type() const override { return layout_.coordinate_type; }
  const SourceNotes& notes() const override { return blocks_.notes; }
  Result<void> CheckUnchanged() const override {
    return ResultOf([&] { file_.CheckUnchanged(); });
  }
  void DropResident() const override { file_.DropResident(); }

  size_t vertex_block_count() const override { return blocks_.vertices.size(); }
  uint64_t vertex_block_begin(size_t block) const override {
    return std::min<uint64_t>(block * kBlockVertices, layout_.vertex_count);
  }

  Result<void> ReadVertexBlock(size_t block, std::vector<double>* xyz) const override {
    const uint64_t begin = vertex_block_begin(block);
    const uint64_t count = vertex_block_begin(block + 1) - begin;
    xyz->resize(3 * count);
    return WithCursor(vertices_, blocks_.vertices[block], [&]<class Cursor>(Cursor& cursor) {
      if constexpr (Cursor::kFixedSizes) {
        if (!vertices_.has_lists) {
          ReadFixedVertices<Cursor::kIsBigEndian>(cursor.Take(count, vertices_.smallest_record),
                                                  vertices_, count, xyz->data());
          return;
        }
      }
      ReadVertices(cursor, vertices_, begin, count, xyz->data());
    });
  }

  const VertexSchema& vertex_schema() const override { return layout_.schema; }
  const std::vector<std::string>& remarks() const override { return header_.remarks; }

  Result<void> ReadVertexAttributes(size_t block, std::vector<uint8_t>* values) const override {
    const uint64_t begin = vertex_block_begin(block);
    const uint64_t count = vertex_block_begin(block + 1) - begin;
    values->resize(layout_.schema.Stride() * count);
    if (values->empty()) return {};
    return WithCursor(vertices_, blocks_.vertices[block], [&]<class Cursor>(Cursor& cursor) {
      ReadAttributes(cursor, vertices_, begin, count, values->data());
    });
  }

  size_t triangle_block_count() const override { return blocks_.triangles.size(); }

  const FaceSchema& face_schema() const override { return layout_.face_schema; }
  Result<void> ReadFaceAttributes(size_t block, std::vector<uint8_t>* rows) const override {
    rows->clear();
    if (layout_.face_schema.empty()) return {};
    const PlyTriangleBlock& where = blocks_.triangles[block];
    const PlyElementPlan& plan = layout_.elements[where.plan];
    return WithCursor(plan, where.position, [&]<class Cursor>(Cursor& cursor) {
      PlyFaceRows<Cursor>(cursor, plan, layout_.face_schema)
          .Read(where.record, where.triangles, rows);
    });
  }

 private:
  Result<void> ReadFaces(size_t block, std::vector<Triangle>* triangles,
                         std::vector<uint8_t>* joins) const override {
    const PlyTriangleBlock& where = blocks_.triangles[block];
    const PlyElementPlan& plan = layout_.elements[where.plan];
    return WithCursor(plan, where.position, [&]<class Cursor>(Cursor& cursor) {
      TriangleReader<Cursor>(cursor, plan, where, layout_.vertex_count, triangles, joins).Read();
    });
  }

  template <class Work>
  Result<void> WithCursor(const PlyElementPlan& plan, FilePosition position, Work work) const {
    return ResultOf([&] {
      const PlyPlace place{&file_.path(), plan.element, 0};
      if (header_.format == PlyFormat::kAscii) {
        PlyAsciiCursor cursor(file_.bytes(), position, place);
        work(cursor);
      } else if (header_.format == PlyFormat::kBinaryLittleEndian) {
        PlyBinaryCursor<false> cursor(file_.bytes(), position, place);
        work(cursor);
      } else {
        PlyBinaryCursor<true> cursor(file_.bytes(), position, place);
        work(cursor);
      }
    });
  }

  MappedFile file_;
  PlyHeader header_;
  PlyLayout layout_;  // points into header_
  PlyBlocks blocks_;
  PlyElementPlan vertices_;
};

}  // namespace

std::unique_ptr<MeshSource> OpenPlySource(MappedFile file, const Limits& limits) {
  return std::make_unique<PlySource>(std::move(file), limits);
}

}  // namespace folprom::io
