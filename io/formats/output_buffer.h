// Collects small pieces of an output into large ones.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace folprom::io {

/// Hands on what it holds whenever it is full, and on Flush.
class OutputBuffer {
 public:
  using Write = std::function<void(std::span<const uint8_t>)>;
  explicit OutputBuffer(Write write) : write_(std::move(write)) { buffer_.reserve(kBytes); }

  /// Room for `size` bytes at the end of the buffer, until the next call. At most 1 MiB.
  uint8_t* Extend(size_t size) {
    if (buffer_.size() + size > kBytes) Flush();
    buffer_.resize(buffer_.size() + size);
    return buffer_.data() + buffer_.size() - size;
  }

  /// At most 1 MiB.
  void Add(std::string_view text) { std::copy(text.begin(), text.end(), Extend(text.size())); }

  void Flush() {
    write_(buffer_);
    buffer_.clear();
  }

 private:
  static constexpr size_t kBytes = size_t{1} << 20;
  Write write_;
  std::vector<uint8_t> buffer_;
};

}  // namespace folprom::io
