// Whole files, and the shared scans.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace folprom::support {

std::vector<uint8_t> FileBytes(const std::string& path);
void WriteBytes(const std::string& path, std::string_view bytes);

/// A file of the shared scans, such as "scans/igea.ply"; empty where it is missing.
std::string SharedFile(const std::string& name);
/// Every PLY of scans/ and hard/, as names for SharedFile, sorted; empty where there are none.
std::vector<std::string> SharedScans();
inline constexpr const char* kNoSharedData =
    "the shared scans are missing; FOLPROM_SHARED names their folder";

/// Do the sanitizers slow this build down so much that only small scans are worth it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace folprom::support
