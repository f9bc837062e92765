#include "io/formats/text_cursor.h"

#include <algorithm>

#include "folprom/float_bits.h"
#include "io/formats/text_number.h"

namespace folprom::io {

bool EqualsIgnoringCase(std::string_view word, std::string_view small) {
  return std::ranges::equal(word, small, {}, [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
}

TextCursor::TextCursor(const MappedFile& file, FilePosition position, Lines lines)
    : path_(&file.path()),
      begin_(reinterpret_cast<const char*>(file.bytes().data())),
      at_(begin_ + position.offset),
      end_(begin_ + file.bytes().size()),
      line_(position.line),
      joined_(lines == Lines::kJoined) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (at_ == begin_ && std::string_view(begin_, file.bytes().size()).starts_with(kByteOrderMark)) {
    at_ += kByteOrderMark.size();
  }
}

bool TextCursor::NextWordLine() {
  while (at_ < end_) {
    if (IsNewline(*at_)) {
      TakeNewline();
    } else if (*at_ == '#') {
      SkipSingleLine();
    } else if (IsBlank(*at_)) {
      ++at_;
    } else if (!TakeJoint()) {
      return true;
    }
  }
  return false;
}

void TextCursor::SkipLine() {
  while (!Word().empty()) {
  }
  SkipSingleLine();  // a comment, in which a backslash means nothing
}

void TextCursor::SkipSingleLine() {
  while (at_ < end_ && !IsNewline(*at_)) ++at_;
}

std::string_view TextCursor::RestOfLine() {
  while (at_ < end_ && IsBlank(*at_)) ++at_;
  const char* begin = at_;
  SkipSingleLine();
  const char* end = at_;
  while (end > begin && IsBlank(end[-1])) --end;
  return {begin, static_cast<size_t>(end - begin)};
}

double TextCursor::Coordinate(ScalarType type) {
  const std::string_view word = Word();
  if (word.empty()) Fail("the line has fewer than three coordinates");
  if (type == ScalarType::kFloat32) {
    float value = 0;
    if (!ParseReal(word, &value)) FailWord(word, "not a number");
    return WidenFloat(value);
  }
  double value = 0;
  if (!ParseReal(word, &value)) FailWord(word, "not a number");
  return value;
}

int64_t TextCursor::Integer(const char* what) {
  const std::string_view word = Word();
  if (word.empty()) Fail(std::string("the line ends before ") + what);
  int64_t value = 0;
  if (!ParseInteger(word, &value)) FailWord(word, "not an integer");
  return value;
}

void TextCursor::Fail(const std::string& reason) const {
  throw Failure(ErrorKind::kInput, *path_ + ": line " + std::to_string(line_) + ": " + reason);
}

void TextCursor::FailWord(std::string_view word, const char* what) const {
  Fail(Quoted(word) + " is " + what);
}

uint64_t TextCursor::JointBytes() const {
  if (end_ - at_ < 2 || !IsNewline(at_[1])) return 0;
  return end_ - at_ > 2 && at_[1] == '\r' && at_[2] == '\n' ? 3 : 2;
}

bool TextCursor::TakeJoint() {
  if (at_ == end_ || !AtJoint()) return false;
  at_ += JointBytes();
  ++line_;
  return true;
}

void TextCursor::TakeNewline() {
  at_ += end_ - at_ > 1 && at_[0] == '\r' && at_[1] == '\n' ? 2 : 1;
  ++line_;
}

void CoordinateCensus::AddPosition(TextCursor& cursor) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view word = cursor.Word();
    if (word.empty()) cursor.Fail("the line has fewer than three coordinates");
    Add(word, cursor);
  }
}

double CoordinateCensus::Add(std::string_view word, const TextCursor& cursor) {
  double value = 0;
  if (!ParseReal(word, &value)) cursor.FailWord(word, "not a number");
  if (!needs_double_) needs_double_ = !IsFloat32Decimal(word, value);
  return value;
}

}  // namespace folprom::io
