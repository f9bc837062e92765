// Whole-file readers of OBJ, STL and OFF as anyone would write them, with no code of the project:
// what the streaming readers give must be what these give.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "support.h"

namespace folprom::io::testing {

/// Coordinates as floats or as doubles. Each throws std::runtime_error on what it does not know.
Mesh PlainObj(const std::string& text, bool as_float);
Mesh PlainOff(const std::string& text, bool as_float);
Mesh PlainTextStl(const std::string& text, bool as_float);
Mesh PlainBinaryStl(const std::string& bytes);
/// Geomview's order of bytes, with the number of colours behind a face, or that of other programs.
Mesh PlainBinaryOff(const std::string& bytes, bool geomview);

/// Expects that the bytes, read as a file of this name, have this type and are the mesh that
/// plain(as_float) gives.
template <class Plain>
void ExpectSameAsPlain(const std::string& bytes, const std::string& name, ScalarType type,
                       Plain plain) {
  const TemporaryFolder folder;
  const auto source = OpenBytes(folder, bytes, name).value();
  EXPECT_EQ(source->coordinate_type(), type);
  const Mesh mesh = AllBlocks(*source).value();
  const Mesh expected = plain(type == ScalarType::kFloat32);
  EXPECT_TRUE(mesh.xyz == expected.xyz);
  EXPECT_TRUE(mesh.triangles == expected.triangles);
}

}  // namespace folprom::io::testing
