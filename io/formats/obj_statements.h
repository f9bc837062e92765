// Statements of an OBJ file that hold for the faces behind them, as attributes of faces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace folprom::io {

/// An attribute counts the names of a statement in the order in which they first come; 0: none yet.
/// A remark tells the name of each number: "obj_info material 1 brass".
struct ObjStatement {
  std::string_view keyword;
  std::string_view attribute;
};
inline constexpr std::array<ObjStatement, 4> kObjStatements{
    {{"o", "object"}, {"g", "group"}, {"usemtl", "material"}, {"s", "smoothing"}}};
/// Where the materials are: "obj_info mtllib scan.mtl".
inline constexpr std::string_view kMaterialFiles = "mtllib";

/// Numbers of the statements that hold at a face.
using ObjState = std::array<uint32_t, kObjStatements.size()>;

/// The names that a file has, with their numbers.
class ObjNames {
 public:
  /// Index into kObjStatements; their number for other keywords.
  static size_t StatementOf(std::string_view keyword);

  /// most_bytes: of all remarks together.
  explicit ObjNames(uint64_t most_bytes) : bytes_left_(most_bytes) {}
  /// The number of a name, a new one where it has not come yet; 0 where there is no more room.
  uint32_t Add(size_t statement, std::string_view name);
  void AddMaterialFile(std::string_view name);

  /// The number of a name that was added.
  uint32_t NumberOf(size_t statement, std::string_view name) const;
  bool Has(size_t statement) const { return !numbers_[statement].empty(); }
  /// Did all names find room.
  bool is_whole() const { return is_whole_; }
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  bool AddRemark(std::string remark);

  uint64_t bytes_left_;
  bool is_whole_ = true;
  std::array<std::map<std::string, uint32_t, std::less<>>, kObjStatements.size()> numbers_;
  std::vector<std::string> remarks_;
};

/// What remarks of these forms say.
class ObjRemarks {
 public:
  explicit ObjRemarks(const std::vector<std::string>& remarks);
  /// Empty where no remark tells it.
  std::string_view NameOf(size_t statement, uint32_t number) const;
  bool HasNames(size_t statement) const { return !names_[statement].empty(); }
  const std::vector<std::string>& material_files() const { return material_files_; }
  /// Remarks of other forms.
  size_t others() const { return others_; }

 private:
  std::array<std::map<uint32_t, std::string>, kObjStatements.size()> names_;
  std::vector<std::string> material_files_;
  size_t others_ = 0;
};

}  // namespace folprom::io
