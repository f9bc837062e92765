// Files and meshes for the tests of io.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/formats/mesh_source.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"

namespace folprom::io::testing {

using support::TemporaryFolder;

void WriteFile(const std::string& path, std::string_view bytes);
std::string FileContent(const std::string& path);

/// Lowers the largest size of a file that the process may write; a full disk for a test.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(uint64_t bytes);
  ~FileSizeLimit();

 private:
  uint64_t old_limit_;
};

struct Mesh {
  std::vector<double> xyz;
  std::vector<Triangle> triangles;
};

/// A file written with these bytes, then opened. Must not outlive the folder.
Result<std::unique_ptr<MeshSource>> OpenBytes(const TemporaryFolder& folder, std::string_view bytes,
                                              const std::string& name = "scan.ply");

/// All blocks; checks that they hold as many vertices and triangles as the source announces.
Result<Mesh> AllBlocks(const MeshSource& source);

/// Open and all blocks.
Result<Mesh> MeshOf(std::string_view bytes, const std::string& name = "scan.ply");

/// The message of the kInput error that opening and reading these bytes gives; "" where there is
/// none or one of another kind.
std::string InputErrorOf(std::string_view bytes, const std::string& name = "scan.ply");

/// A random decimal between -1000 and 1000.
std::string RandomDecimal(support::Random& random, int decimals);

/// The folder of shared scans, with a slash at its end; empty where there is none.
std::string SharedData();

}  // namespace folprom::io::testing
