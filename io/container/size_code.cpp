#include "io/container/size_code.h"

#include <algorithm>
#include <bit>

#include "io/container/file_table.h"
#include "io/container/row_code.h"

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

}  // namespace

void WriteSizes(std::span<const uint64_t> sizes, const SizeGrid& grid, BitWriter* bits) {
  std::vector<uint64_t> codes;
  const size_t known = grid.subtrees == 0 ? 0 : sizes.size() / (grid.subtrees * 2) - grid.layers;
  for (size_t part = 0; part < grid.parts(); ++part) {
    codes.clear();
    for (size_t layer = known; layer < known + grid.layers; ++layer) {
      ForRow(sizes, layer, part, grid.subtrees, [&](uint64_t prediction, uint64_t size) {
        codes.push_back(ZigZag(size - prediction));
      });
    }
    WriteRow(codes, bits);
  }
}

void ReadSizes(const SizeGrid& grid, const ByteReader& in, BitReader* bits,
               std::vector<uint64_t>* sizes) {
  const size_t known = grid.subtrees == 0 ? 0 : sizes->size() / (grid.subtrees * 2);
  sizes->reserve((known + grid.layers) * grid.subtrees * 2);  // and no more
  sizes->resize((known + grid.layers) * grid.subtrees * 2);
  for (size_t part = 0; part < grid.parts(); ++part) {
    const int order = ReadOrder(bits);
    for (size_t layer = known; layer < known + grid.layers; ++layer) {
      ForRow(*sizes, layer, part, grid.subtrees, [&](uint64_t prediction, uint64_t& size) {
        const uint64_t code = ReadNumber(order, bits);
        if (code > kLargestCode) in.Fail("segment size beyond 32 bits");
        size = prediction + UnZigZag(code);
        if (size > kMaxSegmentBytes) in.Fail("segment size negative or beyond 32 bits");
      });
    }
  }
}

}  // namespace folprom::io
