#include <algorithm>
#include <string>
#include <utility>

#include "folprom/float_bits.h"
#include "io/formats/ply_scalar.h"
#include "io/formats/resident_window.h"
#include "io/formats/soup_source.h"
#include "io/formats/stl_source.h"

namespace folprom::io {
namespace {

constexpr uint64_t kHeaderBytes = 84;  // 80 of text, then the number of facets
constexpr uint64_t kNormalBytes = 12;
constexpr uint64_t kCornerBytes = 36;
constexpr uint64_t kFacetBytes = kNormalBytes + kCornerBytes + 2;  // attributes

uint64_t FacetCount(std::span<const uint8_t> bytes) {
  return Load<uint32_t, false>(bytes.data() + kHeaderBytes - sizeof(uint32_t));
}

uint64_t CheckedFacetCount(const MappedFile& file) {
  const uint64_t size = file.bytes().size();
  const auto fail = [&](const std::string& reason) {
    throw Failure(ErrorKind::kInput, file.path() + ": binary STL: " + reason);
  };
  if (size < kHeaderBytes) {
    fail("the file ends in the header, " + std::to_string(size) + " of " +
         std::to_string(kHeaderBytes) + " bytes");
  }
  const uint64_t facets = FacetCount(file.bytes());
  const uint64_t held = (size - kHeaderBytes) / kFacetBytes;
  if (facets != held) {
    fail(std::to_string(facets) + " facets are announced, but the file holds " +
         std::to_string(held));
  }
  return facets;
}

class BinaryStlSource final : public SoupSource {
 public:
  explicit BinaryStlSource(MappedFile mapped) : SoupSource(std::move(mapped)) {
    SetFacets(CheckedFacetCount(file()));
    NoteWhatIsNotCoded();
  }

  Result<void> ReadVertexBlock(size_t block, std::vector<double>* xyz) const override {
    xyz->resize(3 * VerticesIn(block));
    const uint8_t* facet = Facet(vertex_block_begin(block) / 3);
    double* to = xyz->data();
    for (uint64_t i = 0; i < VerticesIn(block) / 3; ++i, facet += kFacetBytes) {
      for (uint64_t at = 0; at < kCornerBytes; at += sizeof(float)) {
        *to++ = WidenFloat(Load<float, false>(facet + kNormalBytes + at));
      }
    }
    return {};
  }

 private:
  const uint8_t* Facet(uint64_t index) const {
    return file().bytes().data() + kHeaderBytes + index * kFacetBytes;
  }

  void NoteWhatIsNotCoded() {
    const auto is_set = [](uint8_t byte) { return byte != 0; };
    bool has_normals = false, has_attributes = false;
    ResidentWindow window(file());
    for (uint64_t i = 0; i < index_.triangles; ++i) {
      const uint8_t* facet = Facet(i);
      has_normals = has_normals || std::any_of(facet, facet + kNormalBytes, is_set);
      has_attributes |= is_set(facet[kFacetBytes - 2]) || is_set(facet[kFacetBytes - 1]);
      if (has_normals && has_attributes) break;
      if (i % kBlockFacets == 0) window.Advance(kHeaderBytes + i * kFacetBytes);
    }
    std::vector<std::string>& names = index_.notes.ignored_properties;
    if (has_normals) names.push_back("facet normals");
    if (has_attributes) names.push_back("attribute bytes of facets");
    const uint64_t rest = file().bytes().size() - kHeaderBytes - index_.triangles * kFacetBytes;
    if (rest > 0)
      names.push_back("what lies behind the last facet (" + std::to_string(rest) + " B)");
  }
};

}  // namespace

bool HasBinaryStlSize(std::span<const uint8_t> bytes) {
  return bytes.size() > kHeaderBytes &&
         bytes.size() == kHeaderBytes + FacetCount(bytes) * kFacetBytes;
}

std::unique_ptr<MeshSource> OpenBinaryStlSource(MappedFile file) {
  return std::make_unique<BinaryStlSource>(std::move(file));
}

}  // namespace folprom::io
