// Says as JSON what a decoded mesh kept of its original:
//   peer_check ORIGINAL.ply DECODED.ply TOLERANCE
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/bench/peers/fidelity.h"
#include "tests/bench/peers/mesh_file.h"

int main(int argc, char** argv) {
  using folprom::peers::ReadMesh;
  if (argc != 4) {
    std::fprintf(stderr, "peer_check ORIGINAL.ply DECODED.ply TOLERANCE\n");
    return 2;
  }
  try {
    const folprom::peers::Fidelity fidelity = folprom::peers::CompareWithOriginal(
        ReadMesh(argv[1]), ReadMesh(argv[2]), std::stod(argv[3]));
    const nlohmann::ordered_json json = {{"vertices", fidelity.decoded.vertices},
                                         {"faces", fidelity.decoded.faces},
                                         {"lost_vertices", fidelity.lost.vertices},
                                         {"lost_faces", fidelity.lost.faces},
                                         {"same_vertices", fidelity.same_vertices()},
                                         {"same_connectivity", fidelity.same_connectivity()},
                                         {"vertex_order", fidelity.vertex_order},
                                         {"face_order", fidelity.face_order}};
    std::puts(json.dump(2).c_str());
    return 0;
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "peer_check: %s\n", fault.what());
    return 1;
  }
}
