// Binary STL without any code of the project.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace folprom::support {

/// The bits of floats.
using Corner = std::array<uint32_t, 3>;
using Facet = std::array<Corner, 3>;

std::string StlBytes(const std::vector<Facet>& facets);
/// Of a file of facets.
std::vector<Facet> FacetsOf(const std::string& path);
/// Each begins with its least corner, and all are sorted.
std::vector<Facet> AsSet(std::vector<Facet> facets);

}  // namespace folprom::support
