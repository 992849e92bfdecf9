#include "passes/lower_vrml1/placement.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/math/axis_angle.h"

namespace wrlkit::vrml1 {
namespace {

using Rows = std::array<Vec3, 3>;

/// Fifteen digits: 0.1 + 0.2 is 0.3.
double tidy(double v) {
  char b[40];
  auto end = std::to_chars(b, b + sizeof b, v, std::chars_format::general, 15).ptr;
  std::from_chars(b, end, v);
  return v == 0 ? 0 : v;
}

template <std::size_t N>
std::array<double, N> tidy(std::array<double, N> a) {
  for (double& v : a) v = tidy(v);
  return a;
}

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec3 scaled(const Vec3& a, double f) { return {a[0] * f, a[1] * f, a[2] * f}; }

/// One after the other in one Transform; none where it takes two.
std::optional<TransformFields> sum(const TransformFields& a, const TransformFields& b) {
  const TransformFields none;
  if (a == none) return b;
  if (b == none) return a;
  const bool unturned = a.rotation[3] == 0, unscaled = a.scale == none.scale;
  if (unturned && unscaled) {
    auto out = b;
    for (std::size_t i = 0; i < 3; ++i) out.translation[i] = tidy(a.translation[i] + b.translation[i]);
    return out;
  }
  if (unscaled && a.center == none.center && b == TransformFields{.translation = b.translation}) {
    auto out = a;
    const Vec3 turned = rotation_matrix(a.rotation).point(b.translation);
    for (std::size_t i = 0; i < 3; ++i) out.translation[i] = tidy(a.translation[i] + turned[i]);
    without_noise(out.translation);
    return out;
  }
  const bool b_only_scales = b.translation == none.translation && b.rotation[3] == 0 && b.center == none.center;
  if (!unscaled || a.center != none.center || !b_only_scales) return std::nullopt;
  auto out = a;
  out.scale = b.scale;
  out.scale_orientation = b.scale_orientation;
  return out;
}

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

/// Columns of unit length, one of them may be none: then it stands on the others.
void complete(std::array<Vec3, 3>& columns, const std::array<bool, 3>& known) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (known[k]) continue;
    const auto &a = columns[(k + 1) % 3], &b = columns[(k + 2) % 3];
    columns[k] = cross(a, b);
    if (const double length = std::sqrt(dot(columns[k], columns[k])); length > 0)
      columns[k] = scaled(columns[k], 1 / length);
  }
}

}  // namespace

void without_noise(Vec3& v) {
  const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  for (double& x : v)
    if (std::abs(x) < 1e-15 * largest) x = 0;
}

void Placement::then(const TransformFields& next) {
  matrix_ = matrix_ * matrix_of(next);
  if (fields_) fields_ = sum(*fields_, next);
}

void Placement::then(const Matrix& next) {
  matrix_ = matrix_ * next;
  fields_.reset();
}

void Placement::then(const Placement& next) {
  if (next.fields_) return then(*next.fields_);
  then(next.matrix_);
}

TransformFields Placement::fields() const { return fields_ ? *fields_ : decompose(matrix_); }

TransformFields decompose(const Matrix& m) {
  TransformFields out;
  if (std::ranges::any_of(m.m, [](double v) { return !std::isfinite(v); })) return out;
  out.translation = tidy(Vec3{m(0, 3), m(1, 3), m(2, 3)});
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
      u[k] = scaled(u[k], 1 / out.scale[k]);
    else
      u[k] = {};
  if (m.determinant() < 0) {  // mirrored along the axis that leaves the least to turn
    const std::array<double, 3> along{dot(u[0], axes[0]), dot(u[1], axes[1]), dot(u[2], axes[2])};
    const auto k = static_cast<std::size_t>(std::ranges::min_element(along) - along.begin());
    u[k] = scaled(u[k], -1);
    out.scale[k] = -out.scale[k];
  }
  if (const auto n_known = std::ranges::count(known, true); n_known == 3 || n_known == 2) {
    complete(u, known);
    Rows r{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) r[i][k] = u[0][i] * v[k][0] + u[1][i] * v[k][1] + u[2][i] * v[k][2];
    out.rotation = tidy(axis_angle(r));
  }
  const bool uniform = std::abs(out.scale[0] - out.scale[1]) <= 1e-12 * largest &&
                       std::abs(out.scale[0] - out.scale[2]) <= 1e-12 * largest;
  if (!uniform) out.scale_orientation = tidy(axis_angle(v));
  out.scale = tidy(out.scale);
  return out;
}

}  // namespace wrlkit::vrml1
