// A whole way there and back of a mesh, checked.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "tests/support/codec.h"
#include "tests/support/files.h"
#include "tests/support/ply.h"
#include "tests/support/same_mesh.h"

namespace folprom::support {

/// Returns the bytes of the file; expects that the mesh, of integers, comes back. Throws Failure.
inline uint64_t CodeLosslessly(const Mesh& mesh, const EncodeOptions& options) {
  TemporaryFolder folder;
  const std::string scan = folder.File("scan.ply"), folp = folder.File("scan.folp");
  WritePly(scan, mesh, CoordinateType::kInt);
  const EncodeReport report = Encode(scan, folp, options);
  const VerifyReport verified = Verify(folp, scan);
  EXPECT_TRUE(verified.lossless) << verified.reason;
  EXPECT_EQ(DifferenceOf(mesh, LodOf(folp), verified.tolerance), "");
  return report.bytes;
}

}  // namespace folprom::support
