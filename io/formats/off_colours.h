// Colours of an OFF file: each vertex or face has 0, 1, 3 or 4 numbers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/formats/off_header.h"
#include "io/formats/text_cursor.h"
#include "io/formats/text_number.h"
#include "io/formats/vertex_schema.h"

namespace folprom::io {

/// Sees all colours before their type is known: whole numbers of 0 .. 255 are bytes, others floats,
/// or doubles where a float does not hold one.
class ColourCensus {
 public:
  void Add(std::span<const std::string_view> words, const TextCursor& cursor) {
    AddCount(words.size());
    for (const std::string_view word : words) {
      int64_t whole = 0;
      is_bytes_ &= ParseInteger(word, &whole) && whole >= 0 && whole <= 255;
      numbers_.Add(word, cursor);
    }
  }
  /// One of so many numbers, which are floats where nothing else is added.
  void AddCount(uint64_t count) {
    is_even_ &= !has_any_ || count == most_;
    has_any_ = true;
    most_ = std::max(most_, count);
  }
  void SetFloats() { is_bytes_ = false; }

  bool is_even() const { return is_even_; }
  uint64_t most() const { return most_; }
  ScalarType type() const { return is_bytes_ ? ScalarType::kUint8 : numbers_.type(); }

 private:
  CoordinateCensus numbers_;
  bool is_bytes_ = true, is_even_ = true, has_any_ = false;
  uint64_t most_ = 0;
};

/// The attributes of faces with such colours. With two columns or more one that counts them goes
/// first where they are not even.
inline FaceSchema OffFaceSchema(const ColourCensus& colours) {
  FaceSchema schema;
  if (colours.most() == 1 && colours.is_even()) {
    schema.attributes.push_back({std::string(kOffColourIndex), ScalarType::kFloat64});
    return schema;
  }
  if (colours.most() == 0) return schema;
  if (!colours.is_even() || colours.most() == 2) {
    schema.attributes.push_back({std::string(kOffColourCount), ScalarType::kUint8});
  }
  for (size_t i = 0; i < std::max<uint64_t>(colours.most(), 3); ++i) {
    schema.attributes.push_back({std::string(kOffColours[i]), colours.type()});
  }
  return schema;
}

/// Stores the numbers that a vertex or face has in the columns of its schema that begin here, 0 in
/// those that are left; where they go on.
uint8_t* StoreOffValues(std::span<const double> values, ScalarType type, size_t columns,
                        uint8_t* to);

/// The attributes of vertices that the header announces, in the order of the lines; colours where
/// all vertices have as many numbers.
VertexSchema OffVertexSchema(const OffHeader& header, const ColourCensus& colours,
                             ScalarType others);

/// Appends the row of each triangle of a face: FaceSchema.
void AddOffRows(const FaceSchema& schema, std::span<const double> colours, uint64_t triangles,
                std::vector<uint8_t>* rows);

}  // namespace folprom::io
