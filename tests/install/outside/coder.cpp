// coder SCAN.ply F.folp BACK.ply: writes a torus, encodes, decodes, verifies, reads it back.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "folprom/folprom.h"
#include "folprom/io/formats/mesh_source.h"
#include "folprom/io/formats/mesh_writer.h"
#include "folprom/parallel/progress.h"
#include "folprom/parallel/runner.h"

namespace {

constexpr uint64_t kAround = 100, kAcross = 60;

void WriteTorus(const std::string& path) {
  std::vector<double> xyz;
  std::vector<folprom::io::Triangle> faces;
  for (uint64_t i = 0; i < kAround; ++i) {
    for (uint64_t j = 0; j < kAcross; ++j) {
      const double u = 2 * M_PI * static_cast<double>(i) / kAround;
      const double v = 2 * M_PI * static_cast<double>(j) / kAcross;
      const double radius = 3 + std::cos(v);
      for (const double value : {radius * std::cos(u), radius * std::sin(u), std::sin(v)}) {
        xyz.push_back(static_cast<float>(value));
      }
      const uint64_t i1 = (i + 1) % kAround, j1 = (j + 1) % kAcross;
      const uint64_t a = i * kAcross + j, b = i1 * kAcross + j;
      const uint64_t c = i1 * kAcross + j1, d = i * kAcross + j1;
      faces.push_back({a, b, c});
      faces.push_back({a, c, d});
    }
  }
  auto writer = folprom::io::MeshWriter::Create(
      path, {xyz.size() / 3, faces.size(), folprom::ScalarType::kFloat32}, true);
  writer.value()->AppendVertices(xyz).value();
  writer.value()->AppendFaces(faces).value();
  writer.value()->Commit().value();
}

bool Run(const std::string& scan, const std::string& file, const std::string& back) {
  WriteTorus(scan);
  const auto runner = folprom::parallel::MakeTbbRunner(0);
  folprom::parallel::Progress progress;
  folprom::EncodeOptions encode;
  encode.exact = true;
  encode.overwrite = true;
  const auto encoded = folprom::EncodeFile(scan, file, encode, *runner, progress).value();
  folprom::DecodeOptions decode;
  decode.overwrite = true;
  const auto decoded = folprom::DecodeFile(file, back, decode, *runner, progress).value();
  const auto verified = folprom::VerifyFile(file, scan, decode, *runner, progress).value();
  const auto source = folprom::io::MeshSource::Open(back).value();
  std::printf("%llu bytes, %llu layers\n", static_cast<unsigned long long>(encoded.bytes),
              static_cast<unsigned long long>(encoded.layers));
  return decoded.complete && verified.lossless && source->vertex_count() == kAround * kAcross &&
         source->triangle_count() == 2 * kAround * kAcross;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    return Run(argv[1], argv[2], argv[3]) ? 0 : 1;
  } catch (const folprom::Failure& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return static_cast<int>(failure.error().kind);
  }
}
