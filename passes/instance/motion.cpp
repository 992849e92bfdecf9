#include "passes/instance/motion.h"

#include <algorithm>

#include "base/math/eigen.h"
#include "scenegraph/decompose.h"

namespace wrlkit::instancing {
namespace {

using Rows = std::array<std::array<double, 3>, 3>;

/// Sum of b a^T.
Rows products(std::span<const Vec3> a, std::span<const Vec3> b) {
  Rows s{};
  for (std::size_t n = 0; n < a.size(); ++n)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) s[i][k] += b[n][i] * a[n][k];
  return s;
}

Matrix of_quaternion(double w, double x, double y, double z) {
  return matrix_of_columns({1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                           {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                           {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)});
}

/// The rotation for which the sum of b . R a is the largest.
Matrix rotation(const Rows& s) {
  const double sum = s[0][0] + s[1][1] + s[2][2], x = s[2][1] - s[1][2], y = s[0][2] - s[2][0], z = s[1][0] - s[0][1];
  std::array<std::array<double, 4>, 4> n{{{sum, x, y, z}, {x}, {y}, {z}}}, vectors{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) n[i + 1][k + 1] = i == k ? 2 * s[i][i] - sum : s[i][k] + s[k][i];
  std::array<double, 4> values{};
  diagonalise(n, vectors, values);
  const auto best = static_cast<std::size_t>(std::ranges::max_element(values) - values.begin());
  return of_quaternion(vectors[0][best], vectors[1][best], vectors[2][best], vectors[3][best]);
}

/// Any linear map; along directions in which `from` has no extent that of the rotation.
Matrix linear_map(std::span<const Vec3> from, std::span<const Vec3> to, const Matrix& turn) {
  Rows axes{};
  std::array<double, 3> values{};
  diagonalise(products(from, from), axes, values);
  const Rows s = products(from, to);
  const double largest = std::ranges::max(values);
  Matrix out;
  out.m = {};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 e{axes[0][k], axes[1][k], axes[2][k]};
    Vec3 image = turn.point(e);
    if (values[k] > 1e-12 * largest)
      for (std::size_t i = 0; i < 3; ++i) image[i] = (s[i][0] * e[0] + s[i][1] * e[1] + s[i][2] * e[2]) / values[k];
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c) out(i, c) += image[static_cast<std::size_t>(i)] * e[static_cast<std::size_t>(c)];
  }
  return out;
}

/// To a decimal, no coarser than the step.
double rounded(double v, double step) {
  if (!(step > 0) || !std::isfinite(v)) return v;
  const double digits = std::clamp(std::ceil(-std::log10(step)), -12.0, 15.0), unit = std::pow(10.0, std::abs(digits));
  const double r = digits < 0 ? std::round(v / unit) * unit : std::round(v * unit) / unit;
  return r == 0 ? 0 : r;
}

}  // namespace

Matrix fit(std::span<const Vec3> from, std::span<const Vec3> to, Scaling scaling, bool mirrored) {
  Rows s = products(from, to);
  if (mirrored)
    for (auto& row : s)
      for (double& v : row) v = -v;
  Matrix turn = rotation(s);
  double factor = mirrored ? -1 : 1;
  if (scaling != Scaling::none) {
    double a = 0, b = 0;
    for (const Vec3& p : from) a += p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    for (const Vec3& p : to) b += p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    if (a > 0) factor *= std::sqrt(b / a);
  }
  turn = turn * scale_matrix({factor, factor, factor});
  return scaling == Scaling::axis ? linear_map(from, to, turn) : turn;
}

TransformFields in_few_digits(const Matrix& linear, const Vec3& from, const Vec3& to, double reach, double step) {
  TransformFields f = decompose(linear);
  const double share = step / 4, turn = std::min(share / std::max(reach, 1e-300), 1e-3);
  if (std::abs(f.rotation[3]) < turn / 2) f.rotation = {0, 0, 1, 0};
  for (double& v : f.rotation) v = rounded(v, turn / 2);
  const double mean = (f.scale[0] + f.scale[1] + f.scale[2]) / 3;
  const bool uniform = std::ranges::all_of(f.scale, [&](double v) { return std::abs(v - mean) < turn / 2; });
  for (double& v : f.scale) {
    if (uniform) v = mean;
    v = std::abs(v - 1) < turn / 2 ? 1 : rounded(v, turn / 2);
  }
  if (uniform) f.scale_orientation = {0, 0, 1, 0};
  for (double& v : f.scale_orientation) v = rounded(v, turn / 4);
  const Vec3 moved = matrix_of(f).point(from);
  for (std::size_t k = 0; k < 3; ++k) f.translation[k] = rounded(to[k] - moved[k], share);
  return f;
}

}  // namespace wrlkit::instancing
