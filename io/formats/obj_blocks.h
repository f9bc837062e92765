// One walk over an OBJ file: what does it hold, and where does each block begin.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "folprom/limits.h"
#include "io/files/mapped_file.h"
#include "io/formats/file_position.h"
#include "io/formats/indexed_source.h"
#include "io/formats/obj_statements.h"
#include "io/formats/obj_values.h"
#include "io/formats/text_cursor.h"

namespace folprom::io {

/// A block begins at a face; negative indices count back from what was read before.
struct ObjFaceBlock {
  FilePosition position;
  uint64_t vertices_before = 0;
  std::array<uint64_t, kObjLists> lists_before{};
  ObjState state{};
  uint64_t triangles = 0;
};

struct ObjBlocks {
  SourceIndex index;
  std::vector<FilePosition> vertices;  ///< of the first "v" of each block
  std::vector<ObjFaceBlock> faces;
  std::array<ObjValues, kObjLists> values;  ///< where corners of faces name them
  ObjNames names{0};
};

/// Is the word one that a line of an OBJ file can begin with.
bool IsObjKeyword(std::string_view word);

/// Steps over a line that is not coded, from behind its keyword. A name may end in a backslash, as
/// a folder of Windows does; on any other line it joins the next one.
void SkipObjLine(std::string_view keyword, TextCursor& cursor);

/// Steps over a line of kObjStatements, from behind its keyword, in the same way; its name.
std::string_view TakeObjName(std::string_view keyword, TextCursor& cursor);

/// Walks the file once, with a bounded resident size. Throws Failure kInput, with the line, for an
/// unknown keyword and for vertices that are none; indices are not looked at.
ObjBlocks IndexObjBlocks(const MappedFile& file, const Limits& limits);

}  // namespace folprom::io
