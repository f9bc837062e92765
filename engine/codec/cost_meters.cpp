#include "engine/codec/cost_meters.h"

#include <algorithm>

namespace folprom {

CostMeters& CostMeters::operator+=(const CostMeters& other) {
  split += other.split;
  root += other.root;
  refinement += other.refinement;
  exceptions += other.exceptions;
  seams += other.seams;
  rests += other.rests;
  offsets.theta += other.offsets.theta;
  offsets.rho += other.offsets.rho;
  offsets.z += other.offsets.z;
  connectivity.connected += other.connectivity.connected;
  connectivity.pivots += other.connectivity.pivots;
  connectivity.sides += other.connectivity.sides;
  attributes.resize(std::max(attributes.size(), other.attributes.size()), 0);
  for (size_t a = 0; a < other.attributes.size(); ++a) attributes[a] += other.attributes[a];
  return *this;
}

}  // namespace folprom
