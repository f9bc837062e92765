// The keys of a job file: reading it and its documentation go by this table.
#pragma once

#include <string_view>
#include <vector>

#include "apps/batch/job_file.h"
#include "apps/folprom/config_keys.h"

namespace folprom::batch {

inline constexpr std::string_view kDefaults = "defaults";
inline constexpr std::string_view kJob = "job";
inline constexpr std::string_view kLods = "job.lods";

/// Keys of [defaults] or [[job]]: those of a job, then every one of `encode` by the same name.
std::vector<cli::Key> JobKeys(Job& job, std::string_view table);
/// Keys that stand in [defaults] only, for they are of the whole batch.
std::vector<cli::Key> BatchKeys(JobFile& file);
/// Keys of an entry of `lods`.
std::vector<cli::Key> LodKeys(Lod& lod);

}  // namespace folprom::batch
