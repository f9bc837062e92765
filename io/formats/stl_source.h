// STL files, binary and text, as a MeshSource: a soup, three vertices a facet in file order.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "io/files/mapped_file.h"
#include "io/formats/mesh_source.h"

namespace folprom::io {

/// Is there a facet, and does the size agree with the number of them where a binary file has it. A
/// text file has characters there, and would have to be 27 GB large.
bool HasBinaryStlSize(std::span<const uint8_t> bytes);

/// Throws Failure kInput where the size does not agree with the number of facets, but for less than
/// a facet too much, which is noted.
std::unique_ptr<MeshSource> OpenBinaryStlSource(MappedFile file);

/// Throws Failure kInput, with the line.
std::unique_ptr<MeshSource> OpenTextStlSource(MappedFile file);

}  // namespace folprom::io
