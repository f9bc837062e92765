#include "tests/hostile/small_scans.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "tests/hostile/support.h"

namespace folprom::hostile {
namespace {

template <class T>
void Put(T value, std::string* bytes, bool big_endian = false) {
  std::string piece(sizeof value, '\0');
  std::memcpy(piece.data(), &value, sizeof value);
  if (big_endian) std::reverse(piece.begin(), piece.end());
  *bytes += piece;
}

std::string BinaryStl(const std::string& title) {
  std::string bytes = title + std::string(80 - title.size(), ' ');
  Put(uint32_t{2}, &bytes);
  for (int f = 0; f < 2; ++f) {
    for (int i = 0; i < 12; ++i) Put(static_cast<float>(f * i), &bytes);
    Put(uint16_t{0}, &bytes);
  }
  return bytes;
}

/// As Geomview specifies it, or as other programs write it.
std::string BinaryOff(bool geomview) {
  std::string bytes = "OFF BINARY\n";
  const auto count = [&](uint32_t value) { Put(value, &bytes, geomview); };
  for (const uint32_t value : {4, 2, 0}) count(value);
  for (int i = 0; i < 12; ++i) Put(static_cast<float>(i * i), &bytes, geomview);
  for (const uint32_t corners : {3, 4}) {
    count(corners);
    for (uint32_t i = 0; i < corners; ++i) count(i);
    if (geomview) count(0);
  }
  return bytes;
}

}  // namespace

std::vector<SmallScan> SmallScans() {
  std::vector<SmallScan> scans = {
      {"obj.obj",
       "mtllib a.mtl\nv 0 0 0\nv 1 0 0.5\nvt 0 1\nvn 0 0 1\nusemtl red\n"
       "f 1/1/1 2//1 \\\n-1/1\nv 1e1 -1 0\ng b\nf -3 1 2 3\nl 1 2\n"},
      {"text.stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1.5 0\n"
       "endloop\nendfacet\nendsolid a\nsolid b\nendsolid b\n"},
      {"binary.stl", BinaryStl("by a test"), false},
      {"titled.stl", BinaryStl("solid by a test"), false},
      {"off.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1e1 0.5\n4 0 1 2 3\n3 0 1 2 255 0 0\n1 2\n"},
      {"coff.off",
       "CNOFF # a\n3 1 0\n0 0 0 0 0 1 9 9 9 9\n1 0 0 0 0 1 9 9 9 9\n"
       "0 1 0 0 0 1 9 9 9 9\n3 0 1 2\n"},
      {"geomview.off", BinaryOff(true), false},
      {"binary.off", BinaryOff(false), false},
  };
  std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
      "float z\nelement face 3\nproperty uchar red\nproperty list uchar int vertex_indices\n"
      "property list uchar short texcoord\nend_header\n";
  scans.push_back(
      {"faces.ply", header + "0 0 0\n1 0 0\n1 1 0\n0 1e1 0.5\n7 4 0 1 2 3 8 0 1 2 3 4 5 6 7\n"
                             "8 3 0 1 2 6 1 2 3 4 5 6\n9 2 0 1 1 5\n"});
  header.replace(header.find("ascii"), 5, "binary_little_endian");
  for (int i = 0; i < 12; ++i) Put(static_cast<float>(i * i), &header);
  for (const uint8_t corners : {uint8_t{3}, uint8_t{4}, uint8_t{2}}) {
    Put(static_cast<uint8_t>(40 * corners), &header);
    Put(corners, &header);
    for (int32_t i = 0; i < corners; ++i) Put(i, &header);
    Put(static_cast<uint8_t>(2 * corners), &header);
    for (int16_t i = 0; i < 2 * corners; ++i) Put(i, &header);
  }
  scans.push_back({"faces_little.ply", header, false});
  for (const std::string name :
       {"ascii", "strips_ascii", "little", "plain_little", "big", "plain_big"}) {
    const Bytes bytes = FileContent(FOLPROM_SOURCE_DIR "/tests/fuzz/seeds/ply/" + name + ".ply");
    scans.push_back(
        {name + ".ply", std::string(bytes.begin(), bytes.end()), name.ends_with("ascii")});
  }
  return scans;
}

}  // namespace folprom::hostile
