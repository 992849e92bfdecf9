#include "parsers/gltf/trs.h"

#include <algorithm>
#include <cmath>

#include "base/math/digits.h"
#include "scenegraph/decompose.h"

namespace wrlkit::gltf_reader {
namespace {

bool finite(const std::vector<double>& v) {
  return std::ranges::all_of(v, [](double x) { return std::isfinite(x); });
}

}  // namespace

Vec4 rotation_of(const Quaternion& q) { return all_to_15_digits(axis_angle(q)); }

Vec3 rotate(const Vec4& r, const Vec3& v) { return rotation_matrix(r).point(v); }

TransformFields place_of(const Matrix& m) {
  TransformFields p;
  p.translation = m.column(3);
  Vec3 x = m.column(0), y = m.column(1), z = m.column(2);
  const double a = fast_length(x), b = fast_length(y), c = fast_length(z), sign = m.determinant() < 0 ? -1 : 1;
  constexpr double right_angle = 1e-6;
  const bool square = std::abs(dot(x, y)) <= right_angle * a * b && std::abs(dot(y, z)) <= right_angle * b * c &&
                      std::abs(dot(x, z)) <= right_angle * a * c;
  if (square && a > 0 && b > 0 && c > 0) {
    auto by = [](Vec3 v, double s) {
      for (double& k : v) k /= s;
      return v;
    };
    p.rotation = rotation_of(quaternion_of_matrix(matrix_of_columns(by(x, sign * a), by(y, b), by(z, c))));
    p.scale = {to_15_digits(sign * a), to_15_digits(b), to_15_digits(c)};
    for (double& s : p.scale)
      if (std::abs(std::abs(s) - 1) < 1e-7) s = s < 0 ? -1 : 1;  // rounding of single precision
    return p;
  }
  const TransformFields f = decompose(m);
  p.rotation = f.rotation;
  p.scale = f.scale;
  p.scale_orientation = f.scale_orientation;
  return p;
}

TransformFields place_of(Json node) {
  if (auto v = node["matrix"].numbers(); v.size() == 16 && finite(v)) return place_of(matrix_of_columns(v.data()));
  TransformFields p;
  if (auto t = node["translation"].numbers(); t.size() == 3) p.translation = {t[0], t[1], t[2]};
  if (auto s = node["scale"].numbers(); s.size() == 3) p.scale = {s[0], s[1], s[2]};
  if (auto r = node["rotation"].numbers(); r.size() == 4) p.rotation = rotation_of({r[0], r[1], r[2], r[3]});
  return p;
}

}  // namespace wrlkit::gltf_reader
