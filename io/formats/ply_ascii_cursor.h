// Steps through the values of a text PLY body: a line a record, values between blanks.
#pragma once

#include <span>
#include <string_view>

#include "io/formats/ply_place.h"
#include "io/formats/ply_scalar.h"

namespace folprom::io {

/// The same steps as PlyBinaryCursor. Faults are Failure kInput and name the line. Values that are
/// skipped are not parsed.
class PlyAsciiCursor {
 public:
  static constexpr bool kFixedSizes = false;

  PlyAsciiCursor(std::span<const uint8_t> bytes, FilePosition position, PlyPlace place)
      : begin_(reinterpret_cast<const char*>(bytes.data())),
        at_(begin_ + position.offset),
        end_(begin_ + bytes.size()),
        line_(position.line),
        place_(place) {}

  FilePosition position() const { return {static_cast<uint64_t>(at_ - begin_), line_}; }
  const PlyPlace& place() const { return place_; }

  /// Steps over empty lines to the first value of the record.
  void BeginRecord(uint64_t record);
  /// Steps to the next line. Values left on this one are a fault: the header does not name them.
  void EndRecord();

  void Skip(ScalarType) { Word(); }
  void SkipItems(ScalarType, uint64_t count) {
    for (uint64_t i = 0; i < count; ++i) Word();
  }
  uint64_t Count(ScalarType type);
  int64_t Integer(ScalarType type);
  /// Of the value as the type of the file holds it: for kFloat32 the nearest float.
  double Real(ScalarType type);

  template <class Use>
  void ThreeIntegers(ScalarType type, Use use) {
    const int64_t a = Integer(type);
    const int64_t b = Integer(type);
    use(a, b, Integer(type));
  }

 private:
  static bool IsWordByte(char c) { return static_cast<unsigned char>(c) > ' '; }
  static bool IsBlank(char c) { return !IsWordByte(c) && c != '\n'; }

  // In the header, as all of the steps over words spend their time here.
  std::string_view Word() {
    while (at_ < end_ && IsBlank(*at_)) ++at_;
    const char* begin = at_;
    while (at_ < end_ && IsWordByte(*at_)) ++at_;
    if (at_ == begin) FailAtEnd();
    return {begin, static_cast<size_t>(at_ - begin)};
  }

  [[noreturn]] void FailAtEnd() const;
  [[noreturn]] void Fail(const std::string& reason) const;
  [[noreturn]] void FailWord(std::string_view word, const char* what) const;

  const char* begin_;
  const char* at_;
  const char* end_;
  uint64_t line_;
  PlyPlace place_;
};

}  // namespace folprom::io
