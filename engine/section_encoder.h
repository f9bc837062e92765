// Codes how the scan stands in its file: the sections behind the last layer.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/mapped_space.h"
#include "engine/order/order_mesh.h"
#include "engine/partition/partition.h"
#include "io/container/file_table.h"
#include "io/formats/mesh_source.h"
#include "io/spill/spill.h"
#include "parallel/progress.h"

namespace folprom {

/// Which sections a scan has.
struct SectionChoice {
  bool order = false;
  bool polygons = false;
  bool face_values = false;
  bool is_soup = false;  ///< what the order is of

  bool any() const { return order || polygons || face_values; }
};

struct EncodedSections {
  std::optional<io::SectionRecord>& Section(io::SectionKind kind) {
    return records[static_cast<size_t>(kind)];
  }

  std::array<std::optional<io::SectionRecord>, io::kSectionKinds> records;
  uint64_t polygons = 0;                        ///< faces of the scan
  uint64_t largest_face = 0;                    ///< corners
  std::vector<io::AttributeRange> face_ranges;  ///< of the columns of the face schema
};

/// curve_places: subtree by subtree, the place of each vertex along the curve inside its subtree.
/// The blocks of the sections are left in the spill folder, see SectionFile. Failure kLimit: see
/// CheckOrderable.
EncodedSections EncodeSections(const SectionChoice& choice, const io::MeshSource& source,
                               const PartitionedScan& scan, const io::MappedFile& curve_places,
                               const io::SpillDirectory& spill, uint64_t memory_bytes,
                               parallel::Progress& progress);

/// The section as it stands in the file.
io::MappedFile SectionFile(const io::SpillDirectory& spill, io::SectionKind kind);

}  // namespace folprom
