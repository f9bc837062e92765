// Normal equations of a few unknowns.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace folprom {

/// Solves K equations, the last column being the right side, by elimination without pivoting, which
/// is stable while the matrix is positive definite. Returns false, and leaves the solution as it
/// is, where rounding has made it anything else.
template <size_t K>
bool SolvePositive(std::array<std::array<double, K + 1>, K> a, std::array<double, K>* solution) {
  for (size_t k = 0; k < K; ++k) {
    if (!(a[k][k] > 0)) return false;
    for (size_t i = k + 1; i < K; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (size_t j = k; j <= K; ++j) a[i][j] = a[i][j] - factor * a[k][j];
    }
  }
  std::array<double, K> found;
  for (size_t k = K; k-- > 0;) {
    double sum = a[k][K];
    for (size_t j = k + 1; j < K; ++j) sum = sum - a[k][j] * found[j];
    found[k] = sum / a[k][k];
    if (!(std::fabs(found[k]) < 1e12)) return false;
  }
  *solution = found;
  return true;
}

}  // namespace folprom
