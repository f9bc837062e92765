#include "tests/support/meshes.h"

#include <cmath>

#include "tests/support/random.h"
#include "tests/support/surfaces.h"

namespace folprom::support {
namespace {

Mesh RandomPoints(uint64_t count, uint64_t seed) {
  Random random(seed);
  Mesh mesh;
  for (uint64_t i = 0; i < count; ++i) {
    mesh.positions.push_back({random.Between(-1, 1), random.Between(-1, 1), random.Between(-1, 1)});
  }
  return mesh;
}

Triple DistinctTriple(Random* random, uint64_t vertices) {
  uint64_t a = random->Below(vertices), b = random->Below(vertices), c = random->Below(vertices);
  while (b == a) b = random->Below(vertices);
  while (c == a || c == b) c = random->Below(vertices);
  return {a, b, c};
}

Mesh Empty() { return {}; }
Mesh SingleVertex() { return {{{3, -4, 5}}, {}}; }
Mesh SingleTriangle() { return {{{0, 0, 0}, {1, 0, 0}, {0, 2, 1}}, {{2, 0, 1}}}; }
Mesh TwoVerticesOneDegenerateFace() { return {{{0, 0, 0}, {1, 2, 3}}, {{1, 0, 1}}}; }
Mesh VertexThreeTimesInItsFace() { return {{{1, 2, 3}}, {{0, 0, 0}, {0, 0, 0}}}; }
Mesh Tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}
Mesh PointsWithoutFaces() { return RandomPoints(150, 1); }

Mesh IsolatedVertices() {
  Mesh mesh = Torus(16, 10);
  for (const Point& p : RandomPoints(200, 2).positions) mesh.positions.push_back(p);
  return mesh;
}

Mesh AllInOnePoint() {
  Mesh mesh = RandomFaces(120, 250, 3);
  for (Point& p : mesh.positions) p = {7, 8, 9};
  return mesh;
}

/// Two sheets of 1,000 vertices each in the same place, joined nowhere.
Mesh CoincidentPairs() {
  Mesh mesh = FlatGrid(40, 25);
  for (Point& p : mesh.positions) p[2] = p[0] * p[1];
  Mesh copy = mesh;
  for (const Point& p : copy.positions) mesh.positions.push_back(p);
  for (const Triple& f : copy.faces) mesh.faces.push_back({f[0] + 1000, f[1] + 1000, f[2] + 1000});
  return mesh;
}

Mesh DuplicateFaces() {
  Mesh mesh = Torus(14, 8);
  size_t count = mesh.faces.size();
  for (size_t i = 0; i < count; ++i) {
    Triple face = mesh.faces[i];
    for (size_t copy = 0; copy < i % 5; ++copy) {
      face = {face[1], face[2], face[0]};
      mesh.faces.push_back(face);
    }
  }
  return mesh;
}

Mesh OppositeFaces() {
  Mesh mesh = Torus(14, 8);
  size_t count = mesh.faces.size();
  for (size_t i = 0; i < count; ++i) {
    Triple face = mesh.faces[i];
    for (size_t copy = 0; copy < i % 3; ++copy) mesh.faces.push_back({face[0], face[2], face[1]});
    if (i % 7 == 0) mesh.faces.push_back(face);
  }
  return mesh;
}

Mesh DegenerateFaces() {
  Mesh mesh = Torus(14, 8);
  Random random(4);
  uint64_t vertices = mesh.positions.size();
  for (int i = 0; i < 150; ++i) {
    // Ends that a face joins already, and ends that nothing else joins.
    Triple face = mesh.faces[random.Below(200)];
    uint64_t a = face[0], b = i % 2 == 0 ? face[1] : random.Below(vertices);
    mesh.faces.push_back({a, a, b});
    if (i % 3 == 0) mesh.faces.push_back({a, b, a});
    if (i % 5 == 0) mesh.faces.push_back({b, a, a});
    if (i % 4 == 0) mesh.faces.push_back({a, b, b});
    if (i % 7 == 0) mesh.faces.push_back({a, a, a});
  }
  return mesh;
}

Mesh OnlyDegenerateFaces() {
  Mesh mesh = RandomPoints(80, 5);
  for (uint64_t i = 0; i + 1 < 80; i += 2) {
    mesh.faces.push_back({i, i + 1, i});
    mesh.faces.push_back({i + 1, (i + 2) % 80, (i + 2) % 80});
  }
  return mesh;
}

/// 1,000 faces on one edge.
Mesh EdgeFan() {
  Mesh mesh = RandomPoints(1002, 6);
  for (uint64_t i = 2; i < 1002; ++i) {
    if (i % 2 == 0) {
      mesh.faces.push_back({0, 1, i});
    } else {
      mesh.faces.push_back({1, 0, i});
    }
  }
  return mesh;
}

/// One vertex with 20,000 neighbours.
Mesh Hub() {
  constexpr uint64_t kRim = 20000;
  Mesh mesh;
  mesh.positions.push_back({0, 0, 1});
  for (uint64_t i = 0; i < kRim; ++i) {
    double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(kRim);
    mesh.positions.push_back({50 * std::cos(angle), 50 * std::sin(angle), 0});
    mesh.faces.push_back({0, 1 + i, 1 + (i + 1) % kRim});
  }
  return mesh;
}

/// A tube of three sides: each of its rings is a 3-clique that is not a face.
Mesh OpenTube() {
  Mesh mesh = Torus(3, 30);
  for (uint64_t i = 0; i < mesh.positions.size(); ++i) {
    double angle = 2.0943951023931953 * static_cast<double>(i % 3);
    mesh.positions[i] = {std::cos(angle), std::sin(angle), 0.5 * static_cast<double>(i / 3)};
  }
  std::erase_if(mesh.faces, [](const Triple& f) {
    return (f[0] < 3 || f[1] < 3 || f[2] < 3) && (f[0] > 80 || f[1] > 80 || f[2] > 80);
  });
  return mesh;
}

Mesh MoebiusStrip() {
  constexpr uint64_t kColumns = 60, kRows = 5;
  Mesh mesh;
  for (uint64_t c = 0; c < kColumns; ++c) {
    for (uint64_t r = 0; r < kRows; ++r) {
      double u = 6.283185307179586 * static_cast<double>(c) / kColumns;
      double v = (static_cast<double>(r) - 2) * 0.2;
      double reach = 2 + v * std::cos(u / 2);
      mesh.positions.push_back({reach * std::cos(u), reach * std::sin(u), v * std::sin(u / 2)});
    }
  }
  auto at = [&](uint64_t c, uint64_t r) { return c < kColumns ? c * kRows + r : kRows - 1 - r; };
  for (uint64_t c = 0; c < kColumns; ++c) {
    for (uint64_t r = 0; r + 1 < kRows; ++r) {
      mesh.faces.push_back({at(c, r), at(c + 1, r), at(c + 1, r + 1)});
      mesh.faces.push_back({at(c, r), at(c + 1, r + 1), at(c, r + 1)});
    }
  }
  return mesh;
}

Mesh SmallTorus() { return Torus(24, 12); }

Mesh CutOutOfVoxels() { return VoxelTerrain(24, 22, 5); }

Mesh SeparateTriangles() {
  Mesh mesh = RandomPoints(450, 7);
  for (uint64_t i = 0; i < 450; i += 3) mesh.faces.push_back({i, i + 1, i + 2});
  return mesh;
}

Mesh CollinearVertices() {
  Mesh mesh;
  for (uint64_t i = 0; i < 400; ++i) {
    double t = static_cast<double>(i);
    mesh.positions.push_back({t, 2 * t, -3 * t});
    if (i >= 2) mesh.faces.push_back({i - 2, i - 1, i});
  }
  return mesh;
}

Mesh StripAt(std::vector<Point> positions) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  for (uint64_t i = 2; i < mesh.positions.size(); ++i) mesh.faces.push_back({i - 2, i - 1, i});
  return mesh;
}

Mesh ExponentialDistances() {
  std::vector<Point> positions;
  double x = 1;
  for (int i = 0; i < 30; ++i, x *= 1.7)
    positions.push_back({x, i % 2 == 0 ? x / 3 : 0, i % 3 * x / 5});
  return StripAt(std::move(positions));
}

/// From 2^-90 to 2^90: nearly all of them share one step of the lattice.
Mesh HugeRangeOfDistances() {
  std::vector<Point> positions;
  for (int i = -90; i <= 90; ++i) {
    positions.push_back({std::ldexp(1.0, i), std::ldexp(i % 2 == 0 ? 0.5 : 0, i), 0});
  }
  return StripAt(std::move(positions));
}

/// Terrain at coordinates whose steps as float (1/32 and 1/2) are coarser than the tolerance.
Mesh UtmTerrain() {
  Mesh mesh = FlatGrid(25, 20);
  for (Point& p : mesh.positions) {
    p = {468000 + 30 * p[0], 5250000 + 200 * p[1], 400 + 20 * std::sin(9 * p[0] * p[1])};
  }
  return mesh;
}

Mesh IntegerCoordinates() { return IntegerTerrain(22, 20, 8); }
Mesh FlatMesh() { return FlatGrid(22, 20); }
Mesh DenseRandomFaces() { return RandomFaces(60, 2000, 9); }
Mesh Soup() { return NonManifoldSoup(200, 500, 10); }
Mesh SphereWithHoles() { return BumpySphere(600, true, 11); }

}  // namespace

Mesh RandomFaces(uint64_t vertices, uint64_t faces, uint64_t seed) {
  Random random(seed);
  Mesh mesh = RandomPoints(vertices, seed + 1);
  for (uint64_t i = 0; i < faces; ++i) mesh.faces.push_back(DistinctTriple(&random, vertices));
  return mesh;
}

Mesh NonManifoldSoup(uint64_t vertices, uint64_t faces, uint64_t seed) {
  Random random(seed);
  Mesh mesh = RandomPoints(vertices, seed + 1);
  for (uint64_t i = 0; i < vertices / 10; ++i) {
    mesh.positions[random.Below(vertices)] = mesh.positions[random.Below(vertices)];
  }
  uint64_t used = vertices - vertices / 8;  // the rest stays isolated
  while (mesh.faces.size() < faces) {
    Triple face = DistinctTriple(&random, used);
    mesh.faces.push_back(face);
    switch (random.Below(12)) {
      case 0:
        mesh.faces.push_back({face[2], face[0], face[1]});
        break;
      case 1:
        mesh.faces.push_back({face[0], face[2], face[1]});
        break;
      case 2:
        mesh.faces.push_back({face[0], face[0], face[1]});
        break;
      case 3:
        mesh.faces.push_back({face[1], face[0], face[1]});
        break;
      case 4:
        mesh.faces.push_back({face[0], face[0], face[0]});
        break;
      default:
        break;
    }
  }
  return mesh;
}

const std::vector<SmallMesh>& SmallMeshes() {
  using enum CoordinateType;
  static const std::vector<SmallMesh> meshes{
      {"Empty", Empty},
      {"SingleVertex", SingleVertex},
      {"SingleTriangle", SingleTriangle},
      {"TwoVerticesOneDegenerateFace", TwoVerticesOneDegenerateFace},
      {"VertexThreeTimesInItsFace", VertexThreeTimesInItsFace},
      {"Tetrahedron", Tetrahedron},
      {"PointsWithoutFaces", PointsWithoutFaces},
      {"IsolatedVertices", IsolatedVertices},
      {"AllInOnePoint", AllInOnePoint},
      {"CoincidentPairs", CoincidentPairs},
      {"DuplicateFaces", DuplicateFaces},
      {"OppositeFaces", OppositeFaces},
      {"DegenerateFaces", DegenerateFaces},
      {"OnlyDegenerateFaces", OnlyDegenerateFaces},
      {"EdgeFan", EdgeFan},
      {"OpenTube", OpenTube},
      {"MoebiusStrip", MoebiusStrip},
      {"Torus", SmallTorus},
      {"SeparateTriangles", SeparateTriangles},
      {"CollinearVertices", CollinearVertices},
      {"ExponentialDistances", ExponentialDistances, kDouble, 24},
      {"HugeRangeOfDistances", HugeRangeOfDistances, kDouble, 24, false},
      {"UtmTerrainAsFloat", UtmTerrain},
      {"UtmTerrainAsDouble", UtmTerrain, kDouble, 20},
      {"IntegerCoordinates", IntegerCoordinates, kInt},
      {"ShortCoordinates", IntegerCoordinates, kShort, 14},
      {"CutOutOfVoxels", CutOutOfVoxels, kInt},
      {"FlatMesh", FlatMesh},
      {"DenseRandomFaces", DenseRandomFaces},
      {"NonManifoldSoup", Soup, kDouble, 20},
      {"SphereWithHoles", SphereWithHoles},
      {"Hub", Hub},
  };
  return meshes;
}

}  // namespace folprom::support
