// Steps through the words of a text scan, line by line.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/files/mapped_file.h"
#include "io/formats/file_position.h"
#include "io/formats/mesh_source.h"

namespace folprom::io {

/// Is the word, of ASCII letters in any case, `small`, which is in small letters.
bool EqualsIgnoringCase(std::string_view word, std::string_view small);

/// Lines end in LF, CR LF or CR; the last may end in nothing. A word that begins with '#' begins a
/// comment; a byte order mark at the start of the file is skipped. Faults are Failure kInput and
/// name the file and the line.
class TextCursor {
 public:
  /// Whether a backslash at the end of a line joins the next one to it.
  enum class Lines : uint8_t { kSingle, kJoined };

  TextCursor(const MappedFile& file, FilePosition position, Lines lines = Lines::kSingle);

  FilePosition position() const { return {static_cast<uint64_t>(at_ - begin_), line_}; }

  /// Steps over what is left of blank lines and comments to a word; false where the file ends.
  bool NextWordLine();
  /// The next word of this line; empty where the line has none.
  std::string_view Word() {
    while (true) {
      while (at_ < end_ && IsBlank(*at_)) ++at_;
      if (!TakeJoint()) break;
    }
    const char* begin = at_;
    if (at_ < end_ && *at_ == '#') return {};
    while (at_ < end_ && IsWordByte(*at_) && !AtJoint()) ++at_;
    return {begin, static_cast<size_t>(at_ - begin)};
  }
  /// What is left of the line, of which blanks at both ends are no part, be it a comment; a
  /// backslash means nothing.
  std::string_view RestOfLine();
  /// Steps to the end of the line, not over it; joined lines are one.
  void SkipLine();
  /// The same, but a backslash means nothing.
  void SkipSingleLine();

  /// The next word of this line as a coordinate of the type, kFloat32 or kFloat64.
  double Coordinate(ScalarType type);
  /// The next word of this line as an integer; `what` is missing where the line ends.
  int64_t Integer(const char* what);

  [[noreturn]] void Fail(const std::string& reason) const;
  [[noreturn]] void FailWord(std::string_view word, const char* what) const;

 private:
  static bool IsNewline(char c) { return c == '\n' || c == '\r'; }
  static bool IsWordByte(char c) { return static_cast<unsigned char>(c) > ' '; }
  static bool IsBlank(char c) { return !IsWordByte(c) && !IsNewline(c); }

  bool AtJoint() const { return joined_ && *at_ == '\\' && JointBytes() > 0; }
  uint64_t JointBytes() const;
  /// Steps over a backslash and its newline; false where there is none.
  bool TakeJoint();
  void TakeNewline();

  const std::string* path_;
  const char* begin_;
  const char* at_;
  const char* end_;
  uint64_t line_;
  bool joined_;
};

/// Decides the type of the coordinates of a text file: kFloat64 where any word is not what float32
/// holds (IsFloat32Decimal), else kFloat32.
class CoordinateCensus {
 public:
  /// Takes the next three words of the line.
  void AddPosition(TextCursor& cursor);
  /// Takes a word that must be a number; its value.
  double Add(std::string_view word, const TextCursor& cursor);
  ScalarType type() const { return needs_double_ ? ScalarType::kFloat64 : ScalarType::kFloat32; }

 private:
  bool needs_double_ = false;
};

}  // namespace folprom::io
