// The whole program as four calls: encode, decode, info, verify. Files in, files out. Runners and
// Progress are in parallel/runner.h and progress.h, installed as folprom/parallel/.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "folprom/attribute.h"
#include "folprom/result.h"
#include "folprom/settings.h"

namespace folprom::parallel {
class Runner;
class Progress;
}  // namespace folprom::parallel

namespace folprom {

/// What a file's bits were spent on, by what they tell. The kinds of FileInfo are sums of these.
struct BitCounts {
  double split = 0;                            ///< how many children
  double root = 0, theta = 0, rho = 0, z = 0;  ///< where they lie; Cartesian: theta is x, rho is y
  double refinement = 0;
  double connected = 0, pivots = 0, sides = 0;  ///< connectivity inside subtrees
  double exceptions = 0, seams = 0;
  double rests = 0;       ///< what the lattice of an exact encoding leaves over
  double attributes = 0;  ///< of the vertices, but for those of each subtree's first vertex
};

/// What a file keeps of its scan behind the last layer.
struct SectionInfo {
  bool is_kept = false;
  uint64_t bytes = 0;  ///< unknown, 0, where the last table is missing
};

/// Outcome of EncodeFile. Warnings are sentences for the user (polygons triangulated, properties
/// not coded, ...).
struct EncodeReport {
  uint64_t vertices = 0;  ///< that are coded; of a scan that was welded, those that are left
  uint64_t faces = 0;
  uint64_t scan_vertices = 0;  ///< before
  bool is_soup = false;        ///< they come back
  uint64_t bytes = 0;
  /// Of these, what the order, the polygons and the attributes of faces take.
  uint64_t order_bytes = 0, polygon_bytes = 0, face_attribute_bytes = 0;
  uint64_t subtrees = 0;
  uint64_t layers = 0;
  uint64_t spill_bytes = 0;               ///< temporary disk used at the peak
  uint64_t resumed_subtrees = 0;          ///< taken over from an interrupted call
  BitCounts bits;                         ///< over the whole file, without rounding to bytes
  std::vector<AttributeInfo> attributes;  ///< of the vertices, that were kept
  std::vector<FaceAttributeInfo> face_attributes;  ///< that were kept
  std::vector<std::string> warnings;
};

/// What becomes of the work of a call that is cancelled or killed.
enum class Resume : uint8_t {
  kNever = 0,  ///< a cancelled call leaves nothing
  /// Once the scan is cut into subtrees the call leaves its temporary files, and the same call
  /// (scan, output, temporary folder) goes on from them where scan, settings and program are the
  /// same and the files undamaged. They go when a call ends otherwise.
  kContinue = 1,
  kRestart = 2  ///< as kContinue, but what an earlier call left is removed unused
};

/// Encodes a scan. Same bytes for every runner and memory limit. Errors: kUsage (settings), kInput,
/// kOutput, kLimit, kInterrupted; nothing is left behind after an error, but for what
/// `resume` says. kOutput before any work where the disk has no room for temporary files or output.
Result<EncodeReport> EncodeFile(const std::string& input, const std::string& output,
                                const EncodeOptions& options, parallel::Runner& runner,
                                parallel::Progress& progress, Resume resume = Resume::kNever);

/// What an encoding will take, from the size of the scan and a sample of it.
struct EncodeEstimate {
  uint64_t vertices = 0;
  uint64_t faces = 0;
  uint64_t memory_bytes = 0;  ///< resident at the peak; at most the limit where that can be kept
  uint64_t spill_bytes = 0;   ///< temporary disk at the peak; within a tenth
  uint64_t file_bytes = 0;    ///< of the output; within a factor of two for most scans
  double seconds = 0;         ///< by how long this machine takes for a small surface, now
};

/// Errors: kUsage, kInput, kLimit, kInterrupted.
Result<EncodeEstimate> EstimateEncode(const std::string& input, const EncodeOptions& options,
                                      parallel::Runner& runner, parallel::Progress& progress);

struct DecodeReport {
  uint64_t vertices = 0;
  uint64_t faces = 0;
  uint64_t layers = 0;        ///< decoded
  uint64_t layers_total = 0;  ///< in the file as announced
  bool complete = false;      ///< the whole mesh came back
  /// Of the table and the decoded segments. Checksums, and what else they cover, are read besides.
  uint64_t bytes_read = 0;
  double error_bound = 0;             ///< of the last decoded layer, model units
  std::vector<std::string> warnings;  ///< for instance "file is cut after layer 12 of 30"
};

/// Decodes to a mesh file of the format that the ending of `output` names: .ply (binary), .obj,
/// .stl (binary) or .off; kUsage for any other. The warnings name what that format does not hold.
/// Errors: kUsage, kInput, kCorrupt, kOutput, kLimit, kInterrupted.
Result<DecodeReport> DecodeFile(const std::string& input, const std::string& output,
                                const DecodeOptions& options, parallel::Runner& runner,
                                parallel::Progress& progress);

struct LayerInfo {
  uint64_t bytes = 0;          ///< of this layer alone
  uint64_t end_byte = 0;       ///< of the file up to and with this layer
  uint64_t vertices = 0;       ///< of the LOD
  uint64_t faces = 0;          ///< of the LOD
  double error_bound = 0;      ///< model units
  double bits_per_vertex = 0;  ///< rate up to and with this layer, whole file prefix
};

/// The lattice of a file that gives back its scan bit for bit.
struct ExactInfo {
  bool is_float = false;   ///< binary32, else binary64
  uint32_t radix = 10;     ///< 10 or 2
  int32_t exponent = 0;    ///< the step is radix^-exponent
  double bits = 0;         ///< of a lattice coordinate along the longest side
  bool has_rests = false;  ///< not every coordinate lies on the lattice
};

struct FileInfo {
  uint32_t format_version = 0;
  uint64_t vertices = 0;
  uint64_t faces = 0;          ///< triangles
  uint64_t bytes = 0;          ///< as announced; of a cut file, as far as its tables are there
  uint64_t bytes_present = 0;  ///< fewer when the file is cut
  uint64_t layers_present = 0;
  uint64_t layers_total = 0;
  uint64_t subtrees = 0;
  std::optional<double> tolerance;  ///< unknown where the last table is missing
  std::optional<ExactInfo> exact;
  std::array<double, 3> box_lo{}, box_hi{};
  CodecSettings codec;
  std::vector<AttributeInfo> attributes;  ///< of the vertices; without bits unless has_bits
  std::vector<std::string> remarks;       ///< lines "comment" and "obj_info" of the scan
  /// The scan's faces share no vertices: it has 3 `faces` of them, of which those of equal bits are
  /// one in `vertices` and in the layers.
  bool is_soup = false;
  SectionInfo order;        ///< of vertices and faces, and the first corner of each face
  SectionInfo polygons;     ///< faces of more than three corners
  SectionInfo face_values;  ///< attributes of faces and their corners
  std::vector<FaceAttributeInfo> face_attributes;
  uint64_t scan_faces = 0;        ///< where any of these is kept, and the last table is there
  std::vector<LayerInfo> layers;  ///< whose table is there
  bool has_bits = false;          ///< what follows is known: the last table is there
  /// Bits per vertex of the original by kind.
  double split = 0, offsets = 0, refinement = 0, connectivity = 0, exceptions = 0, seams = 0;
  uint64_t table_bytes = 0, checksum_bytes = 0, flush_bytes = 0;
  double overhead = 0;  ///< (tables + checksums + flushes) / bytes
};

/// limits: of the mesh in the file.
Result<FileInfo> ReadInfo(const std::string& input, const Limits& limits = {});

struct VerifyReport {
  bool lossless = false;
  bool against = false;  ///< an original was compared
  /// Largest |difference| on one axis, model units (against only); infinite where it is not finite.
  double max_position_error = 0;
  double tolerance = 0;
  uint64_t vertices = 0;
  uint64_t faces = 0;
  uint64_t attributes = 0;          ///< of the vertices, that were compared (against only)
  uint64_t rounded_attributes = 0;  ///< of these, that are within half a step, not bit by bit
  uint64_t face_attributes = 0;     ///< of the faces, that were compared
  bool order_kept = false;          ///< vertices and faces come back in the scan's order
  bool welded = false;  ///< the file is of what is left when the original is welded (against only)
  std::string reason;   ///< why not lossless; empty otherwise
};

/// Decodes everything and compares it with the digest of the file and, when `original` is not
/// empty, vertex by vertex and face by face with that scan, in its order where the file keeps it:
/// of an exact file, and attributes in any, bit by bit. What an encoding left out by its settings
/// is not compared. A cut file is not lossless.
Result<VerifyReport> VerifyFile(const std::string& input, const std::string& original,
                                const DecodeOptions& options, parallel::Runner& runner,
                                parallel::Progress& progress);

}  // namespace folprom
