#include "writers/gltf/transform.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/nodes.h"
#include "writers/gltf/number.h"

namespace wrlkit::gltf {
namespace {

Vec3 fitting_or(const Vec3& v, const Vec3& fallback) { return fits_float(v) ? v : fallback; }

Vec3 each_times(const Vec3& a, const Vec3& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }

/// SR S -SR when that is again a scale along the axes: when SR only swaps axes.
std::optional<Vec3> axis_scale(const Quaternion& orientation, const Vec3& scale) {
  constexpr double rounding = 1e-12;
  const Matrix r = matrix_of(orientation);
  double largest = std::max({std::abs(scale[0]), std::abs(scale[1]), std::abs(scale[2])});
  auto entry = [&](int i, int j) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += r(i, k) * scale[static_cast<std::size_t>(k)] * r(j, k);
    return sum;
  };
  if (std::max({std::abs(entry(0, 1)), std::abs(entry(0, 2)), std::abs(entry(1, 2))}) > rounding * largest)
    return std::nullopt;
  return Vec3{entry(0, 0), entry(1, 1), entry(2, 2)};
}

}  // namespace

Quaternion quaternion(const Vec4& r) { return fits_float(r) ? quaternion_of(r) : Quaternion(); }

Quaternion looking_along(const Vec3& direction) {
  const double length = wrlkit::length(direction);
  if (!(length > 0) || !fits_float(direction)) return {};
  double x = direction[0] / length, y = direction[1] / length, z = direction[2] / length;
  if (z == -1) return {};
  // The half-way quaternion, (1 + a.b, a x b) of a = -Z; behind, any axis across Z will do.
  double w = 1 - z, n = std::sqrt(w * w + x * x + y * y);
  if (n < 1e-9) return {0, 1, 0, 0};
  return {y / n, -x / n, 0, w / n};
}

Vec3 rotate(const Quaternion& q, const Vec3& v) { return matrix_of(q).point(v); }

Matrix matrix(const Trs& t) {
  Matrix out = matrix_of(t.rotation);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out(i, j) *= t.scale[static_cast<std::size_t>(j)];
    out(i, 3) = t.translation[static_cast<std::size_t>(i)];
  }
  return out;
}

std::optional<Trs> trs_of(const Matrix& m) {
  constexpr double square = 1e-9;
  Trs t;
  Matrix r = m;
  for (int c = 0; c < 3; ++c) {
    const double length = wrlkit::length(m.column(c));
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    for (int k = 0; k < 3; ++k) r(k, c) /= length;
    t.scale[static_cast<std::size_t>(c)] = std::abs(length - 1) < square ? 1 : length;
    t.translation[static_cast<std::size_t>(c)] = m(c, 3);
  }
  for (int c = 0; c < 3; ++c)
    if (std::abs(r(0, c) * r(0, (c + 1) % 3) + r(1, c) * r(1, (c + 1) % 3) + r(2, c) * r(2, (c + 1) % 3)) > square)
      return std::nullopt;
  if (!(r.determinant() > 0)) return std::nullopt;
  t.rotation = quaternion_of_matrix(r);
  for (double* v : {&t.rotation.x, &t.rotation.y, &t.rotation.z, &t.rotation.w})
    if (std::abs(*v) < square) *v = 0;
  if (t.rotation.w < 0) t.rotation = -t.rotation;
  return t;
}

double mean_scale(const Matrix& m) { return std::cbrt(std::abs(m.determinant())); }

double largest_scale(const Matrix& m) {
  double largest = 0, sum = 0, dots = 0;
  for (int c = 0; c < 3; ++c) {
    double square = 0, dot = 0;
    for (int r = 0; r < 3; ++r) {
      square += m(r, c) * m(r, c);
      dot += m(r, c) * m(r, (c + 1) % 3);
    }
    largest = std::max(largest, square);
    sum += square;
    dots = std::max(dots, std::abs(dot));
  }
  return std::sqrt(dots <= 1e-9 * sum ? largest : sum);
}

Trs placed_at(const Vec3& position, const Quaternion& rotation) {
  return {fitting_or(position, {0, 0, 0}), rotation, {1, 1, 1}};
}

NodeTransform node_transform(const Scene& scene, NodeId n) {
  namespace f = nodes::transform;
  constexpr Vec3 zero{0, 0, 0}, one{1, 1, 1};
  const Vec3 t = fitting_or(scene.get(n, f::translation), zero), c = fitting_or(scene.get(n, f::center), zero);
  const Vec3 s = fitting_or(scene.get(n, f::scale), one);
  const Quaternion r = quaternion(scene.get(n, f::rotation));
  const Quaternion sr = s[0] == s[1] && s[1] == s[2] ? Quaternion{} : quaternion(scene.get(n, f::scaleOrientation));
  if (c == zero && sr.identity()) return {{t, r, s}, {}, true};
  auto along_axes = sr.identity() ? s : axis_scale(sr, s);
  if (along_axes) {
    Vec3 moved = r.identity() && *along_axes == one ? t : t + c - rotate(r, each_times(*along_axes, c));
    return {{fitting_or(moved, t), r, *along_axes}, {}, false};
  }
  Quaternion back = inverse(sr);
  return {{fitting_or(t + c, t), r * sr, s}, placed_at(rotate(back, zero - c), back), false};
}

}  // namespace wrlkit::gltf
