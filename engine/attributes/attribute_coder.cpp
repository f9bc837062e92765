#include "engine/attributes/attribute_coder.h"

#include <cmath>

#include "engine/connectivity/area_normal.h"
#include "engine/entropy/bit_coder.h"
#include "engine/entropy/even_code.h"

namespace folprom {
namespace {

constexpr size_t kMostNeighbours = 32;

/// Of the surface at the vertex; length 1, or 0.
Vector3 SurfaceNormal(const NewVertex& added) {
  Vector3 normal = AreaNormal(added.complex, added.positions, added.vertex);
  const double length = std::sqrt(Dot(normal, normal));
  for (double& component : normal) component = length > 0 ? component / length : 0;
  return normal;
}

}  // namespace

AttributeCoder::AttributeCoder(std::span<const ValueSpan> spans)
    : spans_(spans.begin(), spans.end()) {
  for (size_t a = 0; a < spans.size(); ++a) {
    if (spans[a].least < spans[a].most) columns_.push_back({spans[a], a, stride_});
    has_normals_ |= spans[a].normal_axis != 0;
    stride_ += ScalarSize(spans[a].type);
  }
}

template <class Coder>
void AttributeCoder::CodeRoot(Coder& coder, const uint8_t* truth) {
  for (const Column& column : columns_) {
    uint64_t value = column.span.least;
    if constexpr (Coder::kEncoding) value = OrderedOf(column.span, truth + column.offset);
    const uint64_t least = column.span.least;
    ordered_.push_back(least + CodeEvenly(coder, column.span.most - least, value - least,
                                          "coded attribute lies outside its range"));
  }
  ++vertices_;
}

template <class Coder>
void AttributeCoder::CodeNew(Coder& coder, const NewVertex& added, const uint8_t* truth,
                             std::vector<uint64_t>* meters) {
  ++vertices_;
  if (columns_.empty()) return;
  if (models_.empty()) {
    for (const Column& column : columns_) models_.emplace_back(column.span);
  }
  CollectNeighbours(added);
  if (has_normals_) surface_normal_ = SurfaceNormal(added);
  VertexValues before;
  for (size_t c = 0; c < columns_.size(); ++c) {
    const Column& column = columns_[c];
    if (meters != nullptr) coder.SetMeter(&(*meters)[column.attribute]);
    uint64_t value = column.span.least;
    if constexpr (Coder::kEncoding) value = OrderedOf(column.span, truth + column.offset);
    double miss = 0;
    before.rest = RestOfNormal(c, added.vertex);
    value = models_[c].Code(coder, Look(c, added.parent), before, value, &miss);
    ordered_.push_back(value);
    before.misses = {miss, before.misses[0]};
  }
}

void AttributeCoder::CollectNeighbours(const NewVertex& added) {
  ring_.clear();
  const auto add = [&](uint32_t vertex) {
    const Vector3 d = Difference(added.positions[vertex], added.positions[added.vertex]);
    ring_.push_back({vertex, 1 / std::sqrt(1 + Dot(d, d))});
  };
  bool has_parent = false;
  for (const auto& spoke : added.complex.Spokes(added.vertex)) {
    if (ring_.size() == kMostNeighbours) break;
    has_parent |= spoke.target == added.parent;
    add(spoke.target);
  }
  if (!has_parent) add(added.parent);
}

std::optional<double> AttributeCoder::RestOfNormal(size_t column, uint32_t vertex) const {
  // Of a flat sheet nx or ny are the same everywhere and no columns.
  if (columns_[column].span.normal_axis != 3 || column < 2) return std::nullopt;
  const ValueSpan &x = columns_[column - 2].span, &y = columns_[column - 1].span;
  if (x.normal_axis != 1 || y.normal_axis != 2) return std::nullopt;
  const uint64_t* values = &ordered_[vertex * columns_.size()];
  const double nx = RealOf(x, values[column - 2]), ny = RealOf(y, values[column - 1]);
  const double square = 1 - nx * nx - ny * ny;
  return square > 0 ? std::sqrt(square) : 0;
}

RingValues AttributeCoder::Look(size_t column, uint32_t parent) const {
  RingValues values;
  values.parent = Real(parent, column);
  double sum = 0, weights = 0, even = 0, nearest = 0;
  for (const Neighbour& neighbour : ring_) {
    const double value = Real(neighbour.vertex, column);
    sum = sum + neighbour.weight * value;
    weights = weights + neighbour.weight;
    even = even + value;
    if (neighbour.weight > nearest) {
      nearest = neighbour.weight;
      values.nearest = value;
    }
  }
  values.mean = sum / weights;
  values.even = even / static_cast<double>(ring_.size());
  const uint32_t axis = columns_[column].span.normal_axis;
  values.surface = axis == 0 ? values.mean : surface_normal_[axis - 1];
  double spread = 0;
  for (const Neighbour& neighbour : ring_) {
    spread = spread + std::fabs(Real(neighbour.vertex, column) - values.mean);
  }
  values.spread = spread / static_cast<double>(ring_.size());
  return values;
}

std::vector<uint8_t> AttributeCoder::Values() const {
  std::vector<uint8_t> bytes(vertices_ * stride_);
  uint8_t* to = bytes.data();
  for (uint32_t vertex = 0; vertex < vertices_; ++vertex) {
    size_t c = 0;
    for (size_t a = 0; a < spans_.size(); ++a) {
      const bool varies = c < columns_.size() && columns_[c].attribute == a;
      const uint64_t value = varies ? ordered_[vertex * columns_.size() + c++] : spans_[a].least;
      to = StoreOrdered(spans_[a], value, to);
    }
  }
  return bytes;
}

#define FOLPROM_INSTANTIATE(Coder)                                                       \
  template void AttributeCoder::CodeRoot<Coder>(Coder&, const uint8_t*);                 \
  template void AttributeCoder::CodeNew<Coder>(Coder&, const NewVertex&, const uint8_t*, \
                                               std::vector<uint64_t>*);
FOLPROM_INSTANTIATE(BitEncoder)
FOLPROM_INSTANTIATE(BitDecoder)
#undef FOLPROM_INSTANTIATE

}  // namespace folprom
