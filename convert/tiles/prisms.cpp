#include "convert/tiles/prisms.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/hashing.h"
#include "base/math/affine.h"
#include "base/math/eigen.h"
#include "base/math/quaternion.h"
#include "geometry/closest_point.h"
#include "passes/instance/motion.h"

namespace wrlkit::tiles {
namespace {

constexpr double most_tilt = 0.02;      // of faces that count as one that looks along an axis
constexpr double most_shown = 0.05;     // of a face after the scale, as shading shows it
constexpr double least_angle = 0.3;     // sine between normals that an axis is taken from
constexpr double around_caps = 1.5;     // creaseAngle from which shading goes around a right angle
constexpr double tolerances_wide = 20;  // narrower faces have no normal to speak of
constexpr double least_share = 1e-4;    // of the largest extent: below that, there is none

struct Face {
  Vec3 normal;
  double area;
};

/// Those that are wide enough.
std::vector<Face> faces_of(const Mesh& mesh, double tolerance) {
  std::vector<Face> out;
  const auto triangles = triangles_of(mesh);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto t = triangles[i];
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    const double twice = fast_length(n);
    const double longest = std::max({fast_length(t[1] - t[0]), fast_length(t[2] - t[1]), fast_length(t[0] - t[2])});
    if (twice > tolerances_wide * tolerance * longest) out.push_back({1 / twice * n, twice / 2});
  }
  return out;
}

/// The sine by which it misses the axis or what is square to it.
double tilt_of(const Vec3& normal, const Vec3& axis) {
  return std::min(std::abs(dot(normal, axis)), fast_length(cross(normal, axis)));
}

double tilt_of(const std::vector<Face>& faces, const Vec3& axis) {
  double out = 0;
  for (const auto& f : faces) {
    out = std::max(out, tilt_of(f.normal, axis));
    if (out > most_tilt) break;
  }
  return out;
}

bool is_wall(const Face& f, const Vec3& axis) { return std::abs(dot(f.normal, axis)) < 0.5; }

/// Square to all walls as nearly as can be: long walls know it better than small caps.
Vec3 refined(const std::vector<Face>& faces, const Vec3& axis) {
  std::array<std::array<double, 3>, 3> sums{}, vectors{};
  std::array<double, 3> values{};
  for (const auto& f : faces)
    for (std::size_t i = 0; i < 3 && is_wall(f, axis); ++i)
      for (std::size_t k = 0; k < 3; ++k) sums[i][k] += f.area * f.normal[i] * f.normal[k];
  diagonalise(sums, vectors, values);
  const auto least = static_cast<std::size_t>(std::ranges::min_element(values) - values.begin());
  const Vec3 found{vectors[0][least], vectors[1][least], vectors[2][least]};
  const double along = dot(found, axis);
  if (std::abs(along) < 1 - most_tilt) return axis;  // walls that look one way leave it open
  return (along < 0 ? -1 : 1) * found;
}

std::optional<Vec3> axis_of(const std::vector<Face>& faces) {
  if (faces.empty()) return std::nullopt;
  const Vec3 first = faces[0].normal;
  const auto other =
      std::ranges::find_if(faces, [&](const Face& f) { return fast_length(cross(first, f.normal)) > least_angle; });
  if (other == faces.end()) return std::nullopt;
  for (const Vec3& axis : {unit(cross(first, other->normal)), first, other->normal})
    if (tilt_of(faces, axis) <= most_tilt) return refined(faces, axis);
  return std::nullopt;
}

/// Square to the axis: where one of the walls looks, or, if all of them look that way or square to it, all of them.
Vec3 side_of(const std::vector<Face>& faces, const Vec3& axis, bool& is_box) {
  const auto wall = std::ranges::find_if(faces, [&](const Face& f) { return is_wall(f, axis); });
  Vec3 side = wall->normal - dot(wall->normal, axis) * axis;
  is_box = tilt_of(faces, unit(side)) <= most_tilt;
  if (is_box) {
    Vec3 sum{};
    for (const auto& f : faces) {
      const double along = dot(f.normal, side);
      if (std::abs(along) > 0.5) sum = sum + (along < 0 ? -f.area : f.area) * f.normal;
    }
    side = sum - dot(sum, axis) * axis;
  }
  return unit(side);
}

}  // namespace

std::optional<Prism> prism_of(const Mesh& mesh, double tolerance) {
  if (mesh.normal.present() || mesh.color.present() || mesh.texcoord.present()) return std::nullopt;
  if (!(mesh.crease_angle < around_caps)) return std::nullopt;
  const auto faces = faces_of(mesh, tolerance);
  const auto axis = axis_of(faces);
  if (!axis || std::ranges::none_of(faces, [&](const Face& f) { return is_wall(f, *axis); })) return std::nullopt;
  Prism out;
  const Vec3 side = side_of(faces, *axis, out.is_box);
  out.frame = matrix_of_columns(side, *axis, cross(side, *axis));
  out.tilt = tilt_of(faces, *axis);
  if (out.is_box) out.tilt = std::max(out.tilt, tilt_of(faces, side));
  return out.tilt <= most_tilt ? std::optional(out) : std::nullopt;
}

std::uint64_t shape_of(const Mesh& mesh) {
  std::uint64_t out = mesh.solid;
  for (const auto c : mesh.corners) out = mixed(out, c);
  return out;
}

std::optional<TransformFields> stretched(const Prism& prism, const instancing::MeshForm& from,
                                         const instancing::MeshForm& to, double tolerance) {
  if (from.at.size() != to.at.size() || !(from.spread[2] > least_share * from.spread[0])) return std::nullopt;
  const Matrix map = instancing::fit(from.at, to.at, instancing::Scaling::axis, false);
  const auto column = [&](int k) { return Vec3{map(0, k), map(1, k), map(2, k)}; };
  if (!is_invertible(map) || !(map.determinant() > 0)) return std::nullopt;
  const Vec3 y = unit(column(1)), x = unit(column(0) - dot(column(0), y) * y), z = cross(x, y);
  TransformFields out;
  out.scale = {dot(column(0), x), fast_length(column(1)), dot(column(2), z)};
  if (!prism.is_box) out.scale[0] = out.scale[2] = (out.scale[0] + out.scale[2]) / 2;
  const auto [least, most] = std::ranges::minmax(out.scale);
  if (!(least > 0) || !(prism.tilt * most <= most_shown * least)) return std::nullopt;
  out.rotation = axis_angle(matrix_of_columns(x, y, z));
  out.translation = to.centre - matrix_of(out).point(from.centre);
  const Matrix placed = translation_matrix(-1 * to.centre) * matrix_of(out) * translation_matrix(from.centre);
  for (std::size_t i = 0; i < from.at.size(); ++i)
    if (!(fast_length(placed.point(from.at[i]) - to.at[i]) <= tolerance)) return std::nullopt;
  return out;
}

}  // namespace wrlkit::tiles
