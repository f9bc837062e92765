// What an input may ask for.
#pragma once

#include <cstdint>

namespace folprom {

/// An input that is larger than these is refused with kLimit before anything is made for it; of the
/// comments, what goes beyond is dropped with a warning. They are far above what scans have: they
/// are for inputs that lie. None alters what comes of an input that keeps them.
struct Limits {
  /// Resident size to stay below: fewer subtrees are then worked on at once, but always one, with
  /// the subtrees around it while its seam is coded.
  uint64_t memory_bytes = uint64_t{2} << 30;
  uint64_t vertices = 10'000'000'000;           ///< of a scan, or of the scan in a file
  uint64_t faces = 20'000'000'000;              ///< the same, as triangles
  uint64_t properties = 100'000;                ///< of all elements of a PLY
  uint64_t header_bytes = uint64_t{1} << 20;    ///< of a PLY
  uint64_t comment_bytes = uint64_t{64} << 10;  ///< kept, of all lines; the format holds 16 MiB
};

}  // namespace folprom
