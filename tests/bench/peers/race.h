// Contenders against each other on one scan, in alternating runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/peers/contenders.h"

namespace folprom::peers {

/// What one phase, encoding or decoding, costs.
struct Cost {
  double seconds = 0;       ///< median of the runs
  double ratio = 0;         ///< median over the rounds of the ratio to the reference in that round
  uint64_t peak_bytes = 0;  ///< largest of the runs
};

/// What came back, see Fidelity.
struct Kept {
  uint64_t vertices = 0, faces = 0;  ///< decoded
  uint64_t lost_vertices = 0, lost_faces = 0;
  bool same_vertices = false, same_connectivity = false, vertex_order = false, face_order = false;
};

struct Standing {
  std::string name;
  int bits = 0;         ///< 0: positions exact
  std::string failure;  ///< empty, or the phase that failed; nothing else is known then
  uint64_t bytes = 0;
  Cost encode, decode;
  std::optional<Kept> kept;
};

struct Race {
  std::string scan;  ///< name without folder and suffix
  ScanSize size;
  int runs = 0;
  std::vector<Standing> standings;
};

/// Each round runs every contender once, so that a drift of the machine meets all of them. Ratios
/// are to the reference with the same bits, else to that with the first bits. Progress goes to
/// standard error. Throws Failure.
Race RunRace(const std::string& scan, const ContenderOptions& options, int runs);

}  // namespace folprom::peers
