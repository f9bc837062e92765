#include "engine/measure/triangle_mesh.h"

#include <algorithm>
#include <limits>

#include "folprom/folprom.h"
#include "folprom/result.h"
#include "io/container/header.h"
#include "io/files/mapped_file.h"
#include "io/formats/mesh_source.h"
#include "io/spill/spill.h"

namespace folprom::measure {
namespace {

// Embree numbers primitives in 32 bits, the last number means none.
constexpr uint64_t kMaxCount = std::numeric_limits<uint32_t>::max() - 1;

// Squares of coordinates in the frame must stay within float.
constexpr double kFarthest = 1e17;

void CheckCount(const std::string& path, uint64_t count, const char* what) {
  if (count <= kMaxCount) return;
  throw Failure(ErrorKind::kLimit, path + ": " + std::to_string(count) + " " + what + "; at most " +
                                       std::to_string(kMaxCount) + " can be compared");
}

void CheckFinite(const std::string& path, uint64_t vertex, const Vector3& position) {
  for (const double x : position) {
    if (std::isfinite(x)) continue;
    throw Failure(ErrorKind::kInput,
                  path + ": vertex " + std::to_string(vertex) + ": position is not finite");
  }
}

void ReadPositions(const io::MeshSource& source, const std::string& path, bool take_all,
                   parallel::Runner& runner, parallel::Progress& progress,
                   std::vector<Vector3>* positions) {
  positions->resize(source.vertex_count());
  runner.ForEach(source.vertex_block_count(), [&](size_t block) {
    std::vector<double> xyz;
    source.ReadVertexBlock(block, &xyz).value();
    const uint64_t begin = source.vertex_block_begin(block);
    for (size_t i = 0; i < xyz.size() / 3; ++i) {
      const Vector3 position = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
      if (!take_all) CheckFinite(path, begin + i, position);
      (*positions)[begin + i] = position;
    }
    progress.Advance(xyz.size() / 3);
  });
}

void ReadFaces(const io::MeshSource& source, parallel::Runner& runner, parallel::Progress& progress,
               std::vector<std::array<uint32_t, 3>>* faces) {
  faces->reserve(source.triangle_count());
  const size_t blocks = source.triangle_block_count();
  std::vector<std::vector<io::Triangle>> read(blocks);
  runner.Ordered(
      blocks, static_cast<size_t>(runner.threads()) * 2,
      [&](size_t block) { source.ReadTriangleBlock(block, &read[block]).value(); },
      [&](size_t block) {
        for (const io::Triangle& t : read[block]) {
          faces->push_back({static_cast<uint32_t>(t[0]), static_cast<uint32_t>(t[1]),
                            static_cast<uint32_t>(t[2])});
        }
        progress.Advance(read[block].size());
        read[block] = {};
      });
}

TriangleMesh ReadSource(const std::string& file, const std::string& path,
                        const ReadOptions& options, parallel::Runner& runner,
                        parallel::Progress& progress) {
  const auto source = std::move(io::MeshSource::Open(file, options.decode.limits).value());
  CheckCount(path, source->vertex_count(), "vertices");
  CheckCount(path, source->triangle_count(), "faces");
  if (source->vertex_count() == 0 && !options.take_all) {
    throw Failure(ErrorKind::kInput, path + ": the mesh has no vertices");
  }
  if (options.before_loading) {
    options.before_loading(source->vertex_count(), source->triangle_count());
  }
  progress.StartStage("read", source->vertex_count() + source->triangle_count());
  TriangleMesh mesh;
  ReadPositions(*source, path, options.take_all, runner, progress, &mesh.positions);
  ReadFaces(*source, runner, progress, &mesh.faces);
  source->CheckUnchanged().value();
  return mesh;
}

}  // namespace

bool IsFolp(const std::string& path) {
  const io::MappedFile file = io::MappedFile::Open(path).value();
  const auto bytes = file.bytes();
  // A cut file is the decoder's to refuse.
  const size_t size = std::min(bytes.size(), io::kMagic.size());
  return size > 0 && std::equal(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(size),
                                io::kMagic.begin());
}

TriangleMesh ReadMesh(const std::string& path, const ReadOptions& options, parallel::Runner& runner,
                      parallel::Progress& progress) {
  if (!IsFolp(path)) return ReadSource(path, path, options, runner, progress);
  const io::SpillDirectory folder(options.decode.temporary_folder);
  const std::string decoded = folder.File("decoded.ply");
  const DecodeReport report = DecodeFile(path, decoded, options.decode, runner, progress).value();
  if (options.warnings != nullptr) *options.warnings = report.warnings;
  return ReadSource(decoded, path, options, runner, progress);
}

UnitFrame::UnitFrame(const TriangleMesh& mesh, const std::string& path) {
  Vector3 lo = mesh.positions.front();
  Vector3 hi = lo;
  for (const Vector3& position : mesh.positions) {
    for (size_t i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], position[i]);
      hi[i] = std::max(hi[i], position[i]);
    }
  }
  for (size_t i = 0; i < 3; ++i) centre_[i] = lo[i] / 2 + hi[i] / 2;
  diagonal_ = std::hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
  if (!std::isfinite(diagonal_)) {
    throw Failure(ErrorKind::kInput, path + ": the bounding box is too large to be measured");
  }
}

TriangleMesh UnitFrame::Inside(TriangleMesh mesh, const std::string& path) const {
  for (Vector3& position : mesh.positions) {
    for (size_t i = 0; i < 3; ++i) {
      position[i] = (position[i] - centre_[i]) / scale();
      if (!(std::abs(position[i]) < kFarthest)) {
        throw Failure(ErrorKind::kInput, path + ": lies too far away from the first mesh");
      }
    }
  }
  return mesh;
}

}  // namespace folprom::measure
