// Are decoded coordinates and attributes those of a scan.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "engine/folp_file.h"
#include "folprom/folprom.h"

namespace folprom {

/// Are the values of vertices those of a scan: those that are rounded within half a step, the
/// others bit by bit. Both as MeshSource::ReadVertexAttributes gives them.
bool AreValuesAlike(const io::FileTable& table, std::span<const uint8_t> decoded,
                    std::span<const uint8_t> original);
/// The reason where they are not.
std::string AttributesDiffer(const io::FileTable& table);
/// Counts in the report what AreValuesAlike compared.
void CountAttributes(const io::FileTable& table, VerifyReport* report);

/// How far a decoded coordinate is from the scan's, and whether their bits differ.
struct CoordinateCheck {
  explicit CoordinateCheck(const FolpFile& file)
      : is_float(static_cast<ScalarType>(file.table().coordinate_type) == ScalarType::kFloat32) {}
  void Add(double decoded, double original);
  /// The reason of the report, where the scan is not what the file promises of it.
  static void Judge(const FolpFile& file, bool same_bits, VerifyReport* report);

  bool is_float;
  bool same_bits = true;
  double largest_error = 0;  ///< infinite where either is not finite
};

}  // namespace folprom
