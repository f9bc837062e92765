#include "io/formats/obj_statements.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "io/formats/vertex_schema.h"

namespace folprom::io {
namespace {

constexpr std::string_view kBegin = "obj_info ";

std::string Remark(std::string_view what, std::string_view rest) {
  std::string remark(kBegin);
  remark += what;
  remark += ' ';
  remark += rest;
  return remark;
}

/// Takes "word " off; false where it does not begin so.
bool Take(std::string_view word, std::string_view* line) {
  if (!line->starts_with(word) || line->size() <= word.size() || (*line)[word.size()] != ' ') {
    return false;
  }
  line->remove_prefix(word.size() + 1);
  return true;
}

}  // namespace

size_t ObjNames::StatementOf(std::string_view keyword) {
  return static_cast<size_t>(std::ranges::find(kObjStatements, keyword, &ObjStatement::keyword) -
                             kObjStatements.begin());
}

uint32_t ObjNames::Add(size_t statement, std::string_view name) {
  auto& numbers = numbers_[statement];
  if (const auto known = numbers.find(name); known != numbers.end()) return known->second;
  const auto number = static_cast<uint32_t>(numbers.size() + 1);
  const std::string text = std::to_string(number) + " " + std::string(name);
  if (!AddRemark(Remark(kObjStatements[statement].attribute, text))) return 0;
  numbers.emplace(name, number);
  return number;
}

void ObjNames::AddMaterialFile(std::string_view name) { AddRemark(Remark(kMaterialFiles, name)); }

bool ObjNames::AddRemark(std::string remark) {
  if (!is_whole_ || remark.size() > bytes_left_ || !IsRemark(remark)) {
    is_whole_ = false;
    return false;
  }
  bytes_left_ -= remark.size();
  remarks_.push_back(std::move(remark));
  return true;
}

uint32_t ObjNames::NumberOf(size_t statement, std::string_view name) const {
  const auto known = numbers_[statement].find(name);
  return known == numbers_[statement].end() ? 0 : known->second;
}

ObjRemarks::ObjRemarks(const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) {
    std::string_view line = remark;
    bool is_known = false;
    if (line.starts_with(kBegin)) {
      line.remove_prefix(kBegin.size());
      if (Take(kMaterialFiles, &line)) {
        material_files_.emplace_back(line);
        continue;
      }
      for (size_t s = 0; s < kObjStatements.size() && !is_known; ++s) {
        std::string_view rest = line;
        uint32_t number = 0;
        if (!Take(kObjStatements[s].attribute, &rest)) continue;
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
        if (error != std::errc() || end == rest.data() + rest.size() || *end != ' ') continue;
        rest.remove_prefix(static_cast<size_t>(end - rest.data()) + 1);
        names_[s][number] = rest;
        is_known = true;
      }
    }
    if (!is_known) ++others_;
  }
}

std::string_view ObjRemarks::NameOf(size_t statement, uint32_t number) const {
  const auto known = names_[statement].find(number);
  return known == names_[statement].end() ? std::string_view() : known->second;
}

}  // namespace folprom::io
