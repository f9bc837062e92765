#include "io/formats/mesh_source.h"

#include <algorithm>
#include <utility>

#include "io/files/mapped_file.h"
#include "io/formats/mesh_format.h"
#include "io/formats/obj_blocks.h"
#include "io/formats/obj_source.h"
#include "io/formats/off_source.h"
#include "io/formats/ply_header.h"
#include "io/formats/ply_source.h"
#include "io/formats/stl_source.h"
#include "io/formats/text_cursor.h"
#include "io/limit_check.h"
#include "io/result_of.h"

namespace folprom::io {
namespace {

/// No text of a mesh has a NUL; a binary STL has some in its normals, its corners or its header.
bool LooksBinary(const MappedFile& file) {
  const std::span<const uint8_t> head =
      file.bytes().first(std::min<size_t>(file.bytes().size(), 4096));
  return std::ranges::find(head, uint8_t{0}) != head.end();
}

std::unique_ptr<MeshSource> OpenStl(MappedFile file) {
  const bool is_text = !HasBinaryStlSize(file.bytes()) && !LooksBinary(file);
  return is_text ? OpenTextStlSource(std::move(file)) : OpenBinaryStlSource(std::move(file));
}

std::unique_ptr<MeshSource> OpenByEnding(MappedFile file, const Limits& limits) {
  switch (FormatByEnding(file.path()).value_or(MeshFormat::kPly)) {
    case MeshFormat::kObj:
      return OpenObjSource(std::move(file), limits);
    case MeshFormat::kStl:
      return OpenStl(std::move(file));
    case MeshFormat::kOff:
      return OpenOffSource(std::move(file));
    case MeshFormat::kPly:  // which its content would have told
      break;
  }
  throw Failure(ErrorKind::kInput,
                file.path() + ": unsupported format (known formats: PLY, OBJ, STL, OFF)");
}

std::unique_ptr<MeshSource> OpenByContent(MappedFile file, const Limits& limits) {
  if (file.bytes().empty()) throw Failure(ErrorKind::kInput, file.path() + ": the file is empty");
  if (HasPlyMagic(file.bytes())) return OpenPlySource(std::move(file), limits);
  if (HasBinaryStlSize(file.bytes())) return OpenBinaryStlSource(std::move(file));
  // The first word that is no comment; a long first line need not be looked at further.
  TextCursor cursor(file, {0, 1});
  const std::string_view word = cursor.NextWordLine() ? cursor.Word() : std::string_view();
  if (IsOffKeyword(word)) return OpenOffSource(std::move(file));
  if (EqualsIgnoringCase(word, "solid")) return OpenStl(std::move(file));
  // The keywords of OBJ are words of any text: a damaged file of another format may begin so.
  if (IsObjKeyword(word) && !FormatByEnding(file.path()))
    return OpenObjSource(std::move(file), limits);
  return OpenByEnding(std::move(file), limits);
}

}  // namespace

Result<std::unique_ptr<MeshSource>> MeshSource::Open(const std::string& path,
                                                     const Limits& limits) {
  return ResultOf([&] { return OfMapped(MappedFile::Open(path).value(), limits).value(); });
}

Result<std::unique_ptr<MeshSource>> MeshSource::OfMapped(MappedFile file, const Limits& limits) {
  return ResultOf([&] {
    std::unique_ptr<MeshSource> source = OpenByContent(std::move(file), limits);
    CheckLimit(source->path(), source->vertex_count(), limits.vertices, "vertices");
    CheckLimit(source->path(), source->triangle_count(), limits.faces, "faces");
    return source;
  });
}

}  // namespace folprom::io
