// Builds PLY files in any format, value by value.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/formats/ply_header.h"

namespace folprom::io::testing {

inline constexpr PlyFormat kAllFormats[] = {PlyFormat::kAscii, PlyFormat::kBinaryLittleEndian,
                                            PlyFormat::kBinaryBigEndian};

class PlyBuilder {
 public:
  explicit PlyBuilder(PlyFormat format);

  /// A line of the header; its end is added.
  PlyBuilder& Header(std::string_view line);
  /// Ends the header.
  PlyBuilder& Body();
  PlyBuilder& Value(ScalarType type, double value);
  PlyBuilder& List(ScalarType count_type, ScalarType type, const std::vector<double>& items);
  /// Ends the record (a line end in text).
  PlyBuilder& End();

  const std::string& bytes() const { return bytes_; }

 private:
  PlyFormat format_;
  bool line_begins_ = true;
  std::string bytes_;
};

/// The names of the types of the header in the first ("uchar") or second ("uint8") family.
std::string TypeName(ScalarType type, bool second_family);

/// Four vertices, a triangle, a dropped face of two corners, a quad; extra properties in vertices
/// and faces; an extra element with lists before, between and behind.
std::string MixedFile(PlyFormat format);

/// What MixedFile holds.
std::vector<double> MixedPositions();
std::vector<Triangle> MixedTriangles();

}  // namespace folprom::io::testing
