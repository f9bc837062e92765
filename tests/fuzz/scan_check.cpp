#include "tests/fuzz/scan_check.h"

#include <sys/mman.h>
#include <unistd.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "io/files/mapped_file.h"
#include "io/files/posix.h"
#include "io/formats/mesh_source.h"

namespace folprom::fuzz {
namespace {

using Opened = Result<std::unique_ptr<io::MeshSource>>;

std::string FaultOfVertices(const io::MeshSource& source) {
  uint64_t vertices = 0;
  std::vector<double> xyz;
  std::vector<uint8_t> values;
  for (size_t block = 0; block < source.vertex_block_count(); ++block) {
    source.ReadVertexBlock(block, &xyz).value();
    source.ReadVertexAttributes(block, &values).value();
    const size_t count = xyz.size() / 3;
    if (vertices != source.vertex_block_begin(block)) return "a block begins elsewhere";
    if (xyz.size() % 3 != 0 || count > io::kBlockVertices) return "a block of another size";
    if (values.size() != count * source.vertex_schema().Stride()) return "attributes are missing";
    vertices += count;
  }
  return vertices == source.vertex_count() ? "" : "the number of vertices is another one";
}

std::string FaultOfTriangles(const io::MeshSource& source) {
  uint64_t count = 0;
  std::vector<io::Triangle> triangles;
  for (size_t block = 0; block < source.triangle_block_count(); ++block) {
    source.ReadTriangleBlock(block, &triangles).value();
    count += triangles.size();
    for (const io::Triangle& triangle : triangles) {
      for (const uint64_t vertex : triangle) {
        if (vertex >= source.vertex_count()) return "a triangle has a vertex that does not exist";
      }
    }
  }
  return count == source.triangle_count() ? "" : "the number of triangles is another one";
}

ScanOutcome ReadAll(Opened opened, const std::string& name) {
  try {
    const std::unique_ptr<io::MeshSource> source = std::move(opened).value();
    std::string fault = FaultOfVertices(*source);
    if (fault.empty()) fault = FaultOfTriangles(*source);
    return {true, "", fault};
  } catch (const Failure& failure) {
    const Error& error = failure.error();
    const bool fits = error.kind == ErrorKind::kInput || error.kind == ErrorKind::kLimit;
    const bool is_named = error.message.starts_with(name + ": ");
    return {false, error.message, fits && is_named ? "" : "the error is: " + error.message};
  }
}

}  // namespace

ScanOutcome ReadScan(const std::string& path) { return ReadAll(io::MeshSource::Open(path), path); }

ScanOutcome ReadScanBytes(std::span<const uint8_t> bytes, const std::string& name) {
  const io::Descriptor file(::memfd_create("scan", MFD_CLOEXEC));
  if (!file.open()) throw std::runtime_error("no file in memory");
  io::WriteAll(file.get(), bytes, name);
  return ReadAll(io::MeshSource::OfMapped(io::MappedFile::OfDescriptor(file.get(), name).value()),
                 name);
}

ScanOutcome ReadTextInput(std::span<const uint8_t> input) {
  if (input.empty()) return {};
  std::string name = "scan";
  if (input[0] == 'o') name += ".obj";
  if (input[0] == 's') name += ".stl";
  if (input[0] == 'f') name += ".off";
  return ReadScanBytes(input.subspan(1), name);
}

}  // namespace folprom::fuzz
