#include "tests/support/stl.h"

#include <algorithm>
#include <cstring>

#include "tests/support/files.h"

namespace folprom::support {

std::string StlBytes(const std::vector<Facet>& facets) {
  std::string bytes(80, 'x');
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<uint32_t>(facets.size()));
  for (const Facet& facet : facets) {
    put(Corner{});
    put(facet);
    put(uint16_t{0});
  }
  return bytes;
}

std::vector<Facet> FacetsOf(const std::string& path) {
  const std::vector<uint8_t> bytes = FileBytes(path);
  std::vector<Facet> facets((bytes.size() - 84) / 50);
  for (size_t f = 0; f < facets.size(); ++f) {
    std::memcpy(&facets[f], bytes.data() + 84 + 50 * f + 12, sizeof(Facet));
  }
  return facets;
}

std::vector<Facet> AsSet(std::vector<Facet> facets) {
  for (Facet& facet : facets) {
    const Facet turns[] = {facet, {facet[1], facet[2], facet[0]}, {facet[2], facet[0], facet[1]}};
    facet = *std::ranges::min_element(turns);
  }
  std::ranges::sort(facets);
  return facets;
}

}  // namespace folprom::support
