// Binary arithmetic coder: 64-bit interval, 16-bit probabilities. Encoder and decoder have the same
// Code(), so that one template serves both directions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/entropy/fixed_math.h"
#include "folprom/result.h"

namespace folprom {

namespace detail {
/// Cost of a decision of probability p/4096 in 1/1024 bit.
inline constexpr auto kCost = [] {
  std::array<uint16_t, 4097> cost{};
  for (size_t p = 1; p <= 4096; ++p) {
    cost[p] = static_cast<uint16_t>((12 - Log2Exact(static_cast<double>(p))) * 1024 + 0.5);
  }
  cost[0] = 13 * 1024;
  return cost;
}();

/// The number of [low, high] whose upper `bytes` bytes are the fewest that may be other than 0.
struct Ending {
  uint64_t value = 0;
  size_t bytes = 0;
};
inline Ending ShortestEnding(uint64_t low, uint64_t high) {
  for (size_t bytes = 0; bytes < 8; ++bytes) {
    const uint64_t mask = ~uint64_t{0} >> (8 * bytes);
    if ((low & mask) == 0) return {low, bytes};
    const uint64_t value = (low | mask) + 1;
    if (value != 0 && value <= high) return {value, bytes};  // 0: ran over the top
  }
  return {low, 8};
}
}  // namespace detail

/// Writes decisions. Not thread-safe.
class BitEncoder {
 public:
  static constexpr bool kEncoding = true;

  /// Codes `bit`; one_in_65536 in [1, 65535] is the probability of 1. Returns the bit.
  bool Code(uint32_t one_in_65536, bool bit) {
    ++decisions_;
    uint64_t range = high_ - low_;
    uint64_t middle =
        low_ + (range >> 16) * one_in_65536 + (((range & 0xffff) * one_in_65536) >> 16);
    if (bit) {
      high_ = middle;
    } else {
      low_ = middle + 1;
    }
    while (((low_ ^ high_) >> 56) == 0) {
      bytes_.push_back(static_cast<uint8_t>(low_ >> 56));
      low_ <<= 8;
      high_ = high_ << 8 | 0xff;
    }
    *meter_ += detail::kCost[(bit ? one_in_65536 : 65536 - one_in_65536) >> 4];
    return bit;
  }

  /// From here on costs are added to *meter, in 1/1024 bit.
  void SetMeter(uint64_t* meter) { meter_ = meter; }

  /// Ends the segment with the fewest bytes that tell it from every other; the decoder reads zeros
  /// beyond the end. Returns the segment and starts a new one.
  std::vector<uint8_t> TakeSegment() {
    const detail::Ending ending = detail::ShortestEnding(low_, high_);
    for (size_t i = 0; i < ending.bytes; ++i) {
      bytes_.push_back(static_cast<uint8_t>(ending.value >> (56 - 8 * i)));
    }
    low_ = 0;
    high_ = ~uint64_t{0};
    return std::exchange(bytes_, {});
  }
  /// Decisions coded since the beginning; a segment without any may still be wanted by its layer,
  /// and one with some may have no bytes.
  uint64_t decisions() const { return decisions_; }

 private:
  uint64_t low_ = 0;
  uint64_t high_ = ~uint64_t{0};
  uint64_t decisions_ = 0;
  uint64_t unmetered_ = 0;
  uint64_t* meter_ = &unmetered_;
  std::vector<uint8_t> bytes_;
};

/// Reads decisions. Throws Failure kCorrupt when more is asked for than the segment holds.
class BitDecoder {
 public:
  static constexpr bool kEncoding = false;

  BitDecoder() = default;
  void StartSegment(std::span<const uint8_t> bytes) {
    bytes_ = bytes;
    position_ = 0;
    low_ = 0;
    high_ = ~uint64_t{0};
    code_ = 0;
    for (int i = 0; i < 8; ++i) Shift();
  }

  bool Code(uint32_t one_in_65536, bool = false) {
    uint64_t range = high_ - low_;
    uint64_t middle =
        low_ + (range >> 16) * one_in_65536 + (((range & 0xffff) * one_in_65536) >> 16);
    bool bit = code_ <= middle;
    if (bit) {
      high_ = middle;
    } else {
      low_ = middle + 1;
    }
    while (((low_ ^ high_) >> 56) == 0) {
      low_ <<= 8;
      high_ = high_ << 8 | 0xff;
      Shift();
    }
    return bit;
  }
  void SetMeter(uint64_t*) {}
  /// Throws Failure kCorrupt unless the segment has just the bytes that its decisions need.
  void FinishSegment() const {
    const size_t needed = position_ - 8 + detail::ShortestEnding(low_, high_).bytes;
    if (bytes_.size() > needed) {
      throw Failure(ErrorKind::kCorrupt, "coded segment is longer than its content");
    }
    if (bytes_.size() < needed) throw Failure(ErrorKind::kCorrupt, "coded segment ends early");
  }

 private:
  void Shift() {
    uint64_t next = 0;
    if (position_ < bytes_.size()) {
      next = bytes_[position_];
    } else if (position_ >= bytes_.size() + 8) {
      throw Failure(ErrorKind::kCorrupt, "coded segment ends early");
    }
    ++position_;
    code_ = code_ << 8 | next;
  }
  std::span<const uint8_t> bytes_;
  size_t position_ = 0;
  uint64_t low_ = 0, high_ = ~uint64_t{0}, code_ = 0;
};

}  // namespace folprom
