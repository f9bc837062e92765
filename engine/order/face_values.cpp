#include "engine/order/face_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/attributes/value.h"
#include "engine/entropy/bit_coder.h"

namespace folprom {
namespace {

constexpr uint32_t kMostFaces = 24;  // of a vertex that are looked at
constexpr uint32_t kHistory = 8;     // values of Column::history

double Mean(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum = sum + value;
  return sum / static_cast<double>(values.size());
}

/// Mean distance from the mean.
double Spread(std::span<const double> values) {
  const double mean = Mean(values);
  double sum = 0;
  for (const double value : values) sum = sum + std::fabs(value - mean);
  return sum / static_cast<double>(values.size());
}

}  // namespace

FaceValueCoder::FaceValueCoder(const OrderMesh& mesh, const io::FaceSchema& schema,
                               std::span<const io::AttributeRange> ranges, WorkSpace& space)
    : mesh_(mesh), space_(space), vertex_bytes_(VertexBytes(schema)) {
  AddColumns(schema, ranges, false, &face_);
  AddColumns(schema, ranges, true, &corner_);
  const auto words = space.Words((mesh.positions.size() * vertex_bytes_ + 3) / 4);
  kept_ = {reinterpret_cast<uint8_t*>(words.data()), words.size() * sizeof(uint32_t)};
  last_face_.resize(face_.bytes);
  last_corners_.resize(3 * corner_.bytes);
}

size_t FaceValueCoder::VertexBytes(const io::FaceSchema& schema) {
  return 1 + schema.FaceBytes() + kKept * schema.CornerBytes();
}

void FaceValueCoder::AddColumns(const io::FaceSchema& schema,
                                std::span<const io::AttributeRange> ranges, bool of_corner,
                                Group* group) {
  size_t number = 0;
  for (const io::FaceAttribute& attribute : schema.attributes) {
    for (size_t i = 0; i < attribute.columns(); ++i) {
      const io::AttributeRange& range = ranges[number++];
      if ((attribute.per_corner > 0) != of_corner) continue;
      const ValueSpan span{attribute.type, range.least, range.most};
      if (range.least < range.most) {
        const MixedModel<2> is_guess(
            {kGuessContexts * kOutcomes * kOutcomes * kGuesses, kHistory * kOutcomes * kGuesses},
            kGuesses);
        group->columns.push_back({span, group->bytes, 0, is_guess, AttributeModel(span)});
      }
      group->bytes += ScalarSize(attribute.type);
      group->constant.resize(group->bytes);
      StoreOrdered(span.type, span.least, &group->constant[group->bytes - ScalarSize(span.type)]);
    }
  }
}

void FaceValueCoder::Remember(const Face& triangle, const uint8_t* values) {
  for (const uint32_t vertex : triangle) {
    std::copy_n(values, face_.bytes, FaceAt(vertex));
    KeptAt(vertex)[0] |= 1;
  }
  std::copy_n(values, face_.bytes, last_face_.begin());
  has_last_ = true;
}

void FaceValueCoder::RememberCorner(uint32_t vertex, const uint8_t* values) {
  const size_t there = CornersAt(vertex);
  uint8_t* const first = CornerAt(vertex, 0);
  if (there > 0 && std::equal(values, values + corner_.bytes, first)) return;
  if (there < kKept) KeptAt(vertex)[0] = static_cast<uint8_t>(KeptAt(vertex)[0] + 2);
  std::copy_n(first, corner_.bytes, CornerAt(vertex, 1));
  std::copy_n(values, corner_.bytes, first);
}

/// The values that the faces at the three vertices had last, and that of the last face; the most
/// frequent first.
FaceValueCoder::Guesses FaceValueCoder::GuessFace(const Column& column, const Face& triangle) {
  const ScalarType type = column.span.type;
  std::array<uint64_t, 4> values{};
  std::array<uint32_t, 4> votes{};
  std::array<double, 4> reals{};
  size_t count = 0, seen = 0;
  const auto add = [&](const uint8_t* from) {
    const uint64_t value = OrderedOf(type, from + column.offset);
    reals[seen++] = RealOf(type, value);
    const auto equal = static_cast<size_t>(
        std::find(values.begin(), values.begin() + static_cast<ptrdiff_t>(count), value) -
        values.begin());
    values[equal] = value;
    ++votes[equal];
    count = std::max(count, equal + 1);
  };
  for (const uint32_t vertex : triangle) {
    if (HasFace(vertex)) add(FaceAt(vertex));
  }
  if (has_last_) add(last_face_.data());
  Guesses guesses;
  guesses.ring.mean = guesses.ring.nearest = guesses.ring.parent = RealOf(type, column.span.least);
  if (seen > 0) {
    const auto known = std::span(reals).first(seen);
    guesses.ring.mean = Mean(known);
    guesses.ring.nearest = known.back();
    guesses.ring.parent = known.front();
    guesses.ring.spread = Spread(known);
  }
  guesses.ring.even = guesses.ring.surface = guesses.ring.mean;
  guesses.count = static_cast<uint32_t>(std::min<size_t>(count, kGuesses));
  for (uint32_t rank = 0; rank < guesses.count; ++rank) {
    const auto best = static_cast<size_t>(std::ranges::max_element(votes) - votes.begin());
    if (rank == 0) guesses.context = static_cast<uint32_t>(count) * 5 + votes[best];
    guesses.values[rank] = values[best];
    votes[best] = 0;
  }
  return guesses;
}

uint32_t FaceValueCoder::VertexAcross(uint32_t a, uint32_t b, uint32_t third) {
  for (const uint32_t number : mesh_.Star(a, kMostFaces)) {
    const Face& face = mesh_.faces[number];
    if (std::ranges::count(face, b) == 0) continue;
    for (const uint32_t vertex : face) {
      if (vertex != a && vertex != b && vertex != third && CornersAt(vertex) > 0) return vertex;
    }
  }
  return kNoNumber;
}

/// known: a bit for each corner of the triangle whose values are there already.
FaceValueCoder::Guesses FaceValueCoder::GuessCorner(const Column& column, const Face& triangle,
                                                    size_t corner, const uint8_t* corners,
                                                    uint32_t known, bool is_joined) {
  const ScalarType type = column.span.type;
  const auto at = [&](const uint8_t* from) { return OrderedOf(type, from + column.offset); };
  const uint32_t vertex = triangle[corner];
  const size_t there = CornersAt(vertex);
  Guesses guesses;
  const auto add = [&](uint64_t value) {
    const auto begin = guesses.values.begin(), end = begin + guesses.count;
    if (guesses.count < kGuesses && std::find(begin, end, value) == end) {
      guesses.values[guesses.count++] = value;
    }
  };
  for (size_t i = 0; i < there; ++i) add(at(CornerAt(vertex, i)));
  std::array<double, 3> reals{};
  size_t seen = 0;
  std::array<uint32_t, 3> vertices{};
  for (size_t i = 3; i-- > 0;) {
    if ((known >> i & 1) == 0) continue;
    const uint64_t value = at(corners + i * corner_.bytes);
    add(value);
    vertices[seen] = triangle[i];
    reals[seen++] = RealOf(type, value);
  }
  guesses.context =
      (static_cast<uint32_t>(there) * 3 + static_cast<uint32_t>(seen)) * 2 + (is_joined ? 1 : 0);
  RingValues& ring = guesses.ring;
  ring.nearest = RealOf(type, guesses.count > 0 ? guesses.values[0] : at(last_corners_.data()));
  ring.mean = ring.even = ring.parent = ring.nearest;
  if (seen > 0) {
    ring.even = ring.mean = Mean(std::span(reals).first(seen));
    ring.nearest = reals[0];
    ring.spread = Spread(std::span(reals).first(seen));
  }
  if (seen == 2) {
    // Beyond the edge lies a triangle, or the part of this polygon before it.
    const uint32_t across = is_joined ? kNoNumber : VertexAcross(vertices[0], vertices[1], vertex);
    if (is_joined) {
      ring.mean = reals[0] + reals[1] - RealOf(type, at(&last_corners_[corner_.bytes]));
    } else if (across != kNoNumber) {
      ring.mean = reals[0] + reals[1] - RealOf(type, at(CornerAt(across, 0)));
    }
    ring.mean = std::clamp(ring.mean, -1e300, 1e300);
  }
  ring.surface = ring.mean;
  return guesses;
}

template <class Coder>
uint64_t FaceValueCoder::CodeValue(Coder& coder, Column& column, const Guesses& guesses,
                                   Outcome before, Outcome first, uint64_t value,
                                   VertexValues* misses, Outcome* outcome) {
  for (uint32_t i = 0; i < guesses.count; ++i) {
    const uint32_t of_guess = (guesses.context * kOutcomes + before) * kOutcomes + first;
    const uint32_t of_history = column.history * kOutcomes + before;
    if (!column.is_guess.Code(coder, {of_guess * kGuesses + i, of_history * kGuesses + i}, i,
                              value == guesses.values[i])) {
      continue;
    }
    *outcome = static_cast<Outcome>(i);
    column.history = (column.history << 1 | (i == 0 ? 1 : 0)) % kHistory;
    misses->misses = {0, misses->misses[0]};
    return guesses.values[i];
  }
  *outcome = kOther;
  column.history = (column.history << 1) % kHistory;
  double miss = 0;
  value = column.other.Code(coder, guesses.ring, *misses, value, &miss);
  misses->misses = {miss, misses->misses[0]};
  return value;
}

template <class Coder, class Guess>
void FaceValueCoder::CodeGroup(Coder& coder, Group& group, Guess guess, uint8_t* values,
                               Outcome* first) {
  coded_ = group.constant;
  Outcome before = kNotCoded;
  VertexValues misses;
  const Outcome first_before = *first;
  for (Column& column : group.columns) {
    uint64_t value = column.span.least;
    if constexpr (Coder::kEncoding) value = OrderedOf(column.span.type, values + column.offset);
    Outcome outcome = kNotCoded;
    value = CodeValue(coder, column, guess(column), before, first_before, value, &misses, &outcome);
    StoreOrdered(column.span.type, value, &coded_[column.offset]);
    if (before == kNotCoded) *first = outcome;
    before = outcome;
  }
  std::ranges::copy(coded_, values);
}

template <class Coder>
void FaceValueCoder::CodeCorner(Coder& coder, const Face& triangle, size_t corner, uint32_t known,
                                bool is_joined, uint8_t* corners) {
  uint8_t* const values = corners + corner * corner_.bytes;
  CodeGroup(
      coder, corner_,
      [&](const Column& column) {
        return GuessCorner(column, triangle, corner, corners, known, is_joined);
      },
      values, &corner_before_);
  RememberCorner(triangle[corner], values);
}

template <class Coder>
void FaceValueCoder::Code(Coder& coder, std::span<const Face> triangles,
                          std::span<const uint8_t> joins, std::span<uint8_t> rows) {
  const size_t row_bytes = face_.bytes + 3 * corner_.bytes;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const Face& triangle = triangles[i];
    space_.Stepped(1);
    uint8_t* const row = &rows[i * row_bytes];
    uint8_t* const corners = row + face_.bytes;
    const bool is_joined = has_last_ && !joins.empty() && joins[i] != 0;
    if (is_joined) {
      // A truth has the same there.
      std::ranges::copy(last_face_, row);
      std::copy_n(last_corners_.data(), corner_.bytes, corners);
      std::copy_n(last_corners_.data() + 2 * corner_.bytes, corner_.bytes, corners + corner_.bytes);
    } else {
      Outcome none = kNotCoded;
      CodeGroup(
          coder, face_, [&](const Column& column) { return GuessFace(column, triangle); }, row,
          &none);
    }
    Remember(triangle, row);
    if (corner_.bytes == 0) continue;
    uint32_t known = is_joined ? 3 : 0;
    // What is known already helps with what is not. A vertex may be at two corners.
    std::array<bool, 3> keeps{};
    for (size_t corner = 0; corner < 3; ++corner) keeps[corner] = CornersAt(triangle[corner]) > 0;
    for (const bool has_values : {true, false}) {
      for (size_t corner = 0; corner < 3; ++corner) {
        if ((known >> corner & 1) != 0 || keeps[corner] != has_values) continue;
        CodeCorner(coder, triangle, corner, known, is_joined, corners);
        known |= uint32_t{1} << corner;
      }
    }
    std::copy_n(corners, 3 * corner_.bytes, last_corners_.begin());
  }
}

template void FaceValueCoder::Code(BitEncoder&, std::span<const Face>, std::span<const uint8_t>,
                                   std::span<uint8_t>);
template void FaceValueCoder::Code(BitDecoder&, std::span<const Face>, std::span<const uint8_t>,
                                   std::span<uint8_t>);

}  // namespace folprom
