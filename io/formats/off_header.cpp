#include "io/formats/off_header.h"

#include "io/formats/text_cursor.h"
#include "io/formats/text_number.h"

namespace folprom::io {
namespace {

bool TakePrefix(std::string_view& word, std::string_view prefix) {
  if (!word.starts_with(prefix)) return false;
  word.remove_prefix(prefix.size());
  return true;
}

struct Keyword {
  bool texture = false, colours = false, normals = false, four = false, any_dimension = false;
  bool is_off = false;
};

Keyword ParseKeyword(std::string_view word) {
  Keyword keyword;
  keyword.texture = TakePrefix(word, "ST");
  keyword.colours = TakePrefix(word, "C");
  keyword.normals = TakePrefix(word, "N");
  keyword.four = TakePrefix(word, "4");
  keyword.any_dimension = TakePrefix(word, "n");
  keyword.is_off = word == "OFF";
  return keyword;
}

uint64_t Count(TextCursor& cursor, const char* what) {
  const int64_t count = cursor.Integer(what);
  if (count < 0) cursor.Fail("the " + std::string(what) + " is negative");
  return static_cast<uint64_t>(count);
}

/// "vertices faces [edges]"; the number of edges is not looked at.
void ParseCounts(TextCursor& cursor, OffHeader& header) {
  if (!cursor.NextWordLine()) cursor.Fail("the file ends before the number of vertices");
  header.vertices = Count(cursor, "number of vertices");
  header.faces = Count(cursor, "number of faces");
  const std::string_view edges = cursor.Word();
  int64_t ignored = 0;
  if (!edges.empty() && !ParseInteger(edges, &ignored)) cursor.FailWord(edges, "not an integer");
  if (!cursor.Word().empty()) cursor.Fail("more than three counts");
  header.body = cursor.position();
}

}  // namespace

bool IsOffKeyword(std::string_view word) { return ParseKeyword(word).is_off; }

OffHeader ParseOffHeader(const MappedFile& file) {
  TextCursor cursor(file, {0, 1});
  if (!cursor.NextWordLine()) cursor.Fail("the file has no line but comments");
  OffHeader header;
  const FilePosition begin = cursor.position();
  const std::string_view word = cursor.Word();
  const Keyword keyword = ParseKeyword(word);
  if (!keyword.is_off) {
    cursor = TextCursor(file, begin);
    ParseCounts(cursor, header);
    return header;
  }
  if (keyword.four || keyword.any_dimension) {
    cursor.Fail("vertices of other than three coordinates (" + std::string(word) +
                ") are not supported");
  }
  header.has_texture = keyword.texture;
  header.has_colours = keyword.colours;
  header.has_normals = keyword.normals;

  const FilePosition behind = cursor.position();
  if (cursor.Word() == "BINARY") {
    header.is_binary = true;
    cursor.SkipSingleLine();
    header.body = cursor.position();
    const std::span<const uint8_t> bytes = file.bytes().subspan(header.body.offset);
    // CR LF is one line break; a CR alone could be a byte of the counts, but no writer ends so.
    const bool has_return = bytes.size() > 1 && bytes[0] == '\r' && bytes[1] == '\n';
    if (bytes.empty()) cursor.Fail("the file ends before the number of vertices");
    header.body.offset += has_return ? 2 : 1;
    return header;
  }
  cursor = TextCursor(file, behind);
  ParseCounts(cursor, header);
  return header;
}

}  // namespace folprom::io
