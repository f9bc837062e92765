#include "tests/bench/peers/fidelity.h"

#include <algorithm>

#include "tests/bench/peers/vertex_pairing.h"

namespace folprom::peers {
namespace {

Triple SmallestRotation(const Triple& f) {
  return std::min({f, Triple{f[1], f[2], f[0]}, Triple{f[2], f[0], f[1]}});
}

std::vector<Triple> Rotated(const std::vector<Triple>& faces) {
  std::vector<Triple> rotated;
  rotated.reserve(faces.size());
  for (const Triple& face : faces) rotated.push_back(SmallestRotation(face));
  return rotated;
}

// Decoded faces in the numbers of the original; a corner without a partner stays kNoVertex, which
// no original face has.
std::vector<Triple> Renumbered(const std::vector<Triple>& faces,
                               const std::vector<uint32_t>& partner) {
  std::vector<Triple> renumbered;
  renumbered.reserve(faces.size());
  for (const Triple& f : faces) {
    renumbered.push_back(SmallestRotation({partner[f[0]], partner[f[1]], partner[f[2]]}));
  }
  return renumbered;
}

uint64_t CountMissing(std::vector<Triple> wanted, std::vector<Triple> present) {
  std::sort(wanted.begin(), wanted.end());
  std::sort(present.begin(), present.end());
  uint64_t missing = 0;
  auto at = present.begin();
  for (const Triple& face : wanted) {
    while (at != present.end() && *at < face) ++at;
    if (at != present.end() && *at == face) {
      ++at;
    } else {
      ++missing;
    }
  }
  return missing;
}

}  // namespace

Fidelity CompareWithOriginal(const Mesh& original, const Mesh& decoded, double tolerance) {
  Fidelity fidelity;
  fidelity.original = {original.positions.size(), original.faces.size()};
  fidelity.decoded = {decoded.positions.size(), decoded.faces.size()};
  fidelity.vertex_order = InSameOrder(original, decoded, tolerance);

  const std::vector<uint32_t> partner = PairVertices(original, decoded, tolerance);
  const auto paired = static_cast<uint64_t>(
      std::count_if(partner.begin(), partner.end(), [](uint32_t v) { return v != kNoVertex; }));
  fidelity.lost.vertices = fidelity.original.vertices - paired;
  const std::vector<Triple> wanted = Rotated(original.faces);
  const std::vector<Triple> present = Renumbered(decoded.faces, partner);
  fidelity.face_order = wanted == present;
  fidelity.lost.faces = CountMissing(wanted, present);
  return fidelity;
}

}  // namespace folprom::peers
