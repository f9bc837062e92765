#include "tests/hostile/support.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/container/reader.h"
#include "parallel/progress.h"
#include "parallel/runner.h"
#include "tests/support/memory_file.h"

namespace folprom::hostile {
namespace fs = std::filesystem;

void WriteFile(const std::string& path, std::span<const uint8_t> bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

void WriteFile(const std::string& path, std::string_view text) {
  std::ofstream(path, std::ios::binary) << text;
}

Bytes FileContent(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), {});
}

TestMesh RoughTorus(uint32_t rings, uint32_t sides) {
  TestMesh mesh;
  for (uint32_t r = 0; r < rings; ++r) {
    for (uint32_t s = 0; s < sides; ++s) {
      double a = 6.283185307179586 * r / rings, b = 6.283185307179586 * s / sides;
      double tube = 1 + 0.15 * std::sin(3 * a + 2 * b) + 0.05 * std::cos(7 * a - 5 * b);
      double reach = 3 + tube * std::cos(b);
      mesh.positions.push_back({reach * std::cos(a), reach * std::sin(a), tube * std::sin(b)});
      uint32_t here = r * sides + s, beside = r * sides + (s + 1) % sides;
      uint32_t next = (r + 1) % rings * sides + s;
      uint32_t diagonal = (r + 1) % rings * sides + (s + 1) % sides;
      mesh.faces.push_back({here, next, diagonal});
      mesh.faces.push_back({here, diagonal, beside});
    }
  }
  mesh.positions.push_back({0, 0, 0});          // isolated
  mesh.positions.push_back(mesh.positions[5]);  // coincident, and the third face of an edge
  mesh.faces.push_back({0, 1, rings * sides + 1});
  mesh.faces.push_back(mesh.faces[7]);
  mesh.faces.push_back({mesh.faces[20][1], mesh.faces[20][0], mesh.faces[20][2]});
  mesh.faces.push_back({3, 3, 4});
  return mesh;
}

TestMesh WavySheet(uint32_t side) {
  TestMesh mesh;
  for (uint32_t y = 0; y < side; ++y) {
    for (uint32_t x = 0; x < side; ++x) {
      mesh.positions.push_back(
          {x * 0.01, y * 0.01, 0.05 * std::sin(x * 0.11) * std::cos(y * 0.07)});
      if (x + 1 == side || y + 1 == side) continue;
      uint32_t here = y * side + x;
      mesh.faces.push_back({here, here + 1, here + side});
      mesh.faces.push_back({here + 1, here + side + 1, here + side});
    }
  }
  return mesh;
}

namespace {

template <class T>
void AppendNumber(std::string* out, T value, PlyForm form) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (form == PlyForm::kBigEndian) std::reverse(bytes.begin(), bytes.end());
  out->append(bytes.data(), bytes.size());
}

}  // namespace

std::string PlyBytes(const TestMesh& mesh, PlyForm form) {
  const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  std::string out = std::string("ply\nformat ") + names[static_cast<int>(form)] +
                    " 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
                    "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                    std::to_string(mesh.faces.size()) +
                    "\nproperty list uchar int vertex_indices\nend_header\n";
  if (form == PlyForm::kAscii) {
    for (const auto& p : mesh.positions) {
      for (double value : p) out += std::to_string(value) + " ";
      out.back() = '\n';
    }
    for (const auto& f : mesh.faces) {
      out += "3 " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) +
             "\n";
    }
    return out;
  }
  for (const auto& p : mesh.positions) {
    for (double value : p) AppendNumber(&out, value, form);
  }
  for (const auto& f : mesh.faces) {
    out.push_back(3);
    for (uint32_t index : f) AppendNumber(&out, index, form);
  }
  return out;
}

EncodeOptions SmallOptions(uint32_t subtree_vertices) {
  EncodeOptions options;
  options.bits = 9;
  options.codec.subtree_vertices = subtree_vertices;
  options.codec.least_layer = 20;  // of some 300 vertices, in several layers
  return options;
}

EncodeOptions LloydOptions(uint32_t subtree_vertices) {
  EncodeOptions options = SmallOptions();
  const uint32_t least_layer = options.codec.least_layer;
  options.codec = support::LloydSettings();
  options.codec.subtree_vertices = subtree_vertices;
  options.codec.least_layer = least_layer;
  return options;
}

Bytes Encoded(const TestMesh& mesh, const EncodeOptions& options) {
  TemporaryFolder folder;
  WriteFile(folder.File("scan.ply"), PlyBytes(mesh));
  auto runner = parallel::MakeSerialRunner();
  parallel::Progress progress;
  EncodeFile(folder.File("scan.ply"), folder.File("scan.folp"), options, *runner, progress).value();
  return FileContent(folder.File("scan.folp"));
}

const Bytes& SmallFile(Hierarchy hierarchy) {
  static const Bytes quadric = Encoded(RoughTorus(25, 12), SmallOptions());
  static const Bytes lloyd = Encoded(RoughTorus(25, 12), LloydOptions());
  return hierarchy == Hierarchy::kLloyd ? lloyd : quadric;
}

std::vector<Lod> DecodeLods(std::span<const uint8_t> file, ErrorKind* error) {
  std::vector<Lod> lods;
  *error = ErrorKind::kUsage;
  auto decoder = MemoryDecoder::Open(file);
  if (!decoder) {
    *error = decoder.error().kind;
    return lods;
  }
  while (decoder->decoded_layers() < decoder->layer_count()) {
    Result<void> layer = decoder->DecodeNextLayer();
    if (!layer) {
      *error = layer.error().kind;
      break;
    }
    DecodedMesh mesh = decoder->Mesh();
    lods.push_back({std::move(mesh.positions), std::move(mesh.faces)});
  }
  return lods;
}

Parts TakeApart(std::span<const uint8_t> file) {
  auto container = io::ContainerReader::Open(file, "small file").value();
  Parts parts;
  parts.table = container.table();
  for (size_t layer = 0; layer < parts.table.layers.size(); ++layer) {
    for (size_t subtree = 0; subtree < parts.table.subtrees.size(); ++subtree) {
      for (auto part : {io::SegmentPart::kInner, io::SegmentPart::kSeam}) {
        auto bytes = container.Segment(layer, subtree, part).value();
        parts.segments.emplace_back(bytes.begin(), bytes.end());
      }
    }
  }
  return parts;
}

Bytes PutTogether(Parts parts) {
  parts.table.segment_bytes.clear();
  if (!parts.table.HasSeams()) {
    for (size_t i = 1; i < parts.segments.size(); i += 2) parts.segments[i].clear();
  }
  for (const Bytes& segment : parts.segments) parts.table.segment_bytes.push_back(segment.size());
  return support::WrittenContainer(parts.table, [&](size_t layer, size_t subtree,
                                                    io::SegmentPart part) {
    return std::span<const uint8_t>(parts.segments[parts.table.SegmentIndex(layer, subtree, part)]);
  });
}

std::string SharedData() {
  const char* variable = std::getenv("FOLPROM_SHARED");
  const std::string shared =
      variable != nullptr ? variable : std::string(FOLPROM_SOURCE_DIR) + "/../shared";
  return fs::is_directory(shared + "/data") ? shared + "/data/" : "";
}

}  // namespace folprom::hostile
