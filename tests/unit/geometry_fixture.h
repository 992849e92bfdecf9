// A world of one text and the mesh of its geometry, and what tests measure on meshes: areas, volumes, Euler numbers.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "base/math/box.h"
#include "geometry/geometry.h"
#include "parsers/vrml/parser.h"
#include "passes/tessellate/tessellate.h"
#include "scenegraph/nodes.h"

namespace wrlkit::geometry_tests {

inline constexpr double pi = std::numbers::pi;
using Ints = std::vector<std::uint32_t>;

// A scene of one text, and what mesh passes need.
struct Fixture {
  Scene scene;
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  Mesh mesh;
  MeshScratch scratch;

  explicit Fixture(std::string_view text = {}) { vrml::parse(text, 0, {}, scene, diag); }
  NodeId root(std::size_t i = 0) const { return scene.main.roots.at(i); }
  MeshJob job(NodeId n, bool textured = true) { return {scene, n, mesh, scratch, ctx, textured}; }
  Mesh& read(NodeId n) {
    auto j = job(n);
    read_mesh(j);
    return mesh;
  }
  Mesh& read() { return read(root()); }
  Mesh& faces(TessellateOptions options = {}) {
    options.triangles = false;
    mesh.clear();
    auto j = job(root());
    tessellate(j, options);
    return mesh;
  }
  std::string message(std::size_t i = 0) const { return diag.messages().size() > i ? diag.messages()[i].text() : ""; }
};

inline Vec3 position(const Mesh& m, std::size_t corner) {
  return vec3(m.positions.data() + 3 * std::size_t{m.corners[corner]});
}

// Newell's: half the sum of cross products; its length is the area of a planar polygon, concave or not.
inline Vec3 area_vector(const Mesh& m, std::size_t face) {
  Vec3 sum{};
  const auto first = m.begin_of(face);
  for (auto c = first + 1; c + 1 < m.end_of(face); ++c) {
    auto n = cross(position(m, c) - position(m, first), position(m, c + 1) - position(m, first));
    for (int k = 0; k < 3; ++k) sum[k] += n[k] / 2;
  }
  return sum;
}

inline double area(const Mesh& m) {
  double sum = 0;
  for (std::size_t f = 0; f < m.n_faces(); ++f) sum += length(area_vector(m, f));
  return sum;
}

// The volume inside planar faces; positive when they are counterclockwise seen from outside.
inline double volume(const Mesh& m) {
  double sum = 0;
  for (std::size_t f = 0; f < m.n_faces(); ++f) sum += dot(position(m, m.begin_of(f)), area_vector(m, f)) / 3;
  return sum;
}

inline Box bounds(const Mesh& m) {
  Box b;
  for (std::size_t c = 0; c < m.corners.size(); ++c) b.add(position(m, c));
  return b;
}

// Vertices - edges + faces of a closed oriented surface; -1000 where an edge is not met once from each side.
inline int euler(const Mesh& m) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::set<std::uint32_t> used(m.corners.begin(), m.corners.end());
  for (std::size_t f = 0; f < m.n_faces(); ++f)
    for (auto c = m.begin_of(f); c < m.end_of(f); ++c) {
      auto next = c + 1 == m.end_of(f) ? m.begin_of(f) : c + 1;
      ++edges[{m.corners[c], m.corners[next]}];
    }
  for (auto& [e, n] : edges)
    if (n != 1 || !edges.count({e.second, e.first})) return -1000;
  return int(used.size()) - int(edges.size() / 2) + int(m.n_faces());
}

inline Vec3 normal_at(const Mesh& m, std::size_t corner) {
  const float* n = m.normal.at(m.normal.index[corner]);
  return {n[0], n[1], n[2]};
}

// The texture coordinate of the corner nearest to a point, on a face whose normal is nearest to a direction.
inline std::array<double, 2> texcoord_at(const Mesh& m, const Vec3& point, const Vec3& direction) {
  std::array<double, 2> found{-1, -1};
  double best = 1e300;
  for (std::size_t f = 0; f < m.n_faces(); ++f) {
    auto n = area_vector(m, f);
    double off = 1 - dot(n, direction) / length(n) / length(direction);
    for (auto c = m.begin_of(f); c < m.end_of(f); ++c)
      if (double d = length(position(m, c) - point) + off; d < best) {
        best = d;
        const float* t = m.texcoord.at(m.texcoord.index[c]);
        found = {t[0], t[1]};
      }
  }
  return found;
}
inline bool near(const std::array<double, 2>& a, double s, double t) {
  return std::abs(a[0] - s) + std::abs(a[1] - t) < 1e-6;
}

// Whether the picture is seen the right way round from the side that the face turns to.
inline bool texture_mirrored(const Mesh& m) {
  for (std::size_t f = 0; f < m.n_faces(); ++f) {
    double twice_area = 0;
    for (auto c = m.begin_of(f); c < m.end_of(f); ++c) {
      auto next = c + 1 == m.end_of(f) ? m.begin_of(f) : c + 1;
      const float *a = m.texcoord.at(m.texcoord.index[c]), *b = m.texcoord.at(m.texcoord.index[next]);
      twice_area += a[0] * b[1] - a[1] * b[0];
    }
    if (twice_area <= 0) return true;
  }
  return false;
}

// Normals have length 1 and lie within 60 degrees of the faces they belong to.
inline bool normals_fit(const Mesh& m) {
  for (std::size_t f = 0; f < m.n_faces(); ++f) {
    auto n = area_vector(m, f);
    for (auto c = m.begin_of(f); c < m.end_of(f); ++c) {
      auto v = normal_at(m, c);
      if (std::abs(length(v) - 1) > 1e-6 || dot(n, v) < 0.5 * length(n)) return false;
    }
  }
  return true;
}

// Every index points at something.
inline bool sound(const Mesh& m) {
  auto good = [&](const Attribute& a) {
    return !a.present() ||
           (a.index.size() == m.corners.size() && std::ranges::all_of(a.index, [&](auto i) { return i < a.count(); }));
  };
  return std::ranges::all_of(m.corners, [&](auto p) { return p < m.n_positions(); }) && good(m.color) &&
         good(m.normal) && good(m.texcoord) && (m.face_begin.empty() || m.face_begin.back() == m.corners.size());
}

inline bool same(const Attribute& a, const Attribute& b) { return a.values == b.values && a.index == b.index; }
inline bool same(const Mesh& a, const Mesh& b) {
  auto equal = [](double x, double y) {
    return x == y || (std::isnan(x) && std::isnan(y));
  };  // points not in use may be anything
  return a.kind == b.kind && std::ranges::equal(a.positions.span(), b.positions.span(), equal) &&
         a.corners == b.corners && a.face_begin == b.face_begin && same(a.color, b.color) && same(a.normal, b.normal) &&
         same(a.texcoord, b.texcoord) && a.ccw == b.ccw && a.solid == b.solid && a.convex == b.convex &&
         a.crease_angle == b.crease_angle;
}

// Two quadrilaterals side by side: positions 0 1 2 / 3 4 5, faces 0 3 4 1 and 1 4 5 2.
inline std::string grid(const std::string& rest, const std::string& coordIndex = "0 3 4 1 -1 1 4 5 2 -1") {
  return "IndexedFaceSet { coord Coordinate { point [ 0 1 0, 1 1 0, 2 1 0, 0 0 0, 1 0 0, 2 0 0 ] } coordIndex [ " +
         coordIndex + " ] " + rest + " }";
}

}  // namespace wrlkit::geometry_tests
