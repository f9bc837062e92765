#include "engine/geometry/local_frame.h"

#include <algorithm>
#include <cmath>

namespace folprom {
namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// One Jacobi rotation that clears a[p][q] of a symmetric matrix.
void Rotate(Matrix3& a, Matrix3& vectors, size_t p, size_t q) {
  if (a[p][q] == 0) return;
  double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  double t = 1 / ((theta < 0 ? -theta : theta) + std::sqrt(theta * theta + 1));
  if (theta < 0) t = -t;
  double c = 1 / std::sqrt(t * t + 1), s = t * c;
  for (size_t k = 0; k < 3; ++k) {
    double kp = a[k][p], kq = a[k][q];
    a[k][p] = c * kp - s * kq;
    a[k][q] = s * kp + c * kq;
  }
  for (size_t k = 0; k < 3; ++k) {
    double pk = a[p][k], qk = a[q][k];
    a[p][k] = c * pk - s * qk;
    a[q][k] = s * pk + c * qk;
  }
  for (size_t k = 0; k < 3; ++k) {
    double kp = vectors[k][p], kq = vectors[k][q];
    vectors[k][p] = c * kp - s * kq;
    vectors[k][q] = s * kp + c * kq;
  }
}

/// Unit eigenvector of the smallest eigenvalue; its largest component is positive.
Vector3 SmallestAxis(Matrix3 a) {
  Matrix3 vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int sweep = 0; sweep < 6; ++sweep) {
    double off = a[0][1] * a[0][1] + a[0][2] * a[0][2] + a[1][2] * a[1][2];
    double on = a[0][0] * a[0][0] + a[1][1] * a[1][1] + a[2][2] * a[2][2];
    if (off <= on * 1e-20) break;
    Rotate(a, vectors, 0, 1);
    Rotate(a, vectors, 0, 2);
    Rotate(a, vectors, 1, 2);
  }
  size_t smallest = 0;
  for (size_t i = 1; i < 3; ++i) {
    if (a[i][i] < a[smallest][smallest]) smallest = i;
  }
  Vector3 axis{vectors[0][smallest], vectors[1][smallest], vectors[2][smallest]};
  double length = std::sqrt(Dot(axis, axis));
  size_t largest = 0;
  for (size_t i = 1; i < 3; ++i) {
    if (axis[i] * axis[i] > axis[largest] * axis[largest]) largest = i;
  }
  if (axis[largest] < 0) length = -length;
  for (double& value : axis) value = value / length;
  return axis;
}

}  // namespace

Vector3 TangentAxis(const Vector3& normal) {
  size_t flattest = 0;
  for (size_t i = 1; i < 3; ++i) {
    if (normal[i] * normal[i] < normal[flattest] * normal[flattest]) flattest = i;
  }
  Vector3 axis{0, 0, 0};
  axis[flattest] = 1;
  double height = normal[flattest];
  for (size_t i = 0; i < 3; ++i) axis[i] = axis[i] - height * normal[i];
  double length = std::sqrt(Dot(axis, axis));
  for (double& value : axis) value = value / length;
  return axis;
}

Neighbourhood MeasureNeighbourhood(const Int3& vertex, std::span<const Int3> neighbours,
                                   double scale) {
  Neighbourhood result;
  result.frame.origin = vertex;
  if (neighbours.empty()) {
    result.range_rho = result.range_z = scale;
    result.min_z = -scale / 2;
    return result;
  }
  // Covariance of the neighbours and the vertex, which is the origin.
  Vector3 mean{0, 0, 0};
  Matrix3 moments{};
  for (const Int3& neighbour : neighbours) {
    Vector3 d = Difference(neighbour, vertex);
    for (size_t i = 0; i < 3; ++i) {
      mean[i] = mean[i] + d[i];
      for (size_t j = i; j < 3; ++j) moments[i][j] = moments[i][j] + d[i] * d[j];
    }
  }
  double count = static_cast<double>(neighbours.size()) + 1;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = i; j < 3; ++j) {
      moments[i][j] = moments[i][j] - mean[i] * mean[j] / count;
      moments[j][i] = moments[i][j];
    }
  }
  result.frame.z = SmallestAxis(moments);
  result.frame.x = TangentAxis(result.frame.z);
  double largest2 = 0, low = 0, high = 0, sum = 0;
  Vector3 y = result.frame.y();
  result.directions.reserve(neighbours.size());
  for (const Int3& neighbour : neighbours) {
    Vector3 d = Difference(neighbour, vertex);
    double z = Dot(d, result.frame.z);
    double u = Dot(d, result.frame.x), v = Dot(d, y), squared = u * u + v * v;
    if (squared > 0) {
      double rho = std::sqrt(squared);
      result.directions.push_back({u / rho, v / rho, rho, z / squared});
    }
    largest2 = std::max(largest2, squared);
    low = std::min(low, z);
    high = std::max(high, z);
    sum = sum + z;
  }
  result.range_rho = std::sqrt(largest2);
  result.range_z = neighbours.size() < 3 ? result.range_rho : high - low;
  result.mean_z = sum / static_cast<double>(neighbours.size());
  result.min_z = low;
  if (!(result.range_rho > 0)) result.range_rho = scale;
  return result;
}

Neighbourhood::Outlook Neighbourhood::Towards(double cosine, double sine) const {
  Outlook outlook;
  double weights = 0;
  for (const Direction& direction : directions) {
    double nearness = 1.02 + direction.x * cosine + direction.y * sine;
    double weight = nearness * nearness;
    weight = weight * weight;
    weight = weight * weight;
    weights = weights + weight;
    outlook.rho = outlook.rho + weight * direction.rho;
    outlook.bend = outlook.bend + weight * direction.bend;
  }
  if (weights > 0) {
    outlook.rho = outlook.rho / weights;
    outlook.bend = outlook.bend / weights;
  }
  return outlook;
}

}  // namespace folprom
