#include "geometry/simplify/given_attributes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/math/vec.h"
#include "geometry/simplify/closest_on_triangle.h"

namespace wrlkit::simplify {
namespace {

constexpr double within = 0.02;  // of the way from a corner to the middle of its face
// Cosines between a normal and that of its face. At the corners of a pipe of three sides it is a half; with less, faces
// that one sees would be dark. One that a flat triangle had is right for faces like that only: a beam that has become a
// strip is as bright as the strip.
constexpr double least_facing = 0.45, least_facing_of_flat = 0.9;
constexpr double same_facing = 1e-3;  // 1 minus the cosine, for flat faces: 2.5 degrees
constexpr float decimals = 1000;

Vec3 face_normal(const Mesh& mesh, const std::array<Vec3, 3>& corners) {
  return (mesh.ccw ? 1. : -1.) * unit(area_normal(corners));
}

Vec3 vec3_of(const float* v) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

/// Whether the corners of a triangle have one value, which rounding is not to change.
bool is_constant(const Attribute& a, std::uint32_t triangle) {
  const float* first = a.at(a.index[std::size_t{3} * triangle]);
  const auto is_first = [&](std::size_t c) {
    return std::equal(first, first + a.width, a.at(a.index[std::size_t{3} * triangle + c]));
  };
  return is_first(1) && is_first(2);
}

/// The value of an attribute in a triangle.
void append(const Attribute& from, std::uint32_t triangle, const std::array<double, 3>& at, Attribute& to) {
  to.width = from.width;
  to.index.push_back(static_cast<std::uint32_t>(to.index.size()));
  for (int k = 0; k < from.width; ++k) {
    double value = 0;
    for (std::size_t c = 0; c < 3; ++c)
      value += at[c] * static_cast<double>(from.at(from.index[std::size_t{3} * triangle + c])[k]);
    to.values.push_back(static_cast<float>(value));
  }
}

/// Makes the normal of a corner one of length 1; where it is too far from that of its face, it is that.
void face_front(Mesh& level, std::size_t corner, double least) {
  float* v = level.normal.values.data() + 3 * corner;
  const Vec3 of_face = face_normal(level, triangles_of(level)[corner / 3]);
  Vec3 normal = unit(vec3_of(v));
  if (dot(normal, of_face) < least) normal = of_face;
  for (std::size_t k = 0; k < 3; ++k) v[k] = static_cast<float>(normal[k]);
}

/// Whether the corners of a face have its normal.
bool is_flat(const Mesh& mesh, std::size_t face) {
  const Vec3 normal = face_normal(mesh, triangles_of(mesh)[face]);
  for (std::size_t k = 0; k < 3; ++k)
    if (dot(normal, vec3_of(mesh.normal.at(mesh.normal.index[3 * face + k]))) < 1 - same_facing) return false;
  return true;
}

bool is_flat(const Mesh& mesh) {
  for (std::size_t f = 0; f < mesh.n_faces(); ++f)
    if (!is_flat(mesh, f)) return false;
  return true;
}

}  // namespace

GivenAttributes::GivenAttributes(const Mesh& part) : part_(part), surface_(triangles_of(part)), nearest_(surface_) {}

/// The triangle that is seen from a little within a corner of a level.
std::uint32_t GivenAttributes::behind(const std::array<Vec3, 3>& face, std::size_t corner, std::uint32_t guess) const {
  const Vec3 middle = (1. / 3) * (face[0] + face[1] + face[2]);
  return nearest_.nearest((1 - within) * face[corner] + within * middle, unit(area_normal(face)), guess).triangle;
}

void GivenAttributes::give(Mesh& level) const {
  const auto from = part_.attributes();
  const auto to = level.attributes();
  std::vector<std::size_t> lacking;
  for (std::size_t a = 0; a < from.size(); ++a)
    if (from[a]->present() && !to[a]->present()) lacking.push_back(a);
  if (lacking.empty()) return;
  const bool gives_normals = lacking[0] == 0;
  const auto faces = triangles_of(level);
  auto triangle = ClosestPoint::no_guess;
  for (std::size_t i = 0; i < level.corners.size(); ++i) {
    const auto face = faces[i / 3];
    triangle = behind(face, i % 3, triangle);
    if (triangle == ClosestPoint::no_guess) {
      for (const auto a : lacking) to[a]->clear();
      return;
    }
    const auto at = closest_on_triangle(face[i % 3], surface_[triangle]).at;
    for (const auto a : lacking) {
      const bool is_flat_color = from[a] == &part_.color && is_constant(*from[a], triangle);
      append(*from[a], triangle, is_flat_color ? std::array{1., 0., 0.} : at, *to[a]);
    }
    if (gives_normals) face_front(level, i, is_flat(part_, triangle) ? least_facing_of_flat : least_facing);
  }
}

void shorten_normals(Mesh& mesh) {
  if (!mesh.normal.present()) return;
  if (is_flat(mesh)) {
    mesh.normal.clear();
    mesh.crease_angle = 0;
    return;
  }
  std::map<std::array<float, 3>, std::uint32_t> number;
  Attribute out(3);
  for (const auto i : mesh.normal.index) {
    std::array<float, 3> v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = std::round(mesh.normal.at(i)[k] * decimals) / decimals + 0.f;
    const auto [known, is_new] = number.try_emplace(v, static_cast<std::uint32_t>(number.size()));
    if (is_new) out.values.insert(out.values.end(), v.begin(), v.end());
    out.index.push_back(known->second);
  }
  mesh.normal = std::move(out);
}

}  // namespace wrlkit::simplify
