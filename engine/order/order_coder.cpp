#include "engine/order/order_coder.h"

#include <algorithm>
#include <vector>

#include "engine/entropy/bit_coder.h"
#include "engine/entropy/even_code.h"
#include "io/container/checksum.h"

namespace folprom {
namespace {

/// Steps after which the space may let memory go.
constexpr uint32_t kStep = 64;

template <class T>
uint64_t HashOf(const T& values) {
  return io::XxHash64({reinterpret_cast<const uint8_t*>(values.data()), sizeof values});
}

template <class Coder>
uint32_t CodeSweep(Coder& coder, uint32_t codes, uint32_t code) {
  return static_cast<uint32_t>(
      CodeEvenly(coder, codes - 1, code, "coded order goes along no known sweep"));
}

}  // namespace

// Hashed as little-endian numbers; no other machine is built for.
uint64_t OrderDigest(uint64_t place, const Int3& position) {
  const auto word = [](int32_t value) {
    return static_cast<uint64_t>(static_cast<uint32_t>(value));
  };
  return HashOf(
      std::array<uint64_t, 4>{place, word(position.x), word(position.y), word(position.z)});
}

uint64_t OrderDigest(uint64_t place, const Face& corners) {
  return HashOf(std::array<uint64_t, 4>{place, corners[0], corners[1], corners[2]});
}

void OrderCoder::DigestVertices(uint32_t begin, uint32_t end) {
  for (uint32_t place = begin; place < end; ++place) {
    digest_ += OrderDigest(place, mesh_.positions[sequence_[place]]);
  }
}

void OrderCoder::DigestFaces(std::span<const Face> faces) {
  uint64_t number = faces_done_;
  for (Face face : faces) {
    for (uint32_t& corner : face) corner = is_soup_ ? corner : place_of_[corner];
    digest_ += OrderDigest(number++, face);
  }
}

template <class Coder>
void OrderCoder::CodeVertices(Coder& coder) {
  if (!vertices_) {
    SweepMaker maker(mesh_, space_);
    uint32_t code = 0;
    if constexpr (Coder::kEncoding) {
      code = ChooseSweep(maker, mesh_.vertex_count(), sequence_.first(NextVertices()));
    }
    code = CodeSweep(coder, SweepMaker::kVertexCodes, code);
    vertices_.emplace(mesh_, maker.Make(code), sequence_, place_of_);
  }
  for (uint32_t left = NextVertices(); left > 0;) {
    const uint32_t count = std::min(left, kStep);
    vertices_->Code(coder, count);
    space_.Stepped(count);
    DigestVertices(vertices_done_, vertices_done_ + count);
    vertices_done_ += count;
    left -= count;
  }
  if (vertices_done_ == mesh_.vertex_count()) vertices_.reset();
}

template <class Coder>
void OrderCoder::CodeFaces(Coder& coder, std::span<Face> faces) {
  if (!faces_) {
    SweepMaker maker(mesh_, place_of_, is_soup_, space_);
    uint32_t code = 0;
    if constexpr (Coder::kEncoding)
      code = ChooseSweep(maker, mesh_.face_count(), mesh_.Numbers(faces));
    code = CodeSweep(coder, maker.codes(), code);
    for (uint32_t v = 0; is_soup_ && v < mesh_.vertex_count(); ++v) {
      place_of_[v] = kNoNumber;
      space_.Stepped(1);
    }
    faces_.emplace(mesh_, maker.Make(code), sequence_, place_of_, is_soup_);
  }
  for (size_t begin = 0; begin < faces.size(); begin += kStep) {
    const auto some = faces.subspan(begin, std::min<size_t>(kStep, faces.size() - begin));
    faces_->Code(coder, some);
    space_.Stepped(some.size());
    DigestFaces(some);
    faces_done_ += static_cast<uint32_t>(some.size());
  }
}

template void OrderCoder::CodeVertices(BitEncoder&);
template void OrderCoder::CodeVertices(BitDecoder&);
template void OrderCoder::CodeFaces(BitEncoder&, std::span<Face>);
template void OrderCoder::CodeFaces(BitDecoder&, std::span<Face>);

}  // namespace folprom
