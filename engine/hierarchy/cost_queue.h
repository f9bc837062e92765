// Vertices by cost, cheapest first but for 1/128 of an octave: a list per bucket of costs.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace folprom {

/// Each vertex is in it once at most. Costs are not negative; one below what was taken last counts
/// as that; of those in one bucket the last comes first. Taking and pushing take constant time; all
/// buckets are passed once.
class CostQueue {
 public:
  static constexpr uint32_t kNobody = ~uint32_t{0};

  explicit CostQueue(uint32_t vertices)
      : first_(kBuckets, kNobody), next_(vertices), previous_(vertices), bucket_(vertices, kOut) {}

  void Push(uint32_t vertex, float cost) {
    if (bucket_[vertex] != kOut) Remove(vertex);
    const uint32_t bucket = std::max(BucketOf(cost), now_);
    const uint32_t behind = first_[bucket];
    next_[vertex] = behind;
    previous_[vertex] = kNobody;
    if (behind != kNobody) previous_[behind] = vertex;
    first_[bucket] = vertex;
    bucket_[vertex] = static_cast<uint16_t>(bucket);
  }
  void Remove(uint32_t vertex) {
    const uint32_t bucket = bucket_[vertex];
    if (bucket == kOut) return;
    if (previous_[vertex] == kNobody) {
      first_[bucket] = next_[vertex];
    } else {
      next_[previous_[vertex]] = next_[vertex];
    }
    if (next_[vertex] != kNobody) previous_[next_[vertex]] = previous_[vertex];
    bucket_[vertex] = kOut;
  }
  /// kNobody: it is empty.
  uint32_t Take() {
    while (first_[now_] == kNobody) {
      if (++now_ == kBuckets) {
        now_ = 0;
        return kNobody;
      }
    }
    const uint32_t vertex = first_[now_];
    Remove(vertex);
    return vertex;
  }
  /// One that is likely to be taken some turns after the one that this said last, for whoever asks
  /// for memory early: none that is pushed or removed meanwhile is looked for. kNobody: nobody
  /// knows.
  uint32_t Peek() {
    constexpr uint32_t kBehind = 6, kBucketsAhead = 4;
    if (peeked_ == kNobody || bucket_[peeked_] != peeked_bucket_ || peeked_bucket_ < now_) {
      peeked_bucket_ = now_;
      peeked_ = first_[now_];
      for (uint32_t i = 0; i < kBehind && peeked_ != kNobody; ++i) peeked_ = next_[peeked_];
    } else {
      peeked_ = next_[peeked_];
    }
    const uint32_t last = std::min(now_ + kBucketsAhead, kBuckets - 1);
    while (peeked_ == kNobody && peeked_bucket_ < last) peeked_ = first_[++peeked_bucket_];
    return peeked_;
  }
  /// Costs below this are in the bucket from which was taken last, or before it.
  float Limit() const { return std::bit_cast<float>((now_ + 1) << kDropped); }

 private:
  /// Of a float: its exponent and seven bits of its mantissa are left.
  static constexpr uint32_t kDropped = 16;
  static constexpr uint32_t kBuckets = 0x7f8u << 4;
  static constexpr uint16_t kOut = 0xffff;
  static uint32_t BucketOf(float cost) {
    return std::min(std::bit_cast<uint32_t>(cost) >> kDropped, kBuckets - 1);
  }

  std::vector<uint32_t> first_, next_, previous_;
  std::vector<uint16_t> bucket_;
  uint32_t now_ = 0;
  uint32_t peeked_ = kNobody, peeked_bucket_ = 0;
};

}  // namespace folprom
