// The programs that are compared: how each encodes and decodes a scan.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/peers/child_process.h"
#include "tests/bench/peers/mesh_file.h"

namespace folprom::peers {

/// One program with one setting. Files lie in a folder of their own.
struct Contender {
  std::string name;
  int bits = 0;          ///< along the longest side of the box; 0: positions exact
  double tolerance = 0;  ///< that decoded positions must keep, model units
  std::string file;      ///< encoded
  std::string mesh;      ///< decoded, PLY
  Command encode, decode;
  std::string encode_output, decode_output;  ///< files that standard output goes to, or empty
  Command convert;  ///< from what `decode` writes to `mesh`, not measured; empty: is a PLY
};

struct FolpromSetting {
  std::string name;    ///< empty: the defaults
  std::string config;  ///< a file, or empty
};

struct ContenderOptions {
  std::string folprom;  ///< program
  std::vector<FolpromSetting> settings;
  std::vector<int> bits;
};

/// Against which others are measured.
inline constexpr const char* kReference = "Draco -cl 10";

/// All contenders for a scan, folprom first; files go to `folder`.
std::vector<Contender> MakeContenders(const std::string& scan, const ScanSize& size,
                                      const std::string& folder, const ContenderOptions& options);

/// Throws Failure kUsage with the missing programs of other packages.
void CheckPrograms();

}  // namespace folprom::peers
