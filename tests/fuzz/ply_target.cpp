// The reader of PLY.
#include "tests/fuzz/scan_check.h"
#include "tests/fuzz/target.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return folprom::fuzz::RunTarget(data, size, [](std::span<const uint8_t> input) {
    return folprom::fuzz::ReadScanBytes(input, "scan.ply").fault;
  });
}
