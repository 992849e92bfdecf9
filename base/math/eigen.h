// Eigenvectors of small symmetric matrices.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

namespace wrlkit {

/// Eigenvectors of a symmetric matrix of N rows as columns of `vectors`, and its eigenvalues; Jacobi's method.
template <std::size_t N>
void diagonalise(std::array<std::array<double, N>, N> a, std::array<std::array<double, N>, N>& vectors,
                 std::array<double, N>& values) {
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < N; ++k) vectors[i][k] = i == k;
  for (int sweep = 0; sweep < 30; ++sweep)
    for (std::size_t p = 0; p < N; ++p)
      for (std::size_t q = p + 1; q < N; ++q) {
        if (std::abs(a[p][q]) <= 1e-16 * std::sqrt(std::abs(a[p][p] * a[q][q]))) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1)),
                     c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (std::size_t i = 0; i < N; ++i) {
          const double x = a[i][p], y = a[i][q];
          a[i][p] = c * x - s * y;
          a[i][q] = s * x + c * y;
        }
        for (std::size_t i = 0; i < N; ++i) {
          const double x = a[p][i], y = a[q][i];
          a[p][i] = c * x - s * y;
          a[q][i] = s * x + c * y;
          const double u = vectors[i][p], v = vectors[i][q];
          vectors[i][p] = c * u - s * v;
          vectors[i][q] = s * u + c * v;
        }
      }
  for (std::size_t i = 0; i < N; ++i) values[i] = a[i][i];
}

}  // namespace wrlkit
