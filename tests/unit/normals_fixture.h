// One mesh and what the pass `normals` needs around it.
#pragma once
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <random>
#include <set>

#include "passes/normals/normals.h"

namespace wrlkit::normals_tests {

constexpr double pi = std::numbers::pi;
using Point = Vec3;
using Face = std::vector<std::uint32_t>;

/// One mesh and what the pass needs around it.
struct Bench {
  Scene scene;
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  MeshScratch scratch;
  Mesh mesh;

  Outcome run(const NormalsOptions& options = {}) {
    MeshJob job{scene, NodeId{}, mesh, scratch, ctx};
    return normals(job, options);
  }

  void set(const std::vector<Point>& points, const std::vector<Face>& faces, double crease_angle) {
    mesh.clear();
    mesh.kind = Mesh::Kind::faces;
    mesh.crease_angle = crease_angle;
    for (const Point& p : points) mesh.positions.edit().insert(mesh.positions.edit().end(), p.begin(), p.end());
    mesh.face_begin.push_back(0);
    for (const Face& f : faces) {
      mesh.corners.insert(mesh.corners.end(), f.begin(), f.end());
      mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    }
  }

  Point normal(std::size_t corner) const {
    const float* n = mesh.normal.at(mesh.normal.index[corner]);
    return {n[0], n[1], n[2]};
  }
  Point normal(std::size_t face, std::size_t corner) const { return normal(mesh.begin_of(face) + corner); }
  /// What a split into vertices would count.
  std::size_t pairs() const {
    std::set<std::pair<std::uint32_t, std::uint32_t>> s;
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) s.insert({mesh.corners[c], mesh.normal.index[c]});
    return s.size();
  }
  void check_unit() const {
    REQUIRE(mesh.normal.index.size() == mesh.corners.size());
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
      Point n = normal(c);
      REQUIRE(std::abs(std::hypot(n[0], n[1], n[2]) - 1) < 1e-6);
    }
  }
};

inline void check(const Point& a, const Point& b, double margin = 1e-6) {
  CAPTURE(a, b);
  for (int i = 0; i < 3; ++i) CHECK(a[i] == Approx(b[i]).margin(margin));
}

inline std::vector<Point> cube_points(const Point& centre = {}, double half = 1) {
  std::vector<Point> p;
  for (int i = 0; i < 8; ++i)
    p.push_back(
        {centre[0] + (i & 1 ? half : -half), centre[1] + (i & 2 ? half : -half), centre[2] + (i & 4 ? half : -half)});
  return p;
}
const std::vector<Face> cube_faces{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
const std::vector<Point> cube_normals{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};

inline std::vector<Face> triangulated(const std::vector<Face>& faces) {
  std::vector<Face> out;
  for (const Face& f : faces)
    for (std::size_t i = 1; i + 1 < f.size(); ++i) out.push_back({f[0], f[i], f[i + 1]});
  return out;
}

/// Two squares that share the y axis; the second is turned down by `angle` against the first, which has the normal z.
inline std::vector<Point> hinge(double angle) {
  return {{0, 0, 0},
          {0, 1, 0},
          {-1, 0, 0},
          {-1, 1, 0},
          {std::cos(angle), 0, -std::sin(angle)},
          {std::cos(angle), 1, -std::sin(angle)}};
}
const std::vector<Face> hinge_faces{{0, 1, 3, 2}, {0, 4, 5, 1}};

}  // namespace wrlkit::normals_tests
