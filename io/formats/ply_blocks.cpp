#include "io/formats/ply_blocks.h"

#include <algorithm>
#include <string>

#include "io/formats/ply_ascii_cursor.h"
#include "io/formats/ply_binary_cursor.h"
#include "io/formats/ply_skip.h"
#include "io/formats/resident_window.h"

namespace folprom::io {
namespace {

template <class Cursor>
class BlockIndexer {
 public:
  BlockIndexer(const MappedFile& file, const PlyHeader& header, const PlyLayout& layout)
      : file_(file),
        layout_(layout),
        position_{header.data_begin, header.line_count + 1},
        window_(file) {}

  PlyBlocks Index() {
    for (plan_index_ = 0; plan_index_ < layout_.elements.size(); ++plan_index_) {
      const PlyElementPlan& plan = layout_.elements[plan_index_];
      CheckCount(plan);
      Cursor cursor(file_.bytes(), position_, PlyPlace{&file_.path(), plan.element, 0});
      if (plan.role == PlyRole::kFaces || plan.role == PlyRole::kStrips) {
        WalkTriangles(plan, cursor);
      } else {
        WalkRecords(plan, cursor);
      }
      position_ = cursor.position();
    }
    return std::move(blocks_);
  }

 private:
  // Before any step: a count may announce more than any file can hold.
  void CheckCount(const PlyElementPlan& plan) const {
    const uint64_t left = file_.bytes().size() - position_.offset;
    // Text needs a character and a blank for each value; the last blank may be missing.
    const uint64_t most = Cursor::kFixedSizes ? left / plan.smallest_record
                                              : (left + 1) / (2 * plan.element->properties.size());
    if (plan.element->count <= most) return;
    throw Failure(ErrorKind::kInput, file_.path() + ": element " + plan.element->name + ": " +
                                         std::to_string(plan.element->count) +
                                         " records are announced, but the " + std::to_string(left) +
                                         " bytes that are left hold at most " +
                                         std::to_string(most));
  }

  void WalkRecords(const PlyElementPlan& plan, Cursor& cursor) {
    const uint64_t count = plan.element->count;
    for (uint64_t begin = 0; begin < count; begin += kBlockVertices) {
      if (plan.role == PlyRole::kVertices) blocks_.vertices.push_back(cursor.position());
      SkipRecords(plan, cursor, begin, std::min(count - begin, kBlockVertices));
    }
  }

  void SkipRecords(const PlyElementPlan& plan, Cursor& cursor, uint64_t begin, uint64_t count) {
    if constexpr (Cursor::kFixedSizes) {
      if (!plan.has_lists) {
        cursor.Take(count, plan.smallest_record);
        return;
      }
    }
    for (uint64_t record = begin; record < begin + count; ++record) {
      cursor.BeginRecord(record);
      for (const PlyProperty& property : plan.element->properties) SkipProperty(property, cursor);
      cursor.EndRecord();
    }
    DropResident(cursor);
  }

  void WalkTriangles(const PlyElementPlan& plan, Cursor& cursor) {
    const PlyTriangulator triangulator(plan, layout_.vertex_count);
    const std::vector<PlyProperty>& properties = plan.element->properties;
    const PlainTriangles plain = PlainTrianglesOf(plan);
    ListCounts lists(properties.size());
    room_ = 0;
    for (uint64_t record = 0; record < plan.element->count; ++record) {
      if (plain.stride > 0) record += WalkPlainTriangles(plan, plain, cursor, record);
      if (record == plan.element->count) break;
      cursor.BeginRecord(record);
      const FilePosition start = cursor.position();
      uint64_t corners = 0;
      for (size_t i = 0; i < properties.size(); ++i) {
        const PlyProperty& property = properties[i];
        if (i == plan.index_list) {
          corners = WalkIndices(plan, triangulator, cursor, start, record);
        } else if (property.is_list) {
          lists.items[i] = cursor.Count(property.count_type);
          cursor.SkipItems(property.type, lists.items[i]);
        } else {
          cursor.Skip(property.type);
        }
      }
      lists.AddFace(corners);
      cursor.EndRecord();
    }
    if (plan.role == PlyRole::kFaces) blocks_.per_corner = lists.PerCorner();
  }

  /// Are lists as long as a face has corners, or always so many times as long.
  struct ListCounts {
    explicit ListCounts(size_t properties)
        : items(properties, 0), per_corner(properties, 0), is_even(properties, true) {}
    /// A face of less than three corners is no face of the mesh.
    void AddFace(uint64_t corners) {
      for (size_t i = 0; i < items.size() && corners >= 3; ++i) {
        const uint64_t each = items[i] / corners;
        const bool fits = items[i] % corners == 0 && each <= kMostPerCorner;
        is_even[i] = is_even[i] && fits && (!any || each == per_corner[i]);
        per_corner[i] = is_even[i] ? static_cast<uint32_t>(each) : 0;
      }
      any |= corners >= 3;
    }
    std::vector<uint32_t> PerCorner() const { return per_corner; }

    std::vector<uint64_t> items;  ///< of the face at hand, per property
    std::vector<uint32_t> per_corner;
    std::vector<bool> is_even;
    bool any = false;
  };

  /// Binary faces with a count of one byte and no other list: triangles have all the same size.
  struct PlainTriangles {
    uint64_t prefix = 0;  // bytes before the count
    uint64_t stride = 0;  // bytes of a triangle's record; 0 where the faces have another form
  };

  static PlainTriangles PlainTrianglesOf(const PlyElementPlan& plan) {
    const std::vector<PlyProperty>& properties = plan.element->properties;
    const PlyProperty& list = properties[plan.index_list];
    if (!Cursor::kFixedSizes || plan.role != PlyRole::kFaces || ScalarSize(list.count_type) != 1 ||
        std::ranges::count_if(properties, &PlyProperty::is_list) != 1) {
      return {};
    }
    PlainTriangles plain;
    for (size_t i = 0; i < plan.index_list; ++i) plain.prefix += ScalarSize(properties[i].type);
    plain.stride = plan.smallest_record + 3 * ScalarSize(list.type);
    return plain;
  }

  /// Steps over the triangles from `record` on; their number.
  uint64_t WalkPlainTriangles(const PlyElementPlan& plan, const PlainTriangles& plain,
                              Cursor& cursor, uint64_t record) {
    uint64_t total = 0;
    if constexpr (Cursor::kFixedSizes) {
      while (record + total < plan.element->count) {
        const FilePosition start = cursor.position();
        const uint64_t most =
            std::min(plan.element->count - record - total, room_ > 0 ? room_ : kBlockTriangles);
        const uint64_t count = cursor.SkipTriangles(plain.prefix, plain.stride, most);
        if (count == 0) break;
        AddTriangles(count, {plan_index_, start, record + total, 0, {}, 0}, cursor);
        total += count;
      }
    }
    return total;
  }

  /// Returns the number of indices.
  uint64_t WalkIndices(const PlyElementPlan& plan, const PlyTriangulator& triangulator,
                       Cursor& cursor, FilePosition start, uint64_t record) {
    const PlyProperty& list = plan.element->properties[plan.index_list];
    const uint64_t count = cursor.Count(list.count_type);
    if (plan.role == PlyRole::kStrips) {
      WalkLongList(plan, count, triangulator, cursor, record);
      return count;
    }
    if (count < 3) {
      ++blocks_.notes.polygons_dropped;
    } else if (count > 3) {
      ++blocks_.notes.polygons_triangulated;
    }
    if (count > kBlockTriangles + 2) {
      blocks_.cuts_faces = true;
      WalkLongList(plan, count, triangulator, cursor, record);
      return count;
    }
    cursor.SkipItems(list.type, count);
    if (count >= 3) AddTriangles(count - 2, {plan_index_, start, record, 0, {}, 0}, cursor);
    return count;
  }

  /// A list whose triangles are counted one by one, so that blocks can begin inside of it.
  void WalkLongList(const PlyElementPlan& plan, uint64_t count, const PlyTriangulator& triangulator,
                    Cursor& cursor, uint64_t record) {
    const ScalarType type = plan.element->properties[plan.index_list].type;
    PlyListState state;
    Triangle triangle;
    for (uint64_t left = count; left > 0; --left) {
      const PlyTriangleBlock here{plan_index_, cursor.position(), record, left, state, 0};
      const int64_t index = cursor.Integer(type);
      if (triangulator.Push(index, cursor.place(), state, triangle)) AddTriangles(1, here, cursor);
      if (plan.role == PlyRole::kStrips && state.seen == 3) ++blocks_.notes.strips;
    }
  }

  /// Counts triangles that begin at `here`, which begins a block where they do not fit in the last.
  void AddTriangles(uint64_t count, const PlyTriangleBlock& here, const Cursor& cursor) {
    if (count > room_) {
      blocks_.triangles.push_back(here);
      room_ = kBlockTriangles;
      DropResident(cursor);
    }
    room_ -= count;
    blocks_.triangles.back().triangles += count;
    blocks_.triangle_count += count;
  }

  void DropResident(const Cursor& cursor) { window_.Advance(cursor.position().offset); }

  const MappedFile& file_;
  const PlyLayout& layout_;
  FilePosition position_;
  size_t plan_index_ = 0;
  uint64_t room_ = 0;  // triangles that the last block can still take
  ResidentWindow window_;
  PlyBlocks blocks_;
};

}  // namespace

PlyBlocks IndexPlyBlocks(const MappedFile& file, const PlyHeader& header, const PlyLayout& layout) {
  switch (header.format) {
    case PlyFormat::kAscii:
      return BlockIndexer<PlyAsciiCursor>(file, header, layout).Index();
    case PlyFormat::kBinaryLittleEndian:
      return BlockIndexer<PlyBinaryCursor<false>>(file, header, layout).Index();
    case PlyFormat::kBinaryBigEndian:
      break;
  }
  return BlockIndexer<PlyBinaryCursor<true>>(file, header, layout).Index();
}

}  // namespace folprom::io
