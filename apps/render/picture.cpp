#include "apps/render/picture.h"

#include <cmath>
#include <utility>

#include "apps/render/scene.h"
#include "engine/measure/triangle_mesh.h"
#include "folprom/folprom.h"
#include "folprom/result.h"

namespace folprom::render {
namespace {

// Of the finite positions; a box around the origin where there are none.
Box BoxOf(const measure::TriangleMesh& mesh) {
  Box box;
  bool any = false;
  for (const Vector3& p : mesh.positions) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) continue;
    if (!any) box = {p, p};
    any = true;
    for (size_t i = 0; i < 3; ++i) {
      box.lo[i] = std::min(box.lo[i], p[i]);
      box.hi[i] = std::max(box.hi[i], p[i]);
    }
  }
  return box;
}

Box BoxFor(const std::string& path, const measure::TriangleMesh& mesh, const Limits& limits) {
  Box box;
  if (measure::IsFolp(path)) {
    const FileInfo info = ReadInfo(path, limits).value();
    box = {info.box_lo, info.box_hi};
  } else {
    box = BoxOf(mesh);
  }
  if (!std::isfinite(measure::Length(measure::Difference(box.hi, box.lo)))) {
    throw Failure(ErrorKind::kInput, path + ": the bounding box is too large to be drawn");
  }
  return box;
}

// The picture, its samples and its PNG.
constexpr uint64_t kBytesPerPixel = 3 * sizeof(Pixel);

std::string MiB(uint64_t bytes) { return std::to_string((bytes >> 20) + 1) + " MiB"; }

void CheckMemory(const std::string& path, uint64_t bytes, uint64_t limit) {
  if (bytes <= limit) return;
  throw Failure(ErrorKind::kLimit, path + ": to draw it takes " + MiB(bytes) +
                                       ", more than the memory limit of " + MiB(limit - 1) +
                                       "; a larger -M or a coarser level of detail may help");
}

std::string Counted(uint64_t count, const char* one, const char* more) {
  return std::to_string(count) + " " + (count == 1 ? one : more);
}

void AddWarnings(const std::string& path, const Scene& scene, Picture* picture) {
  auto& warnings = picture->warnings;
  if (picture->vertices == 0) warnings.push_back(path + ": has no vertices; the picture is empty");
  const uint64_t vertices = scene.vertices_left_out(), faces = scene.faces_left_out();
  if (vertices == 0) return;
  std::string warning = path + ": " + Counted(vertices, "vertex is", "vertices are") +
                        " not finite and left out of the picture";
  if (faces > 0) warning += ", with " + Counted(faces, "face", "faces");
  warnings.push_back(std::move(warning));
}

}  // namespace

Picture Draw(const std::string& path, const PictureOptions& options, parallel::Runner& runner,
             parallel::Progress& progress) {
  Picture picture;
  measure::ReadOptions read;
  read.decode = options.decode;
  read.take_all = true;
  read.warnings = &picture.warnings;
  read.before_loading = [&](uint64_t vertices, uint64_t faces) {
    picture.vertices = vertices;
    picture.faces = faces;
    const uint64_t pixels = uint64_t{options.width} * options.height;
    CheckMemory(path, Scene::Bytes(vertices, faces) + pixels * kBytesPerPixel,
                options.decode.limits.memory_bytes);
  };
  measure::TriangleMesh mesh = measure::ReadMesh(path, read, runner, progress);
  picture.box = options.box ? *options.box : BoxFor(path, mesh, options.decode.limits);
  const Camera camera(picture.box, options.view, options.width, options.height);
  const Scene scene(std::move(mesh), camera, runner, progress);
  picture.image = Render(scene, camera, options.style, runner, progress);
  AddWarnings(path, scene, &picture);
  return picture;
}

}  // namespace folprom::render
