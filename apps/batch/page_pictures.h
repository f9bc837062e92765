// The pictures of a batch's page: of each scan three levels of detail and the scan itself.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/batch/file_stamp.h"
#include "apps/batch/scan_results.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom::batch {

struct PagePicture {
  std::string title;         ///< "1,004 vertices"
  std::string caption;       ///< "0.17 bits per vertex, 2.7 KiB", or empty
  std::vector<uint8_t> png;  ///< empty where there is none
  std::string problem;       ///< why there is none
};

struct PictureSettings {
  std::string folder;            ///< keeps pictures from run to run; made where it is missing
  std::string temporary_folder;  ///< empty: $TMPDIR or /tmp
  uint64_t memory_bytes = 0;     ///< that drawing one may take
  uint32_t width = 400, height = 320;
};

/// One list for each of the scans. A picture whose file, level and program are the same as in an
/// earlier run is taken from the folder; what the folder holds besides is removed from it. A
/// picture that cannot be drawn says so; so do all that are left after a cancellation. Throws
/// Failure kOutput where the folder cannot be made.
std::vector<std::vector<PagePicture>> PicturesOf(const std::vector<ScanResults>& scans,
                                                 const PictureSettings& settings, HashCache* hashes,
                                                 parallel::Runner& runner,
                                                 parallel::Progress& progress);

}  // namespace folprom::batch
