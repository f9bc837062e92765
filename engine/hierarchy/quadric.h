// A quadric: weighted squared distances from planes, as one quadratic form.
#pragma once

#include <array>

namespace folprom {

/// Sum over planes of weight * (n . p + d)^2, and the sum of the weights.
struct Quadric {
  std::array<double, 10> terms{};  ///< xx xy xz xd yy yz yd zz zd dd
  double weight = 0;

  void AddPlane(const std::array<double, 3>& normal, double offset, double plane_weight) {
    const std::array<double, 4> p{normal[0], normal[1], normal[2], offset};
    size_t k = 0;
    for (size_t i = 0; i < 4; ++i) {
      for (size_t j = i; j < 4; ++j) {
        terms[k] = terms[k] + plane_weight * p[i] * p[j];
        ++k;
      }
    }
    weight = weight + plane_weight;
  }
  void Add(const Quadric& other) {
    for (size_t k = 0; k < terms.size(); ++k) terms[k] = terms[k] + other.terms[k];
    weight = weight + other.weight;
  }
  double At(const std::array<double, 3>& p) const {
    const double value =
        p[0] * (terms[0] * p[0] + 2 * (terms[1] * p[1] + terms[2] * p[2] + terms[3])) +
        p[1] * (terms[4] * p[1] + 2 * (terms[5] * p[2] + terms[6])) +
        p[2] * (terms[7] * p[2] + 2 * terms[8]) + terms[9];
    return value > 0 ? value : 0;
  }
};

}  // namespace folprom
