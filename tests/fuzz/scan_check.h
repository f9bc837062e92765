// What must hold of the readers of mesh files for any bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace folprom::fuzz {

struct ScanOutcome {
  bool is_mesh = false;  ///< read to its end
  std::string error;     ///< that the reader gave; empty with a mesh
  /// What is wrong: a mesh that contradicts itself, an error of another kind than kInput or kLimit
  /// or without the file's name. Empty where nothing is.
  std::string fault;
};

/// Opens the file and reads all of its blocks.
ScanOutcome ReadScan(const std::string& path);
/// The same of bytes; `name` is for messages, and its ending may tell the format.
ScanOutcome ReadScanBytes(std::span<const uint8_t> bytes, const std::string& name);

/// As an input of the fuzzer of text formats: the first byte, o, s, f or another one, chooses the
/// ending .obj, .stl, .off or none; the file follows.
ScanOutcome ReadTextInput(std::span<const uint8_t> input);

}  // namespace folprom::fuzz
