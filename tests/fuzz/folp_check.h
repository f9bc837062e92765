// What must hold of the decoder for any bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace folprom::fuzz {

/// Makes every checksum that can be found fit the bytes before it, so that damage reaches what lies
/// behind the checksums.
void RepairChecksums(std::vector<uint8_t>* file);

/// Decodes all layers of the file with its checksums repaired. Empty where that ends in an error of
/// a fitting kind, or in meshes that are sound in themselves; else what is wrong.
std::string FaultOfFolp(std::span<const uint8_t> file);

}  // namespace folprom::fuzz
