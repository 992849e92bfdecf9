#include "scenegraph/decompose.h"

#include <algorithm>
#include <cmath>

#include "base/math/digits.h"
#include "base/math/quaternion.h"

namespace wrlkit {
namespace {

using Rows = std::array<Vec3, 3>;

/// Jacobi's rotations of one side: the columns of `a` are turned until they are square to each other, and those of `v`
/// along.
void square_columns(Rows& a, Rows& v) {
  constexpr int enough = 30;
  for (int sweep = 0; sweep < enough; ++sweep)
    for (auto [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
      double pp = 0, qq = 0, pq = 0;
      for (auto& row : a) {
        pp += row[p] * row[p];
        qq += row[q] * row[q];
        pq += row[p] * row[q];
      }
      if (std::abs(pq) <= 1e-15 * std::sqrt(pp * qq)) continue;
      const double theta = (qq - pp) / (2 * pq);
      const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1)),
                   c = 1 / std::sqrt(t * t + 1), s = t * c;
      for (auto* m : {&a, &v})
        for (auto& row : *m) {
          const double x = row[p], y = row[q];
          row[p] = c * x - s * y;
          row[q] = s * x + c * y;
        }
    }
}

Vec4 axis_angle(const Rows& r) {
  Matrix m;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) m(i, k) = r[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
  return wrlkit::axis_angle(m);
}

/// Columns of unit length, of which some may be unknown: they stand on the others.
void complete(std::array<Vec3, 3>& columns, std::array<bool, 3> known) {
  if (std::ranges::count(known, true) == 1) {
    const auto k = static_cast<std::size_t>(std::ranges::find(known, true) - known.begin());
    const Vec3 across = cross(columns[k], std::abs(columns[k][0]) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
    columns[(k + 1) % 3] = 1 / fast_length(across) * across;
    known[(k + 1) % 3] = true;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (known[k]) continue;
    const auto &a = columns[(k + 1) % 3], &b = columns[(k + 2) % 3];
    columns[k] = cross(a, b);
    if (const double length = std::sqrt(dot(columns[k], columns[k])); length > 0) columns[k] = 1 / length * columns[k];
  }
}

}  // namespace

void without_noise(Vec3& v) {
  const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  for (double& x : v)
    if (std::abs(x) < 1e-15 * largest) x = 0;
}

TransformFields decompose(const Matrix& m) {
  TransformFields out;
  if (std::ranges::any_of(m.m, [](double v) { return !std::isfinite(v); })) return out;
  out.translation = all_to_15_digits(Vec3{m(0, 3), m(1, 3), m(2, 3)});
  without_noise(out.translation);
  Rows a{}, v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int r = 0; r < 3; ++r) a[static_cast<std::size_t>(r)] = {m(r, 0), m(r, 1), m(r, 2)};
  square_columns(a, v);
  std::array<Vec3, 3> u{}, axes{};
  for (std::size_t k = 0; k < 3; ++k) {
    axes[k] = {v[0][k], v[1][k], v[2][k]};
    u[k] = {a[0][k], a[1][k], a[2][k]};
    out.scale[k] = std::sqrt(dot(u[k], u[k]));
  }
  std::array<bool, 3> known{};
  const double largest = std::ranges::max(out.scale);
  for (std::size_t k = 0; k < 3; ++k)
    if ((known[k] = out.scale[k] > 1e-12 * largest))
      u[k] = 1 / out.scale[k] * u[k];
    else
      u[k] = {};
  if (m.determinant() < 0) {  // mirrored along the axis that needs the smallest turn
    const std::array<double, 3> along{dot(u[0], axes[0]), dot(u[1], axes[1]), dot(u[2], axes[2])};
    const auto k = static_cast<std::size_t>(std::ranges::min_element(along) - along.begin());
    u[k] = -1 * u[k];
    out.scale[k] = -out.scale[k];
  }
  if (std::ranges::count(known, true) > 0) {
    complete(u, known);
    Rows r{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) r[i][k] = u[0][i] * v[k][0] + u[1][i] * v[k][1] + u[2][i] * v[k][2];
    out.rotation = all_to_15_digits(axis_angle(r));
  }
  const bool uniform = std::abs(out.scale[0] - out.scale[1]) <= 1e-12 * largest &&
                       std::abs(out.scale[0] - out.scale[2]) <= 1e-12 * largest;
  if (!uniform) out.scale_orientation = all_to_15_digits(axis_angle(v));
  out.scale = all_to_15_digits(out.scale);
  return out;
}

}  // namespace wrlkit
