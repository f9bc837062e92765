#include "tests/support/same_mesh.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace folprom::support {
namespace {

uint64_t Mixed(uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

std::string Text(const Point& p) {
  return "(" + std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " + std::to_string(p[2]) +
         ")";
}

std::string CountDifference(const Mesh& a, const Mesh& b) {
  if (a.positions.size() == b.positions.size() && a.faces.size() == b.faces.size()) return "";
  return std::to_string(a.positions.size()) + " vertices and " + std::to_string(a.faces.size()) +
         " faces became " + std::to_string(b.positions.size()) + " and " +
         std::to_string(b.faces.size());
}

/// The distinct positions of a mesh, ascending.
std::vector<Point> DistinctPositions(const Mesh& mesh) {
  std::vector<Point> distinct = mesh.positions;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  return distinct;
}

/// Number of the only position within the tolerance per axis; a sentence where there is not one.
std::string FindPosition(const std::vector<Point>& distinct, const Point& p, double tolerance,
                         uint64_t* number) {
  // The last digits of the subtraction are no error of the coder.
  double limit = tolerance * (1 + 1e-9);
  auto it = std::lower_bound(distinct.begin(), distinct.end(), Point{p[0] - limit, -INFINITY, 0});
  size_t found = 0;
  for (; it != distinct.end() && (*it)[0] - p[0] <= limit; ++it) {
    if (std::fabs((*it)[0] - p[0]) <= limit && std::fabs((*it)[1] - p[1]) <= limit &&
        std::fabs((*it)[2] - p[2]) <= limit) {
      *number = static_cast<uint64_t>(it - distinct.begin());
      ++found;
    }
  }
  if (found == 1) return "";
  return "decoded vertex " + Text(p) + " is near " + std::to_string(found) +
         " positions of the original";
}

/// Colours tell vertices apart by their faces and the colours around, one ring further each time.
void Refine(const std::vector<Triple>& faces, std::vector<uint64_t>* colours) {
  std::vector<uint64_t> sums(colours->size(), 0);
  for (const Triple& f : faces) {
    for (size_t i = 0; i < 3; ++i) {
      uint64_t hash = 1;
      for (size_t k = 0; k < 3; ++k) hash = Mixed(hash * 3 + (*colours)[f[(i + k) % 3]]);
      sums[f[i]] += hash;
    }
  }
  for (size_t v = 0; v < sums.size(); ++v)
    (*colours)[v] = Mixed((*colours)[v] + Mixed(sums[v] + 1));
}

/// Pairs (position number, colour), ascending.
std::vector<std::array<uint64_t, 2>> Fingerprint(const Mesh& mesh,
                                                 const std::vector<uint64_t>& position_of) {
  constexpr int kRings = 3;
  std::vector<uint64_t> colours;
  for (uint64_t number : position_of) colours.push_back(Mixed(number + 0x9e3779b97f4a7c15));
  for (int ring = 0; ring < kRings; ++ring) Refine(mesh.faces, &colours);
  std::vector<std::array<uint64_t, 2>> pairs;
  for (size_t v = 0; v < colours.size(); ++v) pairs.push_back({position_of[v], colours[v]});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Triple SmallestRotation(const Triple& f) {
  return std::min({f, Triple{f[1], f[2], f[0]}, Triple{f[2], f[0], f[1]}});
}

}  // namespace

std::string DifferenceOf(const Mesh& original, const Mesh& decoded, double tolerance) {
  std::string counts = CountDifference(original, decoded);
  if (!counts.empty()) return counts;
  std::vector<Point> distinct = DistinctPositions(original);
  std::vector<uint64_t> original_number, decoded_number;
  for (const Point& p : original.positions) {
    auto it = std::lower_bound(distinct.begin(), distinct.end(), p);
    original_number.push_back(static_cast<uint64_t>(it - distinct.begin()));
  }
  for (const Point& p : decoded.positions) {
    uint64_t number = 0;
    std::string fault = FindPosition(distinct, p, tolerance, &number);
    if (!fault.empty()) return fault;
    decoded_number.push_back(number);
  }
  auto a = Fingerprint(original, original_number), b = Fingerprint(decoded, decoded_number);
  auto [left, right] = std::mismatch(a.begin(), a.end(), b.begin());
  if (left == a.end()) return "";
  uint64_t place = std::min((*left)[0], (*right)[0]);
  return ((*left)[0] == (*right)[0] ? "other faces around " : "another number of vertices at ") +
         Text(distinct[place]);
}

std::string DifferenceInOrder(const Mesh& a, const Mesh& b) {
  std::string counts = CountDifference(a, b);
  if (!counts.empty()) return counts;
  auto [left, right] = std::mismatch(a.positions.begin(), a.positions.end(), b.positions.begin());
  if (left != a.positions.end()) {
    return "vertex " + std::to_string(left - a.positions.begin()) + ": " + Text(*left) +
           " became " + Text(*right);
  }
  std::vector<Triple> faces[2];
  for (const Triple& f : a.faces) faces[0].push_back(SmallestRotation(f));
  for (const Triple& f : b.faces) faces[1].push_back(SmallestRotation(f));
  std::sort(faces[0].begin(), faces[0].end());
  std::sort(faces[1].begin(), faces[1].end());
  return faces[0] == faces[1] ? "" : "the faces differ";
}

}  // namespace folprom::support
