// viewer F.folp VERTICES FACES: decodes from memory, level of detail by level of detail.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include "folprom/decoder.h"

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  std::ifstream stream(argv[1], std::ios::binary);
  const std::vector<uint8_t> file(std::istreambuf_iterator<char>(stream), {});
  auto decoder = folprom::MemoryDecoder::Open(file);
  if (!decoder) {
    std::fprintf(stderr, "%s\n", decoder.error().message.c_str());
    return 1;
  }
  size_t vertices = 0, faces = 0;
  while (decoder->decoded_layers() < decoder->layer_count()) {
    const folprom::Result<void> decoded = decoder->DecodeNextLayer();
    if (!decoded) {
      std::fprintf(stderr, "%s\n", decoded.error().message.c_str());
      return 1;
    }
    const folprom::DecodedMesh mesh = decoder->Mesh();
    if (mesh.positions.size() < vertices) return 1;
    vertices = mesh.positions.size();
    faces = mesh.faces.size();
    std::printf("layer %zu: %zu vertices, %zu faces, error at most %g\n", decoder->decoded_layers(),
                vertices, faces, decoder->error_bound());
  }
  const bool several = decoder->layer_count() > 2;
  const bool whole = vertices == std::strtoull(argv[2], nullptr, 10) &&
                     faces == std::strtoull(argv[3], nullptr, 10);
  return several && whole ? 0 : 1;
}
