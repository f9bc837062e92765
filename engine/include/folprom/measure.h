// How far a mesh lies from another, and what a file gives for its bits. Library folprom_measure.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "folprom/result.h"
#include "folprom/settings.h"

namespace folprom::parallel {
class Runner;
class Progress;
}  // namespace folprom::parallel

namespace folprom {

/// Distances from the points of one surface to the nearest points of another, model units.
struct DistanceStatistics {
  double mean = 0;  ///< over the area
  double rms = 0;   ///< over the area
  double max = 0;   ///< over area, edges and vertices
};

/// Two surfaces compared in both directions.
struct Comparison {
  DistanceStatistics forward;   ///< from A to B
  DistanceStatistics backward;  ///< from B to A
  double diagonal = 0;          ///< of the bounding box of all vertices of A, model units
  uint64_t samples = 0;         ///< on the area of each surface; edges and vertices come on top
};

struct CompareOptions {
  uint64_t samples = 0;          ///< 0: ten per face of the finer mesh, 500,000 .. 10,000,000
  std::string temporary_folder;  ///< for the decoded .folp files; empty: $TMPDIR or /tmp
  Limits limits;                 ///< of both meshes
};

/// Compares two mesh or .folp files. The surface is the faces; of a mesh without faces, the
/// vertices. Same result for every runner. Errors: kInput (also a mesh without vertices, or with
/// one that is not finite), kCorrupt, kLimit (2^32 - 1 vertices or faces), kInterrupted.
Result<Comparison> CompareFiles(const std::string& a, const std::string& b,
                                const CompareOptions& options, parallel::Runner& runner,
                                parallel::Progress& progress);

/// What the layers that fit into a rate give. Bits are per vertex of the original.
struct RatePoint {
  double requested = 0;        ///< rate that was asked for
  double bits_per_vertex = 0;  ///< rate of the layers decoded, all bytes up to their end
  uint64_t bytes = 0;
  uint64_t layers = 0;
  uint64_t vertices = 0;
  uint64_t faces = 0;
  Comparison comparison;  ///< A is the original
};

struct RateCurve {
  uint64_t vertices = 0;  ///< of the original
  uint64_t faces = 0;     ///< of the original
  uint64_t bytes = 0;     ///< of the whole file
  std::vector<RatePoint> points;
  std::vector<std::string> warnings;
};

/// Encodes the scan once, decodes it at each of the rates (all above 0) and compares it with the
/// original; `samples` as in CompareOptions. Errors: those of EncodeFile and CompareFiles.
Result<RateCurve> MeasureRates(const std::string& scan, const EncodeOptions& options,
                               std::span<const double> rates, uint64_t samples,
                               parallel::Runner& runner, parallel::Progress& progress);

}  // namespace folprom
