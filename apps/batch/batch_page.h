// A batch as one page of HTML that needs no other file.
#pragma once

#include <string>
#include <vector>

#include "apps/batch/batch_report.h"
#include "apps/batch/page_pictures.h"

namespace folprom::batch {

/// `pictures`: one list for each of ByScan(report). Text of any kind is escaped, nothing outside
/// the page is referred to, and there is no script.
std::string PageOf(const BatchReport& report,
                   const std::vector<std::vector<PagePicture>>& pictures);

/// Writes `folder`/report.html. Where `with_pictures`, draws first what is not kept in
/// `folder`/pictures yet. Throws Failure kOutput.
void WriteBatchPage(const BatchReport& report, const std::string& folder,
                    const std::string& temporary_folder, bool with_pictures, HashCache* hashes,
                    parallel::Runner& runner, parallel::Progress& progress);

}  // namespace folprom::batch
