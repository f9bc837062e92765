#include "engine/rounded_source.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/attribute_bits.h"
#include "engine/attributes/value_model.h"
#include "io/formats/derived_source.h"

namespace folprom {
namespace {

/// Answers as the scan but for the rounded attributes.
class RoundedMeshSource final : public io::DerivedSource {
 public:
  RoundedMeshSource(std::unique_ptr<io::MeshSource> scan, std::vector<io::AttributeRange> ranges)
      : DerivedSource(std::move(scan)) {
    size_t offset = 0;
    for (size_t a = 0; a < ranges.size(); ++a) {
      const ScalarType type = vertex_schema().attributes[a].type;
      const io::AttributeRange& range = ranges[a];
      if (range.step > 0) {
        columns_.push_back({{type, range.least, range.most, 0, range.step, range.first}, offset});
      }
      offset += ScalarSize(type);
    }
  }

  Result<void> ReadVertexAttributes(size_t block, std::vector<uint8_t>* values) const override {
    Result<void> read = DerivedSource::ReadVertexAttributes(block, values);
    const size_t stride = vertex_schema().Stride();
    for (const Column& column : columns_) {
      for (size_t at = column.offset; at < values->size(); at += stride) {
        uint8_t* const value = &(*values)[at];
        StoreOrdered(column.span, OrderedOf(column.span, value), value);
      }
    }
    return read;
  }

 private:
  struct Column {
    ValueSpan span;
    size_t offset = 0;  ///< of its bytes among those of a vertex
  };
  std::vector<Column> columns_;
};

/// Least and largest value of an attribute, and whether all are finite.
struct RealRange {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  bool is_finite = true;

  void Add(ScalarType type, const uint8_t* bytes) {
    const double value = RealOf(type, OrderedOf(type, bytes));
    const uint64_t bits = BitsFromOrdered(type, OrderedOf(type, bytes));
    is_finite &= type == ScalarType::kFloat32
                     ? std::isfinite(std::bit_cast<float>(static_cast<uint32_t>(bits)))
                     : std::isfinite(std::bit_cast<double>(bits));
    least = std::min(least, value);
    most = std::max(most, value);
  }
};

/// Between the largest values of the range, in size.
double SpacingOf(ScalarType type, const RealRange& range) {
  const double size = std::max(std::fabs(range.least), std::fabs(range.most));
  if (type == ScalarType::kFloat64) return std::nextafter(size, INFINITY) - size;
  const auto near = static_cast<float>(size);
  return static_cast<double>(std::nextafter(near, INFINITY)) - static_cast<double>(near);
}

/// To how many bits each attribute is to be rounded; 0: it is not.
std::vector<uint32_t> BitsOf(const std::vector<io::VertexAttribute>& attributes,
                             const std::vector<std::string>& attribute_bits,
                             std::vector<std::string>* warnings) {
  std::vector<uint32_t> bits(attributes.size(), 0);
  const std::vector<AttributeBits> asked = ParseAttributeBits(attribute_bits).value();
  for (const AttributeBits& one : asked) {
    bool found = false;
    for (size_t a = 0; a < attributes.size(); ++a) {
      if (!one.Names(attributes[a].name) || !IsFloat(attributes[a].type)) continue;
      bits[a] = one.bits;
      found = true;
    }
    if (!found) warnings->push_back("attribute_bits: the vertices have no float " + one.name);
  }
  return bits;
}

/// Of the attributes that have bits.
std::vector<RealRange> MeasureRanges(const io::MeshSource& source,
                                     const std::vector<uint32_t>& bits,
                                     parallel::Progress& progress) {
  const std::vector<io::VertexAttribute>& attributes = source.vertex_schema().attributes;
  std::vector<RealRange> ranges(attributes.size());
  if (std::ranges::all_of(bits, [](uint32_t n) { return n == 0; })) return ranges;
  progress.StartStage("measure attributes", source.vertex_count());
  std::vector<uint8_t> values;
  const size_t stride = source.vertex_schema().Stride();
  for (size_t block = 0; block < source.vertex_block_count(); ++block) {
    progress.ThrowIfCancelled();
    source.ReadVertexAttributes(block, &values).value();
    size_t offset = 0;
    for (size_t a = 0; a < attributes.size(); ++a) {
      for (size_t at = offset; bits[a] > 0 && at < values.size(); at += stride) {
        ranges[a].Add(attributes[a].type, &values[at]);
      }
      offset += ScalarSize(attributes[a].type);
    }
    source.DropResident();
    progress.Advance(values.size() / stride);
  }
  return ranges;
}

/// 2^bits values over a finite range; a step of 0 where finer steps than the type has would be
/// none.
io::AttributeRange EvenValues(ScalarType type, const RealRange& range, uint32_t bits) {
  const uint64_t most = (uint64_t{1} << bits) - 1;
  const double step = (range.most - range.least) / static_cast<double>(most);
  if (!std::isfinite(step) || step < 4 * SpacingOf(type, range)) return {};
  return {0, most, step, range.least};
}

}  // namespace

RoundedSource RoundAttributes(std::unique_ptr<io::MeshSource> source,
                              const std::vector<std::string>& attribute_bits,
                              parallel::Progress& progress) {
  RoundedSource rounded;
  const std::vector<io::VertexAttribute>& attributes = source->vertex_schema().attributes;
  rounded.ranges.resize(attributes.size());
  const std::vector<uint32_t> bits = BitsOf(attributes, attribute_bits, &rounded.warnings);
  const std::vector<RealRange> ranges = MeasureRanges(*source, bits, progress);
  for (size_t a = 0; a < attributes.size(); ++a) {
    if (bits[a] == 0 || source->vertex_count() == 0) continue;
    if (ranges[a].is_finite) {
      rounded.ranges[a] = EvenValues(attributes[a].type, ranges[a], bits[a]);
    } else {
      rounded.warnings.push_back("attribute_bits: " + attributes[a].name +
                                 " has values that are not finite, all are kept bit for bit");
    }
  }
  rounded.source = std::make_unique<RoundedMeshSource>(std::move(source), rounded.ranges);
  return rounded;
}

}  // namespace folprom
