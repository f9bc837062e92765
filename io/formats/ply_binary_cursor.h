// Steps through the values of a binary PLY body.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "io/formats/ply_place.h"
#include "io/formats/ply_scalar.h"

namespace folprom::io {

/// Every step checks the bytes that are left. Faults are Failure kInput.
template <bool kBigEndian>
class PlyBinaryCursor {
 public:
  static constexpr bool kFixedSizes = true;
  static constexpr bool kIsBigEndian = kBigEndian;

  PlyBinaryCursor(std::span<const uint8_t> bytes, FilePosition position, PlyPlace place)
      : begin_(bytes.data()),
        at_(begin_ + position.offset),
        end_(begin_ + bytes.size()),
        place_(place) {}

  FilePosition position() const { return {static_cast<uint64_t>(at_ - begin_), 0}; }
  const PlyPlace& place() const { return place_; }

  void BeginRecord(uint64_t record) { place_.record = record; }
  void EndRecord() {}

  void Skip(ScalarType type) { Take(ScalarSize(type)); }

  void SkipItems(ScalarType type, uint64_t count) { Take(count, ScalarSize(type)); }

  /// The count of a list; negative ones are faults.
  uint64_t Count(ScalarType type) {
    const int64_t count = Integer(type);
    if (count < 0) throw place_.Fault("a list has the negative count " + std::to_string(count));
    return static_cast<uint64_t>(count);
  }

  int64_t Integer(ScalarType type) {
    const uint8_t* bytes = Take(ScalarSize(type));
    return WithScalarType(
        type, [bytes]<class T>(T) { return static_cast<int64_t>(Load<T, kBigEndian>(bytes)); });
  }

  double Real(ScalarType type) {
    const uint8_t* bytes = Take(ScalarSize(type));
    return WithScalarType(type,
                          [bytes]<class T>(T) { return ToDouble(Load<T, kBigEndian>(bytes)); });
  }

  /// Three items of a list of integers.
  template <class Use>
  void ThreeIntegers(ScalarType type, Use use) {
    const uint8_t* bytes = Take(3 * ScalarSize(type));
    WithScalarType(type, [&]<class T>(T) {
      use(static_cast<int64_t>(Load<T, kBigEndian>(bytes)),
          static_cast<int64_t>(Load<T, kBigEndian>(bytes + sizeof(T))),
          static_cast<int64_t>(Load<T, kBigEndian>(bytes + 2 * sizeof(T))));
    });
  }

  /// Steps over at most `most` records of `stride` bytes as long as the byte `prefix` bytes into a
  /// record is 3; their number. No record depends on the one before: much faster than one by one.
  uint64_t SkipTriangles(uint64_t prefix, uint64_t stride, uint64_t most) {
    most = std::min(most, static_cast<uint64_t>(end_ - at_) / stride);
    uint64_t count = 0;
    while (count < most && at_[prefix + count * stride] == 3) ++count;
    at_ += count * stride;
    return count;
  }

  /// The bytes of `count` records of `size` bytes each.
  const uint8_t* Take(uint64_t count, uint64_t size) {
    if (count > static_cast<uint64_t>(end_ - at_) / size) throw place_.Fault("the file ends in it");
    return std::exchange(at_, at_ + count * size);
  }

 private:
  const uint8_t* Take(uint64_t size) {
    if (size > static_cast<uint64_t>(end_ - at_)) throw place_.Fault("the file ends in it");
    return std::exchange(at_, at_ + size);
  }

  const uint8_t* begin_;
  const uint8_t* at_;
  const uint8_t* end_;
  PlyPlace place_;
};

}  // namespace folprom::io
