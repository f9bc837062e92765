#include "engine/hierarchy/lloyd_tree.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/entropy/fixed_math.h"

namespace folprom {

namespace {
constexpr uint32_t kMostChildren = 8;
/// Sets this deep come from vertices crowded beyond reason; they are halved instead.
constexpr uint32_t kDeepest = 48;
/// The coordinate range for which the paper gives a = 1, b = 8.
constexpr double kPaperRange = 4096;
/// What a unit of distance along the surface counts beside one across it: keeps sets from growing
/// without end where the surface is flat, and quadrics from having more than one lowest point.
constexpr double kAlongSurface = 0.05;
constexpr double kNearCentre = 0.06;
}  // namespace

/// Builds one tree. Points are copied into the order of the tree, so that every pass is contiguous.
class LloydBuilder {
 public:
  LloydBuilder(std::span<const Int3> positions, const SurfaceAttributes& surface,
               double longest_side, const CodecSettings& settings)
      : settings_(settings), scale_(longest_side > 0 ? kPaperRange / longest_side : 1) {
    points_.reserve(positions.size());
    order_.reserve(positions.size());
    for (uint32_t i = 0; i < positions.size(); ++i) {
      const Int3& p = positions[i];
      points_.push_back({scale_ * Eigen::Vector3d(p.x, p.y, p.z), surface.normals[i],
                         surface.curvature[i], surface.areas[i]});
      box_lo_ = {std::min(box_lo_.x, p.x), std::min(box_lo_.y, p.y), std::min(box_lo_.z, p.z)};
      box_hi_ = {std::max(box_hi_.x, p.x), std::max(box_hi_.y, p.y), std::max(box_hi_.z, p.z)};
      order_.push_back(i);
    }
    scratch_points_.resize(points_.size());
    scratch_order_.resize(points_.size());
    cluster_.resize(points_.size());
    positions_ = positions;
  }

  SetTree Build() {
    nodes_.reserve(points_.size() + points_.size() / 2);
    nodes_.push_back({0, static_cast<uint32_t>(points_.size()), 0, 0, {}, 0});
    std::vector<std::pair<uint32_t, uint32_t>> pending{{0, 0}};  // node, depth
    while (!pending.empty()) {
      auto [index, depth] = pending.back();
      pending.pop_back();
      nodes_[index].representative = Representative(index);
      nodes_[index].distortion = Distortion(nodes_[index]);
      uint32_t first = SplitNode(index, depth);
      for (uint32_t i = nodes_[index].child_count; i-- > 0;) {
        pending.push_back({first + i, depth + 1});
      }
    }
    return {std::move(nodes_), std::move(order_)};
  }

 private:
  struct Point {
    Eigen::Vector3d position;  ///< paper units
    Eigen::Vector3d normal;
    double curvature;
    double area;  ///< lattice units squared
  };
  struct Centre {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  };

  static double Length(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return (a - b).norm();
  }
  double Distance(const Point& point, const Centre& centre) const {
    double euclidean = Length(point.position, centre.position);
    if (normal_weight_ == 0) return euclidean;
    return normal_weight_ * Length(point.normal, centre.normal) + (1 - normal_weight_) * euclidean;
  }

  Centre MeanOf(uint32_t begin, uint32_t end) const {
    Centre mean;
    for (uint32_t i = begin; i < end; ++i) AddTo(&mean, points_[i]);
    return Normalised(mean, end - begin);
  }
  static void AddTo(Centre* sum, const Point& point) {
    sum->position += point.position;
    sum->normal += point.normal;
  }
  static Centre Normalised(Centre sum, uint32_t count) {
    double length = sum.normal.norm();
    sum.position /= count;
    if (length > 0) sum.normal /= length;
    return sum;
  }

  /// w_n = 1 - a (1 - ave(d_n)/2)^b.
  double NormalWeight(uint32_t begin, uint32_t end, const Centre& mean) const {
    if (!settings_.normal_metric) return 0;
    double sum = 0;
    for (uint32_t i = begin; i < end; ++i) sum = sum + Length(points_[i].normal, mean.normal);
    double base = 1 - sum / (end - begin) / 2;
    if (!(base > 0)) return 1;
    double power =
        ExpExact(std::max(settings_.metric_b * Log2Exact(base) * 0.6931471805599453, -39.0));
    return std::clamp(1 - settings_.metric_a * power, 0.0, 1.0);
  }

  Int3 Representative(uint32_t index) const {
    const SetTree::Node& node = nodes_[index];
    uint32_t count = node.end - node.begin;
    if (count == 1) return positions_[order_[node.begin]];
    int64_t sum[3] = {0, 0, 0};
    for (uint32_t i = node.begin; i < node.end; ++i) {
      const Int3& p = positions_[order_[i]];
      sum[0] += p.x;
      sum[1] += p.y;
      sum[2] += p.z;
    }
    auto centre = [&](int axis) { return static_cast<int32_t>((sum[axis] + count / 2) / count); };
    Int3 middle{centre(0), centre(1), centre(2)};
    if (settings_.representative == Representative::kCentre) return middle;
    if (settings_.representative == Representative::kQuadric) return QuadricPoint(node, middle);
    uint32_t chosen = CurvedVertex(node);
    return chosen == node.end ? middle : positions_[order_[chosen]];
  }

  /// The point nearest to the tangent planes of the members, in the least-squares sense, with a
  /// pull towards the centre; inside the box of all vertices. Faces cut below a convex surface, and
  /// centres lie below it too; this lies as far above.
  Int3 QuadricPoint(const SetTree::Node& node, const Int3& centre) const {
    const Eigen::Vector3d middle = scale_ * Eigen::Vector3d(centre.x, centre.y, centre.z);
    Eigen::Matrix3d planes = Eigen::Matrix3d::Zero();
    Eigen::Vector3d heights = Eigen::Vector3d::Zero();
    double areas = 0;
    for (uint32_t i = node.begin; i < node.end; ++i) {
      const Point& point = points_[i];
      planes += point.area * point.normal * point.normal.transpose();
      heights += point.area * point.normal.dot(point.position - middle) * point.normal;
      areas += point.area;
    }
    if (!(areas > 0)) return centre;
    planes += kNearCentre * areas * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d best = (middle + planes.inverse() * heights) / scale_;
    auto rounded = [](double value, int32_t lo, int32_t hi) {
      value = std::clamp(value, static_cast<double>(lo), static_cast<double>(hi));
      return static_cast<int32_t>(value + 0.5);  // coordinates are never negative
    };
    return {rounded(best[0], box_lo_.x, box_hi_.x), rounded(best[1], box_lo_.y, box_hi_.y),
            rounded(best[2], box_lo_.z, box_hi_.z)};
  }

  /// Area times distance of the members' tangent planes from the representative.
  double Distortion(const SetTree::Node& node) const {
    if (node.end - node.begin == 1) return 0;
    const Int3& r = node.representative;
    const Eigen::Vector3d centre = scale_ * Eigen::Vector3d(r.x, r.y, r.z);
    double sum = 0;
    for (uint32_t i = node.begin; i < node.end; ++i) {
      const Point& point = points_[i];
      const Eigen::Vector3d d = point.position - centre;
      sum = sum + point.area * (std::fabs(d.dot(point.normal)) + kAlongSurface * d.norm());
    }
    return sum / scale_;
  }

  /// Place of the vertex of highest priority p_i, node.end where curvature hardly varies.
  uint32_t CurvedVertex(const SetTree::Node& node) const {
    double count = node.end - node.begin, sum = 0, squares = 0;
    for (uint32_t i = node.begin; i < node.end; ++i) {
      sum = sum + points_[i].curvature;
      squares = squares + points_[i].curvature * points_[i].curvature;
    }
    double variance = squares / count - (sum / count) * (sum / count);
    double threshold = settings_.curvature_threshold;
    if (!(variance > threshold * threshold)) return node.end;
    Centre mean = MeanOf(node.begin, node.end);
    double distances = 0;
    for (uint32_t i = node.begin; i < node.end; ++i) {
      distances = distances + Length(points_[i].position, mean.position);
    }
    double sigma = settings_.gaussian_ratio * distances / count;
    uint32_t best = node.end;
    double highest = -1;
    for (uint32_t i = node.begin; i < node.end; ++i) {
      double distance = Length(points_[i].position, mean.position);
      double exponent = sigma > 0 ? -distance * distance / (2 * sigma * sigma) : 0;
      double priority = points_[i].curvature * ExpExact(std::max(exponent, -39.0));
      if (priority > highest) {
        highest = priority;
        best = i;
      }
    }
    return best;
  }

  /// Makes the children of a node; returns the first.
  uint32_t SplitNode(uint32_t index, uint32_t depth) {
    uint32_t begin = nodes_[index].begin, end = nodes_[index].end;
    uint32_t count = end - begin, first = static_cast<uint32_t>(nodes_.size());
    if (count == 1) return first;
    uint32_t children = std::min(count, settings_.children);
    std::array<uint32_t, kMostChildren + 1> bounds{};
    if (count <= settings_.children) {
      for (uint32_t i = 0; i <= children; ++i) bounds[i] = begin + i;
    } else if (depth >= kDeepest || !Cluster(begin, end, children)) {
      for (uint32_t i = 0; i <= children; ++i) {
        bounds[i] = begin + static_cast<uint32_t>(uint64_t{count} * i / children);
      }
    } else {
      Reorder(begin, end, children, &bounds);
    }
    nodes_[index].first_child = first;
    nodes_[index].child_count = children;
    for (uint32_t i = 0; i < children; ++i)
      nodes_.push_back({bounds[i], bounds[i + 1], 0, 0, {}, 0});
    return first;
  }

  /// Assigns cluster_[begin, end). False when some cluster stays empty (coincident vertices).
  bool Cluster(uint32_t begin, uint32_t end, uint32_t children) {
    Centre mean = MeanOf(begin, end);
    normal_weight_ = NormalWeight(begin, end, mean);
    std::array<Centre, kMostChildren> centres{};
    Seed(begin, end, children, &centres);
    double before = 0;
    for (uint32_t iteration = 0; iteration < settings_.lloyd_iterations; ++iteration) {
      double distortion = Assign(begin, end, children, centres);
      if (iteration > 0 && before - distortion <= settings_.lloyd_threshold * before) break;
      before = distortion;
      Update(begin, end, children, &centres);
    }
    std::array<uint32_t, kMostChildren> sizes{};
    for (uint32_t i = begin; i < end; ++i) ++sizes[cluster_[i]];
    return std::all_of(sizes.begin(), sizes.begin() + children, [](uint32_t n) { return n > 0; });
  }

  /// Cuts the part that is widest along a coordinate axis at its mean, until there are enough
  /// parts; their means are the first centres. Farthest points as seeds leave outliers as sets of
  /// their own high up in the tree, where positions are still coarse.
  void Seed(uint32_t begin, uint32_t end, uint32_t children,
            std::array<Centre, kMostChildren>* centres) {
    std::fill(cluster_.begin() + begin, cluster_.begin() + end, uint8_t{0});
    for (uint32_t made = 1; made < children; ++made) {
      auto [widest, axis, mean] = WidestPart(begin, end, made);
      for (uint32_t i = begin; i < end; ++i) {
        if (cluster_[i] == widest && points_[i].position[axis] > mean) {
          cluster_[i] = static_cast<uint8_t>(made);
        }
      }
    }
    Update(begin, end, children, centres);
  }

  struct Part {
    uint32_t cluster;
    int axis;
    double mean;
  };
  Part WidestPart(uint32_t begin, uint32_t end, uint32_t parts) const {
    std::array<Eigen::Vector3d, kMostChildren> sums, squares;
    sums.fill(Eigen::Vector3d::Zero());
    squares.fill(Eigen::Vector3d::Zero());
    std::array<double, kMostChildren> counts{};
    for (uint32_t i = begin; i < end; ++i) {
      const Eigen::Vector3d& position = points_[i].position;
      sums[cluster_[i]] += position;
      squares[cluster_[i]] += position.cwiseProduct(position);
      counts[cluster_[i]] += 1;
    }
    Part widest{0, 0, 0};
    double most = -1;
    for (uint32_t c = 0; c < parts; ++c) {
      if (counts[c] == 0) continue;
      for (int axis = 0; axis < 3; ++axis) {
        double mean = sums[c][axis] / counts[c];
        double spread = squares[c][axis] - sums[c][axis] * mean;
        if (spread > most) {
          most = spread;
          widest = {c, axis, mean};
        }
      }
    }
    return widest;
  }

  double Assign(uint32_t begin, uint32_t end, uint32_t children,
                const std::array<Centre, kMostChildren>& centres) {
    double distortion = 0;
    for (uint32_t i = begin; i < end; ++i) {
      double nearest = Distance(points_[i], centres[0]);
      uint8_t chosen = 0;
      for (uint32_t c = 1; c < children; ++c) {
        double distance = Distance(points_[i], centres[c]);
        if (distance < nearest) {
          nearest = distance;
          chosen = static_cast<uint8_t>(c);
        }
      }
      cluster_[i] = chosen;
      distortion = distortion + nearest;
    }
    return distortion;
  }

  void Update(uint32_t begin, uint32_t end, uint32_t children,
              std::array<Centre, kMostChildren>* centres) const {
    std::array<Centre, kMostChildren> sums{};
    std::array<uint32_t, kMostChildren> sizes{};
    for (uint32_t i = begin; i < end; ++i) {
      AddTo(&sums[cluster_[i]], points_[i]);
      ++sizes[cluster_[i]];
    }
    for (uint32_t c = 0; c < children; ++c) {
      if (sizes[c] > 0) (*centres)[c] = Normalised(sums[c], sizes[c]);
    }
  }

  void Reorder(uint32_t begin, uint32_t end, uint32_t children,
               std::array<uint32_t, kMostChildren + 1>* bounds) {
    uint32_t next = begin;
    for (uint32_t c = 0; c < children; ++c) {
      (*bounds)[c] = next;
      for (uint32_t i = begin; i < end; ++i) {
        if (cluster_[i] != c) continue;
        scratch_points_[next] = points_[i];
        scratch_order_[next++] = order_[i];
      }
    }
    (*bounds)[children] = end;
    std::copy(scratch_points_.begin() + begin, scratch_points_.begin() + end,
              points_.begin() + begin);
    std::copy(scratch_order_.begin() + begin, scratch_order_.begin() + end, order_.begin() + begin);
  }

  const CodecSettings& settings_;
  double scale_;
  double normal_weight_ = 0;
  Int3 box_lo_{INT32_MAX, INT32_MAX, INT32_MAX}, box_hi_{0, 0, 0};
  std::span<const Int3> positions_;
  std::vector<Point> points_, scratch_points_;
  std::vector<uint32_t> scratch_order_;
  std::vector<uint8_t> cluster_;
  std::vector<SetTree::Node> nodes_;
  std::vector<uint32_t> order_;
};

SetTree BuildLloydTree(std::span<const Int3> positions, const SurfaceAttributes& surface,
                       double longest_side, const CodecSettings& settings) {
  return LloydBuilder(positions, surface, longest_side, settings).Build();
}

}  // namespace folprom
