// The summed normal of every voxel.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/partition/job.h"
#include "io/files/mapped_file.h"

namespace folprom::partition {

/// Sum of the unit normals of the faces at the vertices of a voxel, each in steps of 2^-15. A face
/// counts once per corner; a face without area does not count.
using NormalSum = std::array<int64_t, 3>;

/// `records`: a mapped VertexRecord per vertex. Reads all triangles; one NormalSum per voxel.
std::vector<NormalSum> CollectNormals(Job& job, const io::MappedFile& records, size_t voxel_count);

}  // namespace folprom::partition
