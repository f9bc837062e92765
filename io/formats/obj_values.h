// What the lines "vt" and "vn" of an OBJ file say, on disk.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "folprom/scalar_type.h"
#include "io/files/mapped_file.h"
#include "io/files/scratch_file.h"

namespace folprom::io {

/// What corners name beside vertices.
enum ObjList : size_t { kTextures, kNormals, kObjLists };
inline constexpr std::array<std::string_view, kObjLists> kObjListKeywords{"vt", "vn"};
inline constexpr std::array<std::string_view, kObjLists> kObjListNames{"texcoord", "normal"};

/// The values of a list, three doubles each, in a file that is gone with them.
struct ObjValues {
  uint64_t count = 0;
  size_t columns = 0;                      ///< 1 .. 3 that lines have; what one leaves out is 0
  ScalarType type = ScalarType::kFloat32;  ///< of the numbers
  std::unique_ptr<ScratchFile> file;
};

/// Takes the numbers of one line after another. Throws Failure where the disk does not.
class ObjValueWriter {
 public:
  /// scan: what a failure names, when its first line comes.
  void Add(const std::array<double, 3>& values, size_t columns, const MappedFile& scan) {
    if (values_.file == nullptr) {
      values_.file = std::make_unique<ScratchFile>(TemporaryFolder(), scan.path());
    }
    ++values_.count;
    values_.columns = std::max(values_.columns, columns);
    const auto* bytes = reinterpret_cast<const uint8_t*>(values.data());
    buffer_.insert(buffer_.end(), bytes, bytes + sizeof values);
    if (buffer_.size() >= kBuffer) Flush();
  }
  ObjValues Take() {
    Flush();
    return std::move(values_);
  }
  uint64_t count() const { return values_.count; }

 private:
  static constexpr size_t kBuffer = size_t{1} << 18;
  void Flush() {
    if (!buffer_.empty()) values_.file->Append(buffer_);
    buffer_.clear();
  }

  ObjValues values_;
  std::vector<uint8_t> buffer_;
};

}  // namespace folprom::io
