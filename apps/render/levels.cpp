#include "apps/render/levels.h"

#include <algorithm>
#include <cmath>

namespace folprom::render {
namespace {

// Of the coarsest mesh: this many, of small files this part of all.
constexpr double kFirstVertices = 300, kFirstPart = 1.0 / 40;

// Rising, each once.
std::vector<uint32_t> Tidied(std::vector<uint32_t> levels) {
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

std::span<const LayerInfo> Present(const FileInfo& info) {
  const auto count = std::min<uint64_t>(info.layers_present, info.layers.size());
  return {info.layers.data(), static_cast<size_t>(count)};
}

double LogVertices(const LayerInfo& layer) {
  return std::log(static_cast<double>(std::max<uint64_t>(layer.vertices, 1)));
}

}  // namespace

std::vector<uint32_t> SpreadLevels(const FileInfo& info, size_t count) {
  const auto layers = Present(info);
  if (layers.size() < 2) return {};
  const double last = LogVertices(layers.back());
  const double wanted_first = std::min(std::log(kFirstVertices), last + std::log(kFirstPart));
  const double first = std::max(wanted_first, std::min(LogVertices(layers.front()), last));
  std::vector<uint32_t> levels;
  for (size_t i = 0; i < count; ++i) {
    const double wanted =
        first + (last - first) * static_cast<double>(i) / static_cast<double>(count);
    size_t nearest = 0;
    for (size_t layer = 0; layer + 1 < layers.size(); ++layer) {
      const auto miss = [&](size_t l) { return std::abs(LogVertices(layers[l]) - wanted); };
      if (miss(layer) < miss(nearest)) nearest = layer;
    }
    levels.push_back(static_cast<uint32_t>(nearest + 1));
  }
  return Tidied(std::move(levels));
}

std::vector<uint32_t> LevelsAt(const FileInfo& info, std::span<const double> rates) {
  const auto layers = Present(info);
  std::vector<uint32_t> levels;
  for (const double rate : rates) {
    const auto fitting = std::count_if(layers.begin(), layers.end(), [&](const LayerInfo& layer) {
      return layer.bits_per_vertex <= rate;
    });
    if (!layers.empty()) levels.push_back(static_cast<uint32_t>(std::max<ptrdiff_t>(fitting, 1)));
  }
  return Tidied(std::move(levels));
}

}  // namespace folprom::render
