// The calls of the program as tests make them: errors are thrown, temporary files stay beside the
// output.
#pragma once

#include <string>
#include <vector>

#include "folprom/folprom.h"
#include "parallel/runner.h"
#include "tests/support/mesh.h"

namespace folprom::support {

/// runner: null for a serial one. All throw Failure.
EncodeReport Encode(const std::string& scan, const std::string& folp, EncodeOptions options,
                    parallel::Runner* runner = nullptr);
DecodeReport Decode(const std::string& folp, const std::string& ply, DecodeOptions options = {},
                    parallel::Runner* runner = nullptr);
/// original: empty to compare with the digest only.
VerifyReport Verify(const std::string& folp, const std::string& original,
                    parallel::Runner* runner = nullptr);

/// The mesh after each layer, by the decoder that works from memory alone.
std::vector<Mesh> EveryLod(const std::string& folp);
/// The mesh after `layers` layers, 0 for all.
Mesh LodOf(const std::string& folp, size_t layers = 0);

}  // namespace folprom::support
