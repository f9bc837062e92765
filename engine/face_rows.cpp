#include "engine/face_rows.h"

#include <algorithm>

#include "engine/attributes/value.h"

namespace folprom {

void AddToRanges(const io::FaceSchema& schema, std::span<const uint8_t> rows,
                 std::vector<io::AttributeRange>* ranges) {
  if (ranges->empty()) ranges->assign(schema.Columns(), {~uint64_t{0}, 0});
  const size_t row_bytes = schema.RowBytes(), corner_bytes = schema.CornerBytes();
  size_t column = 0, of_face = 0, of_corner = schema.FaceBytes();
  const auto widen = [&](ScalarType type, size_t at, io::AttributeRange* range) {
    for (; at < rows.size(); at += row_bytes) {
      const uint64_t value = OrderedOf(type, &rows[at]);
      range->least = std::min(range->least, value);
      range->most = std::max(range->most, value);
    }
  };
  for (const io::FaceAttribute& attribute : schema.attributes) {
    for (size_t i = 0; i < attribute.columns(); ++i) {
      io::AttributeRange* range = &(*ranges)[column++];
      const size_t size = ScalarSize(attribute.type);
      if (attribute.per_corner == 0) {
        widen(attribute.type, of_face, range);
        of_face += size;
        continue;
      }
      for (size_t corner = 0; corner < 3; ++corner) {
        widen(attribute.type, of_corner + corner * corner_bytes, range);
      }
      of_corner += size;
    }
  }
}

std::vector<uint8_t> FaceRows::OfNumbers(const PolygonTruth& truth, uint32_t begin,
                                         uint32_t count) const {
  std::vector<uint8_t> rows;
  rows.reserve(count * row_bytes());
  const auto add = [&](std::span<const uint8_t> values) {
    rows.insert(rows.end(), values.begin(), values.end());
  };
  for (uint32_t number = begin; number < begin + count; ++number) {
    const uint32_t triangle = truth.TriangleOf(number);
    Face face = faces_[triangle];
    const uint32_t turns = TurnToSmallest(&face);
    add(FaceOf(triangle));
    for (size_t i = 0; i < 3; ++i) add(CornerOf(triangle, (i + turns) % 3));
  }
  return rows;
}

std::vector<uint8_t> FaceRows::OfPolygons(std::span<const Face> triangles,
                                          std::span<const uint8_t> joins,
                                          std::span<const PolygonTruth::Fan> fans) const {
  std::vector<uint8_t> rows;
  rows.reserve(triangles.size() * row_bytes());
  const auto add = [&](std::span<const uint8_t> values) {
    rows.insert(rows.end(), values.begin(), values.end());
  };
  size_t fan = 0;
  for (size_t begin = 0, end = 1; begin < triangles.size(); begin = end++) {
    while (end < triangles.size() && joins[end] != 0) ++end;
    const uint32_t first = fans[fan++].first;
    const size_t corners = end - begin + 2;
    const size_t turn = TurnOf(triangles.subspan(begin, end - begin), first);
    const auto add_corner = [&](size_t i) {
      const size_t corner = (i + turn) % corners;
      add(corner < 2 ? CornerOf(first, corner) : CornerOf(first + corner - 2, 2));
    };
    for (size_t i = 2; i < corners; ++i) {
      add(FaceOf(first));
      add_corner(0);
      add_corner(i - 1);
      add_corner(i);
    }
  }
  return rows;
}

size_t FaceRows::TurnOf(std::span<const Face> triangles, size_t first) const {
  const auto corner_of = [](const auto& faces, size_t begin, size_t i) {
    return i < 2 ? faces[begin][i] : faces[begin + i - 2][2];
  };
  const size_t corners = triangles.size() + 2;
  for (size_t turn = 0;; ++turn) {
    size_t i = 0;
    while (i < corners &&
           corner_of(triangles, 0, i) == corner_of(faces_, first, (turn + i) % corners)) {
      ++i;
    }
    if (i == corners || turn + 1 == corners) return turn;
  }
}

}  // namespace folprom
