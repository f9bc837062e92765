// Small meshes, files and folders that the hostile tests damage.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "folprom/decoder.h"
#include "folprom/folprom.h"
#include "io/container/file_table.h"
#include "tests/support/coders.h"
#include "tests/support/temporary_folder.h"

namespace folprom::hostile {

using Bytes = std::vector<uint8_t>;

using support::TemporaryFolder;

void WriteFile(const std::string& path, std::span<const uint8_t> bytes);
void WriteFile(const std::string& path, std::string_view text);
Bytes FileContent(const std::string& path);

struct TestMesh {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<uint32_t, 3>> faces;
};

/// A torus with relief, `rings` x `sides` vertices, and what no clean scan has: an isolated vertex,
/// a coincident one, a copied, a reversed and a degenerate face, an edge of three faces.
TestMesh RoughTorus(uint32_t rings, uint32_t sides);
/// A wavy sheet of side x side vertices.
TestMesh WavySheet(uint32_t side);

enum class PlyForm { kAscii, kLittleEndian, kBigEndian };
/// The mesh as the bytes of a PLY file of doubles.
std::string PlyBytes(const TestMesh& mesh, PlyForm form = PlyForm::kLittleEndian);

/// 9 bits; subtrees of `subtree_vertices` vertices.
EncodeOptions SmallOptions(uint32_t subtree_vertices = 100);
/// The same with the coder of the paper.
EncodeOptions LloydOptions(uint32_t subtree_vertices = 100);
/// The mesh as a .folp file, encoded serially.
Bytes Encoded(const TestMesh& mesh, const EncodeOptions& options);
/// RoughTorus of 302 vertices in four subtrees or more; encoded once per process and coder.
const Bytes& SmallFile(Hierarchy hierarchy);

/// A test of a small file of either coder.
class SmallFileTest : public ::testing::TestWithParam<support::Coder> {
 protected:
  static const Bytes& SmallFile() { return hostile::SmallFile(GetParam().settings.hierarchy); }
};

/// A level of detail that can be compared. Positions and faces in the order of the decoder.
struct Lod {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<uint64_t, 3>> faces;
  bool operator==(const Lod&) const = default;
};
/// The LOD after each layer that decodes; stops at the first error, which goes to *error (kUsage
/// when there was none).
std::vector<Lod> DecodeLods(std::span<const uint8_t> file, ErrorKind* error);

/// A .folp file taken apart, to be damaged and put together with right checksums.
struct Parts {
  io::FileTable table;
  std::vector<Bytes> segments;  ///< index FileTable::SegmentIndex
};
Parts TakeApart(std::span<const uint8_t> file);
/// Sets the sizes in the table from the segments.
Bytes PutTogether(Parts parts);

/// The folder of shared data, with a slash at its end; empty where there is none.
std::string SharedData();

}  // namespace folprom::hostile
