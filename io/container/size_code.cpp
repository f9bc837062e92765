#include "io/container/size_code.h"

#include <algorithm>
#include <bit>

#include "io/container/file_table.h"

namespace folprom::io {
namespace {

constexpr uint64_t kLargestCode = 2 * kMaxSegmentBytes;  // zigzag of +-(2^32 - 1)

int BitWidth(uint64_t value) { return static_cast<int>(std::bit_width(value)); }

/// Predicts the sizes of a row (layer, part) from left to right by the row of the layer before.
class RowPredictor {
 public:
  /// `above`: the size of the same segment one layer before.
  uint64_t Next(uint64_t above) const {
    if (above_sum_ == 0) return above;
    uint64_t sum = sum_, above_sum = above_sum_;
    const int shift = std::max(0, BitWidth(above_sum) - 20);
    sum >>= shift;
    above_sum >>= shift;
    return std::min(above * std::min(sum, 16 * above_sum) / above_sum, kMaxSegmentBytes);
  }
  void Add(uint64_t above, uint64_t size) {
    above_sum_ += above;
    sum_ += size;
  }

 private:
  uint64_t above_sum_ = 0, sum_ = 0;
};

/// Calls code(prediction, size&) for the segments of one row; the first layer has its left
/// neighbour as the layer before.
template <class Sizes, class Code>
void ForRow(Sizes& sizes, size_t layer, size_t part, size_t subtrees, const Code& code) {
  RowPredictor predictor;
  uint64_t left = 0;
  for (size_t subtree = 0; subtree < subtrees; ++subtree) {
    auto& size = sizes[(layer * subtrees + subtree) * 2 + part];
    const uint64_t above = layer > 0 ? sizes[((layer - 1) * subtrees + subtree) * 2 + part] : left;
    code(layer > 0 ? predictor.Next(above) : left, size);
    predictor.Add(above, size);
    left = size;
  }
}

/// Length of the exponential Golomb code of order k.
int CodeBits(uint64_t code, int k) { return 2 * BitWidth(code + (uint64_t{1} << k)) - 1 - k; }

/// Order that makes the row shortest, the smallest of several.
int BestOrder(std::span<const uint64_t> codes) {
  int best = 0;
  uint64_t best_bits = UINT64_MAX;
  for (int k = 0; k < 1 << kRowParameterBits; ++k) {
    uint64_t bits = 0;
    for (const uint64_t code : codes) bits += static_cast<uint64_t>(CodeBits(code, k));
    if (bits >= best_bits) continue;
    best_bits = bits;
    best = k;
  }
  return best;
}

void WriteCode(uint64_t code, int k, BitWriter* bits) {
  const uint64_t shifted = code + (uint64_t{1} << k);
  const int width = BitWidth(shifted);
  bits->Bits(0, width - 1 - k);
  bits->Bits(shifted, width);
}

uint64_t ReadCode(int k, BitReader* bits) {
  const int width = k + bits->Zeros(34 - k);
  return ((uint64_t{1} << width) | bits->Bits(width)) - (uint64_t{1} << k);
}

}  // namespace

void WriteSizes(std::span<const uint64_t> sizes, const SizeGrid& grid, ByteWriter* out) {
  BitWriter bits(out);
  std::vector<uint64_t> codes;
  const size_t known = grid.subtrees == 0 ? 0 : sizes.size() / (grid.subtrees * 2) - grid.layers;
  for (size_t row = 0; row < grid.parts() * grid.layers; ++row) {
    codes.clear();
    ForRow(sizes, known + row / grid.parts(), row % grid.parts(), grid.subtrees,
           [&](uint64_t prediction, uint64_t size) { codes.push_back(ZigZag(size - prediction)); });
    const int k = BestOrder(codes);
    bits.Bits(static_cast<uint64_t>(k), kRowParameterBits);
    for (const uint64_t code : codes) WriteCode(code, k, &bits);
  }
  bits.Finish();
}

void ReadSizes(const SizeGrid& grid, ByteReader* in, std::vector<uint64_t>* sizes) {
  const size_t known = grid.subtrees == 0 ? 0 : sizes->size() / (grid.subtrees * 2);
  sizes->resize((known + grid.layers) * grid.subtrees * 2);
  BitReader bits(in);
  for (size_t row = 0; row < grid.parts() * grid.layers; ++row) {
    const int k = static_cast<int>(bits.Bits(kRowParameterBits));
    ForRow(*sizes, known + row / grid.parts(), row % grid.parts(), grid.subtrees,
           [&](uint64_t prediction, uint64_t& size) {
             const uint64_t code = ReadCode(k, &bits);
             if (code > kLargestCode) in->Fail("segment size beyond 32 bits");
             size = prediction + UnZigZag(code);
             if (size > kMaxSegmentBytes) in->Fail("segment size negative or beyond 32 bits");
           });
  }
  bits.Finish();
}

}  // namespace folprom::io
