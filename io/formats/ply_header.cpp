#include "io/formats/ply_header.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "io/formats/ply_place.h"
#include "io/formats/ply_scalar.h"
#include "io/limit_check.h"

namespace folprom::io {
namespace {

using Words = std::vector<std::string_view>;

std::optional<ScalarType> ScalarTypeNamed(std::string_view name) {
  using enum ScalarType;
  static constexpr std::pair<std::string_view, ScalarType> kNames[] = {
      {"char", kInt8},   {"uchar", kUint8},   {"short", kInt16},     {"ushort", kUint16},
      {"int", kInt32},   {"uint", kUint32},   {"float", kFloat32},   {"double", kFloat64},
      {"int8", kInt8},   {"uint8", kUint8},   {"int16", kInt16},     {"uint16", kUint16},
      {"int32", kInt32}, {"uint32", kUint32}, {"float32", kFloat32}, {"float64", kFloat64}};
  for (const auto& [known, type] : kNames) {
    if (known == name) return type;
  }
  return std::nullopt;
}

Words WordsOf(std::string_view line) {
  Words words;
  while (true) {
    const size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return words;
    const size_t end = std::min(line.find_first_of(" \t", begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
}

class HeaderParser {
 public:
  HeaderParser(std::span<const uint8_t> bytes, const std::string& path, const Limits& limits)
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
        path_(path),
        limits_(limits),
        remark_bytes_left_(std::min<uint64_t>(limits.comment_bytes, kMostRemarkBytes)) {}

  PlyHeader Parse() {
    NextLine();  // "ply", as HasPlyMagic saw
    while (true) {
      const std::string_view line = NextLine();
      const Words words = WordsOf(line);
      if (words.empty()) continue;
      if (words[0] == "comment" || words[0] == "obj_info") {
        KeepRemark(line.substr(line.find_first_not_of(" \t")));
        continue;
      }
      if (words[0] == "end_header") break;
      if (words[0] == "format") {
        ParseFormat(words);
      } else if (words[0] == "element") {
        ParseElement(words);
      } else if (words[0] == "property") {
        ParseProperty(words);
      } else {
        Fail("unknown keyword " + Quoted(words[0]));
      }
    }
    if (!has_format_) Fail("the header has no format line");
    header_.data_begin = position_;
    header_.line_count = line_number_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void Fail(const std::string& reason) const {
    throw Failure(ErrorKind::kInput,
                  path_ + ": line " + std::to_string(line_number_) + ": " + reason);
  }

  [[noreturn]] void FailTooLong() const {
    throw Failure(ErrorKind::kLimit, path_ + ": no end_header in the first " +
                                         std::to_string(limits_.header_bytes) +
                                         " bytes, the limit of a header");
  }

  std::string_view NextLine() {
    if (position_ >= text_.size()) Fail("the file ends before end_header");
    ++line_number_;
    const std::string_view rest =
        text_.substr(position_, std::min<uint64_t>(text_.size(), limits_.header_bytes) - position_);
    const size_t end = rest.find('\n');
    if (end == std::string_view::npos && text_.size() > limits_.header_bytes) FailTooLong();
    std::string_view line = rest.substr(0, end);
    position_ += std::min(line.size() + 1, rest.size());
    if (position_ == limits_.header_bytes) FailTooLong();
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  void KeepRemark(std::string_view line) {
    if (!IsRemark(line) || line.size() > remark_bytes_left_) {
      ++header_.remarks_dropped;
      return;
    }
    remark_bytes_left_ -= line.size();
    header_.remarks.emplace_back(line);
  }

  void ParseFormat(const Words& words) {
    if (has_format_) Fail("a second format line");
    if (words.size() != 3) Fail("a format line has the form: format <name> 1.0");
    if (words[1] == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (words[1] == "binary_little_endian") {
      header_.format = PlyFormat::kBinaryLittleEndian;
    } else if (words[1] == "binary_big_endian") {
      header_.format = PlyFormat::kBinaryBigEndian;
    } else {
      Fail("unknown format " + Quoted(words[1]));
    }
    if (words[2] != "1.0") Fail("unknown format version " + Quoted(words[2]));
    has_format_ = true;
  }

  void ParseElement(const Words& words) {
    if (words.size() != 3) Fail("an element line has the form: element <name> <count>");
    PlyElement element;
    element.name = NameIn(words[1]);
    const std::string_view count = words[2];
    const auto [end, error] =
        std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (error != std::errc() || end != count.data() + count.size()) {
      Fail("the count of element " + Quoted(element.name) + " is " + Quoted(count) +
           ", not a number from 0 to 2^64-1");
    }
    if (!element_names_.insert(element.name).second) {
      Fail("a second element " + Quoted(element.name));
    }
    property_names_.clear();
    header_.elements.push_back(std::move(element));
  }

  void ParseProperty(const Words& words) {
    if (header_.elements.empty()) Fail("a property before the first element");
    const bool is_list = words.size() > 1 && words[1] == "list";
    if (words.size() != (is_list ? 5 : 3)) {
      Fail(
          "a property line has the form: property <type> <name>, or"
          " property list <count type> <item type> <name>");
    }
    PlyProperty property;
    property.is_list = is_list;
    property.name = NameIn(words.back());
    property.type = TypeOf(words[words.size() - 2]);
    if (is_list) {
      property.count_type = TypeOf(words[2]);
      if (IsFloat(property.count_type)) Fail("the count of a list is not of an integer type");
    }
    if (!property_names_.insert(property.name).second) {
      Fail("a second property " + Quoted(property.name) + " of element " +
           Quoted(header_.elements.back().name));
    }
    CheckLimit(path_, ++properties_, limits_.properties, "properties");
    header_.elements.back().properties.push_back(std::move(property));
  }

  /// The name of an element or property; it will stand in messages as it is.
  std::string NameIn(std::string_view word) const {
    const bool printable = std::ranges::all_of(word, [](char c) { return c >= '!' && c <= '~'; });
    if (!printable)
      Fail("the name " + Quoted(word) + " has a character that is not printable ASCII");
    return std::string(word);
  }

  ScalarType TypeOf(std::string_view name) const {
    const std::optional<ScalarType> type = ScalarTypeNamed(name);
    if (!type) Fail("unknown type " + Quoted(name));
    return *type;
  }

  std::string_view text_;
  const std::string& path_;
  const Limits& limits_;
  uint64_t remark_bytes_left_;
  size_t position_ = 0;
  uint64_t line_number_ = 0;
  uint64_t properties_ = 0;
  bool has_format_ = false;
  std::set<std::string, std::less<>> element_names_;
  std::set<std::string, std::less<>> property_names_;  // of the last element
  PlyHeader header_;
};

}  // namespace

bool HasPlyMagic(std::span<const uint8_t> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                              std::min<size_t>(bytes.size(), 5));
  return text.starts_with("ply\n") || text == "ply\r\n";
}

PlyHeader ParsePlyHeader(std::span<const uint8_t> bytes, const std::string& path,
                         const Limits& limits) {
  return HeaderParser(bytes, path, limits).Parse();
}

}  // namespace folprom::io
