#include "apps/folprom/published_rates.h"

namespace folprom::cli {
namespace {

constexpr PublishedPoint kDragonPaper[] = {{1, 4.2}, {2, 2.2},  {4, 1.5},
                                           {8, 0.9}, {12, 0.7}, {16, 0.6}};
constexpr PublishedPoint kHorsePaper[] = {{1, 16.0}, {2, 10.3}, {4, 5.3},
                                          {8, 3.4},  {12, 2.0}, {16, 1.3}};
constexpr PublishedPoint kIgeaPaper[] = {{1, 4.6}, {2, 2.9},  {4, 2.1},
                                         {8, 1.4}, {12, 1.2}, {16, 0.7}};

constexpr PublishedPoint kDragonSimplify[] = {{0.25, 4.1}, {0.5, 2.6}, {1, 1.33}, {2, 0.77},
                                              {4, 0.52},   {8, 0.30},  {12, 0.25}};
constexpr PublishedPoint kIgeaSimplify[] = {{0.25, 6.6}, {0.5, 4.1}, {1, 2.2},  {2, 1.2},
                                            {4, 0.72},   {8, 0.43},  {12, 0.13}};
constexpr PublishedPoint kHorseSimplify[] = {{0.25, 30.8}, {0.5, 17.1}, {1, 8.3},  {2, 4.4},
                                             {4, 2.2},     {8, 1.06},   {12, 0.60}};
constexpr PublishedPoint kFandiskSimplify[] = {{0.25, 52.7}, {0.5, 13.2}, {1, 3.9},  {2, 1.5},
                                               {4, 0.50},    {8, 0.25},   {12, 0.18}};
constexpr PublishedPoint kVenusSimplify[] = {{0.25, 109}, {0.5, 46}, {1, 19.4}, {2, 10.9},
                                             {4, 6.2},    {8, 3.2},  {12, 1.8}};

constexpr PublishedScan kScans[] = {{437'645, kDragonPaper, kDragonSimplify},
                                    {134'345, kIgeaPaper, kIgeaSimplify},
                                    {19'851, kHorsePaper, kHorseSimplify},
                                    {6'475, {}, kFandiskSimplify},
                                    {8'268, {}, kVenusSimplify}};

}  // namespace

const PublishedScan* PublishedFor(uint64_t vertices) {
  for (const PublishedScan& scan : kScans) {
    if (scan.vertices == vertices) return &scan;
  }
  return nullptr;
}

double ErrorAt(std::span<const PublishedPoint> points, double bits_per_vertex) {
  for (const PublishedPoint& point : points) {
    if (point.bits_per_vertex == bits_per_vertex) return point.error;
  }
  return 0;
}

}  // namespace folprom::cli
