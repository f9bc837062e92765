// Everything that decides the bytes of a .folp file, and nothing that does not.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "folprom/limits.h"
#include "folprom/result.h"

namespace folprom {

enum class Hierarchy : uint8_t {
  kLloyd = 0,   ///< top-down vertex set split, section 2.1
  kQuadric = 1  ///< bottom-up contraction by quadric error; two children a split
};

enum class Offsets : uint8_t {
  kCylindrical = 0,  ///< rho, theta, z in the least-squares frame, section 2.2
  kCartesian = 1,    ///< x, y, z in the same frame, with which the paper compares
  kLattice = 2       ///< exact integers, predicted from the ring; needs Hierarchy::kQuadric
};

enum class Representative : uint8_t {
  kCurvature = 0,  ///< vertex of high curvature near the centre where curvature varies, else centre
  kCentre = 1,     ///< always the centre
  kQuadric = 2     ///< the point nearest to the tangent planes of the set's vertices
};

enum class Models : uint8_t {
  kFull = 0,  ///< all that triangles look like
  kLight = 1  ///< a few tables: faster
};

/// Settings of the coder. The same values and the same scan give the same bytes. Each field is a
/// key of the [codec] table of a config file, by the same name.
struct CodecSettings {
  Hierarchy hierarchy = Hierarchy::kQuadric;
  Offsets offsets = Offsets::kLattice;

  uint32_t subtree_vertices = 147456;  ///< largest subtree; 1 .. 16,777,216
  /// Subtrees are cut by the metric of section 2.1. false: by Euclidean distance, which makes them
  /// compact: on dragon half the cross faces, 60 % fewer bits for seams, 0.7 % fewer in all.
  bool subtree_normals = false;

  // Hierarchy (quadric)
  double length_weight = 0.015;  ///< of area x length^2 beside the quadric error; 0 .. 10

  // Hierarchy (section 2.1)
  uint32_t children = 4;           ///< K, children of a split; 2 .. 8
  bool normal_metric = true;       ///< w_n as in the paper; false: Euclidean distance
  double metric_a = 1;             ///< a; 0 .. 1
  double metric_b = 4;             ///< b; 1 .. 64
  uint32_t lloyd_iterations = 12;  ///< at most this many; 1 .. 100
  double lloyd_threshold = 0.01;   ///< stop when distortion falls by less than this part; 0 .. 1
  Representative representative = Representative::kQuadric;
  double curvature_threshold = 0.1;  ///< T_c; 0 .. 1
  double gaussian_ratio = 3;         ///< r_g; 0.01 .. 100

  // Offsets (sections 2.2 - 2.4)
  uint32_t quantisation_levels = 16;  ///< Q; 2 .. 4096
  bool adaptive_quantisation = true;  ///< G_rho = R_rho/Q, G_z = R_z/Q; false: one step for both
  bool predict_theta = true;          ///< section 2.3
  bool predict_height = true;         ///< section 2.3
  bool split_first = true;            ///< sets of more than one vertex first; then refinement
  /// Up to this part of a subtree's vertices sets are split by distortion, flagged; then by
  /// spacing.
  double distortion_first = 0.05;

  // Connectivity (section 3)
  /// A split of a disc or half disc of faces into two such is told by its place among all of them,
  /// the likeliest first; flags are for all other splits. false: flags only.
  bool fan_cuts = true;
  bool pivot_order = true;   ///< flags in order of regularity; false: by vertex id
  bool nearer_child = true;  ///< side flags relative to the nearer child

  /// Offsets::kLattice: models start from what other meshes taught them. false: from nothing.
  bool trained = true;

  // Layers
  uint32_t steps_per_octave = 4;  ///< steps per halving of the spacing; 1 .. 8
  /// Vertices that a layer is expected to add; smaller ones are joined. 0 .. 1000000; 0: none.
  uint32_t least_layer = 100;
  uint32_t step_parts = 4;  ///< most layers that a step is; 1 .. 8
  /// Largest spacing first, in this many rounds a step, at least one a layer; 1 .. 16.
  uint32_t rounds_per_step = 4;

  // Effort
  /// 1 fastest .. 9 smallest. A record of what WithEffort was asked for; it decides nothing itself.
  uint32_t effort = 5;
  /// Offsets::kLattice: between cells of the density of new vertices over the tangent plane, in
  /// twentieths of the spacing; 1 .. 4, 0: no density.
  uint32_t density_step = 2;
  uint32_t mixers = 2;  ///< Offsets::kLattice: how many mixers a decision averages; 1 .. 3
  Models models = Models::kFull;  ///< what cuts and positions are predicted from

  /// Offsets::kLattice: vertices of LODs are drawn off the mesh, on the outer side of its bends,
  /// where their faces are nearest to it. false: at vertices of the mesh.
  bool lod_fit = true;
};

/// The settings with those that effort (1 .. 9, others are left to CheckSettings) stands for:
/// subtree_vertices, density_step, mixers, models, step_parts, rounds_per_step, length_weight,
/// distortion_first, and effort itself.
CodecSettings WithEffort(CodecSettings settings, uint32_t effort);

/// kUsage with the name of the first field out of its range.
Result<void> CheckSettings(const CodecSettings& settings);

/// Error bounds of larger tolerances would not fit into a float.
inline constexpr double kLargestTolerance = 1e37;

/// What `encode` is asked for.
struct EncodeOptions {
  CodecSettings codec;
  /// Lattice bits N: tolerance = longest box side / (2^N - 1) / 2. 1 .. 24. Used when tolerance ==
  /// 0.
  uint32_t bits = 12;
  /// Largest error per axis in model units, up to kLargestTolerance; 0: from `bits`.
  double tolerance = 0;
  /// Positions come back bit for bit: floats and doubles, also -0.0, infinities and NaN. `bits` and
  /// `tolerance` are not used. Needs Offsets::kLattice.
  bool exact = false;
  /// What vertices have beside x, y and z, and faces and their corners beside vertices, comes back
  /// bit for bit with Offsets::kLattice; comments come back with any. false: they are dropped.
  bool attributes = true;
  /// "NAME=N": a float attribute of the vertices is rounded to 2^N values, evenly over its range; N
  /// is 1 .. 24. "normal" stands for nx, ny and nz. All others come back bit for bit.
  std::vector<std::string> attribute_bits;
  /// Vertices and faces come back in the scan's order, and each face with its first corner first;
  /// no more than 1,431,655,765 of either. Only with Offsets::kLattice.
  bool keep_order = false;
  /// Vertices whose coordinates have the same bits become one; in scans whose vertices have no
  /// attributes that are kept. false: they come back, each where it was.
  bool weld = false;
  Limits limits;                 ///< of the scan; the memory never alters bytes
  std::string temporary_folder;  ///< empty: $TMPDIR or /tmp
  bool overwrite = false;        ///< may replace the output
};

/// CheckSettings of the codec, the ranges of `bits` and `tolerance`, and whether the options go
/// together. kUsage.
Result<void> CheckOptions(const EncodeOptions& options);

/// What `decode` is asked for. At most one of the bounds is set; none: everything.
struct DecodeOptions {
  double bits_per_vertex = 0;  ///< > 0: as many whole layers as fit into this rate (at least one)
  double max_error = 0;        ///< > 0: first layer whose error bound is at most this; else all
  uint64_t max_vertices = 0;   ///< > 0: last layer with at most this many vertices (at least one)
  uint32_t layers = 0;         ///< > 0: this many layers
  bool use_region = false;  ///< only the vertices inside the box, and faces with all three inside
  double region_lo[3] = {0, 0, 0};
  double region_hi[3] = {0, 0, 0};
  Limits limits;  ///< of the file, and of a scan that it is compared with
  std::string temporary_folder;
  bool overwrite = false;
};

}  // namespace folprom
