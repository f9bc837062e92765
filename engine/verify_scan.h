// Is a decoded mesh that of a scan.
#pragma once

#include <string>

#include "engine/folp_file.h"
#include "folprom/folprom.h"
#include "parallel/progress.h"
#include "parallel/runner.h"

namespace folprom {

/// Compares a whole file with the scan at `original`, whatever the order of either; the reason of
/// the report tells what differs. Throws Failure, kInput where the scan has been written meanwhile.
void CompareWithScan(const FolpFile& file, const std::string& original,
                     const DecodeOptions& options, parallel::Runner& runner,
                     parallel::Progress& progress, VerifyReport* report);

}  // namespace folprom
