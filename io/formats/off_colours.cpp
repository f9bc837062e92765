#include "io/formats/off_colours.h"

#include "io/formats/store_bytes.h"

namespace folprom::io {

uint8_t* StoreOffValues(std::span<const double> values, ScalarType type, size_t columns,
                        uint8_t* to) {
  for (size_t i = 0; i < columns; ++i) {
    const double value = i < values.size() ? values[i] : 0;
    to = type == ScalarType::kUint8 ? StoreLittleEndian(static_cast<uint8_t>(value), to)
                                    : StoreReal(type, value, to);
  }
  return to;
}

VertexSchema OffVertexSchema(const OffHeader& header, const ColourCensus& colours,
                             ScalarType others) {
  VertexSchema schema;
  if (header.has_normals) {
    for (const std::string_view name : kOffNormals) {
      schema.attributes.push_back({std::string(name), others});
    }
  }
  for (size_t i = 0; colours.is_even() && i < colours.most(); ++i) {
    schema.attributes.push_back({std::string(kOffColours[i]), colours.type()});
  }
  if (header.has_texture) {
    for (const std::string_view name : kOffTexture) {
      schema.attributes.push_back({std::string(name), others});
    }
  }
  return schema;
}

void AddOffRows(const FaceSchema& schema, std::span<const double> colours, uint64_t triangles,
                std::vector<uint8_t>* rows) {
  for (; triangles > 0; --triangles) {
    const size_t begin = rows->size();
    rows->resize(begin + schema.RowBytes());
    uint8_t* to = rows->data() + begin;
    size_t columns = schema.attributes.size();
    if (schema.attributes[0].name == kOffColourCount) {
      *to++ = static_cast<uint8_t>(colours.size());
      --columns;
    }
    StoreOffValues(colours, schema.attributes.back().type, columns, to);
  }
}

}  // namespace folprom::io
