// Files that the folprom program makes, so that this one needs no encoder.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "folprom/decoder.h"
#include "tests/support/temporary_folder.h"

namespace folprom::decode_library {

/// A synthetic scan and its .folp file in a folder of their own, removed at the end.
class ProgramFiles {
 public:
  /// Throws std::runtime_error when the program fails.
  ProgramFiles();

  std::vector<uint8_t> FolpBytes() const;
  /// What the program decodes of the first `layers` layers.
  DecodedMesh DecodedByProgram(size_t layers) const;

 private:
  std::string File(const std::string& name) const { return folder_.File(name); }
  support::TemporaryFolder folder_;
};

/// Runs a program, gives its standard output; throws std::runtime_error unless it exits with 0.
std::string OutputOf(const std::vector<std::string>& command);

}  // namespace folprom::decode_library
