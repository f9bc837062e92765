#include "engine/codec/subtree_lod.h"

namespace folprom {

double SubtreeLod::Spacing(uint32_t set) const {
  const auto spokes = complex.Spokes(set);
  if (spokes.empty()) return static_cast<double>(sets[set].scale);
  double sum = 0;
  const LanePoint centre(positions[set]);
  for (const auto& spoke : spokes) {
    sum = sum + SpokeBetween(centre, LanePoint(positions[spoke.target])).z_length[1];
  }
  return sum / static_cast<double>(spokes.size());
}

void SubtreeLod::PrefetchRecord(uint32_t set) const {
  __builtin_prefetch(&sets[set]);
  __builtin_prefetch(&positions[set]);
  complex.PrefetchVertex(set);
}

void SubtreeLod::PrefetchRing(uint32_t set) const {
  complex.PrefetchFaces(set);
  for (const auto& spoke : complex.Spokes(set)) {
    __builtin_prefetch(&positions[spoke.target]);
    __builtin_prefetch(&sets[spoke.target]);
  }
}

const std::vector<Int3>& SubtreeLod::Ring(uint32_t set) {
  ring_.clear();
  for (const auto& spoke : complex.Spokes(set)) ring_.push_back(positions[spoke.target]);
  return ring_;
}

double SubtreeLod::MeasureSpokes(uint32_t set, SetStar* star) const {
  const auto spokes = complex.Spokes(set);
  if (star->all_spokes.size() < spokes.size()) star->all_spokes.resize(spokes.size());
  star->set = set;
  star->has_faces = false;
  star->ring = std::span(star->all_spokes).first(spokes.size());
  const LanePoint centre(positions[set]);
  double sum = 0;
  for (size_t n = 0; n < spokes.size(); ++n) {
    const RingSpoke spoke = SpokeBetween(centre, LanePoint(positions[spokes[n].target]));
    star->all_spokes[n] = spoke;
    sum = sum + spoke.z_length[1];
  }
  if (spokes.empty()) return static_cast<double>(sets[set].scale);
  return sum / static_cast<double>(spokes.size());
}

void SubtreeLod::MeasureFaces(SetStar* star) const {
  if (star->has_faces) return;
  const auto corners = complex.Corners(star->set);
  if (star->all_faces.size() < corners.size()) star->all_faces.resize(corners.size());
  star->has_faces = true;
  star->faces = std::span(star->all_faces).first(corners.size());
  const LanePoint centre(positions[star->set]);
  Pair normal_xy = Both(0);
  double normal_z = 0;
  for (size_t n = 0; n < corners.size(); ++n) {
    const auto [a, b] = complex.Opposite(corners[n]);
    const LanePoint to_a(positions[a]), to_b(positions[b]);
    const Pair z = Pair{to_a.z, to_b.z} - Both(centre.z);
    const FanFace face(to_a.xy - centre.xy, to_b.xy - centre.xy, z);
    normal_xy = normal_xy + face.cross_xy;
    normal_z = normal_z + face.cross_z;
    star->all_faces[n] = face;
  }
  star->normal = {normal_xy[0], normal_xy[1], normal_z};
}

RingShape SubtreeLod::ShapeAround(const SetStar& star) const {
  FanSums fan;
  for (const FanFace& face : star.faces) fan.AddFace(face);
  RingShape shape = MeasureRing(star.ring, fan, static_cast<double>(sets[star.set].scale));
  shape.is_open = star.faces.size() < star.ring.size();
  return shape;
}

LightRing SubtreeLod::LightRingAround(const SetStar& star) const {
  LightRing ring =
      MeasureLightRing(star.ring, star.normal, static_cast<double>(sets[star.set].scale));
  ring.is_open = star.faces.size() < star.ring.size();
  return ring;
}

}  // namespace folprom
