#include "io/formats/ply_ascii_cursor.h"

#include <limits>
#include <string>
#include <type_traits>

#include "io/formats/text_number.h"

namespace folprom::io {

void PlyAsciiCursor::BeginRecord(uint64_t record) {
  place_.record = record;
  while (at_ < end_ && static_cast<unsigned char>(*at_) <= ' ') {
    if (*at_++ == '\n') ++line_;
  }
  if (at_ == end_) FailAtEnd();
}

void PlyAsciiCursor::EndRecord() {
  while (at_ < end_ && IsBlank(*at_)) ++at_;
  if (at_ == end_) return;
  if (*at_ != '\n') Fail("the line has more values than the header names");
  ++at_;
  ++line_;
}

uint64_t PlyAsciiCursor::Count(ScalarType type) {
  const int64_t count = Integer(type);
  if (count < 0) Fail("a list has the negative count " + std::to_string(count));
  return static_cast<uint64_t>(count);
}

int64_t PlyAsciiCursor::Integer(ScalarType) {
  const std::string_view word = Word();
  int64_t value = 0;
  if (!ParseInteger(word, &value)) FailWord(word, "not an integer");
  return value;
}

double PlyAsciiCursor::Real(ScalarType type) {
  const std::string_view word = Word();
  return WithScalarType(type, [&]<class T>(T) -> double {
    if constexpr (std::is_floating_point_v<T>) {
      T value = 0;
      if (!ParseReal(word, &value)) FailWord(word, "not a number");
      return static_cast<double>(value);
    } else {
      int64_t value = 0;
      if (!ParseInteger(word, &value)) FailWord(word, "not an integer");
      if (value < std::numeric_limits<T>::min() || value > std::numeric_limits<T>::max()) {
        FailWord(word, "out of the range of its type");
      }
      return static_cast<double>(value);
    }
  });
}

void PlyAsciiCursor::FailAtEnd() const {
  Fail(at_ == end_ ? "the file ends in it" : "the line has fewer values than the header names");
}

void PlyAsciiCursor::Fail(const std::string& reason) const {
  throw place_.Fault("line " + std::to_string(line_) + ": " + reason);
}

void PlyAsciiCursor::FailWord(std::string_view word, const char* what) const {
  Fail(Quoted(word) + " is " + what);
}

}  // namespace folprom::io
