// Meshes for the measurements: a file read whole, or only its size and box.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace folprom::peers {

using Point = std::array<double, 3>;
using Triple = std::array<uint32_t, 3>;

struct Mesh {
  std::vector<Point> positions;  ///< model units
  std::vector<Triple> faces;
};

/// What can be said of a scan without keeping it in memory.
struct ScanSize {
  uint64_t vertices = 0;
  uint64_t faces = 0;
  double longest_side = 0;        ///< of the bounding box, model units
  double largest_coordinate = 0;  ///< absolute value, model units
};

/// PLY of any kind. Throw Failure: kInput, kLimit (2^32 - 1 vertices).
Mesh ReadMesh(const std::string& path);
ScanSize MeasureScan(const std::string& path);

/// Binary little-endian PLY of floats. Throws Failure kOutput.
void WriteMesh(const std::string& path, const Mesh& mesh);

/// Throw Failure kInput and kOutput.
std::vector<uint8_t> ReadBytes(const std::string& path);
void WriteBytes(const std::string& path, const std::vector<uint8_t>& bytes);

}  // namespace folprom::peers
