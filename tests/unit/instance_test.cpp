// `instance` finds copies of symmetric and other bodies, wherever they stand, however their faces and points are
// listed.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/math/random.h"
#include "geometry/geometry.h"
#include "passes/instance/match.h"

using namespace wrlkit;
using namespace wrlkit::instancing;

namespace {

Mesh mesh_of(const std::vector<Vec3>& points, const std::vector<std::vector<std::uint32_t>>& faces) {
  Mesh m;
  m.kind = Mesh::Kind::faces;
  for (const Vec3& p : points) m.positions.edit().insert(m.positions.edit().end(), p.begin(), p.end());
  m.face_begin.push_back(0);
  for (const auto& f : faces) {
    m.corners.insert(m.corners.end(), f.begin(), f.end());
    m.face_begin.push_back(static_cast<std::uint32_t>(m.corners.size()));
  }
  return m;
}

/// A prism over a regular polygon; four sides of the height sqrt(2): a cube.
Mesh prism(std::uint32_t sides, double radius, double height) {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces(2);
  for (std::uint32_t i = 0; i < sides; ++i)
    for (double y : {0.0, height}) {
      const double a = 2 * std::numbers::pi * i / sides;
      points.push_back({radius * std::cos(a), y, -radius * std::sin(a)});
    }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const auto k = (i + 1) % sides;
    faces.push_back({2 * i, 2 * k, 2 * k + 1, 2 * i + 1});
    faces[0].insert(faces[0].begin(), 2 * i);
    faces[1].push_back(2 * i + 1);
  }
  return mesh_of(points, faces);
}

/// Somewhere else, as another program writes it: every face with points of its own, in another order, from another
/// corner.
Mesh scattered(const Mesh& m, const Matrix& where, std::uint64_t seed, double rounding) {
  RandomStream random(seed);
  std::vector<std::size_t> order(m.n_faces());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.bits() % i]);
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces;
  for (auto f : order) {
    const auto n = m.end_of(f) - m.begin_of(f), start = static_cast<std::size_t>(random.bits() % n);
    faces.emplace_back();
    for (std::size_t i = 0; i < n; ++i) {
      const double* p = m.positions.data() + 3 * std::size_t{m.corners[m.begin_of(f) + (start + i) % n]};
      Vec3 at = where.point({p[0], p[1], p[2]});
      if (rounding > 0)
        for (double& v : at) v = std::round(v / rounding) * rounding;
      faces.back().push_back(static_cast<std::uint32_t>(points.size()));
      points.push_back(at);
    }
  }
  return mesh_of(points, faces);
}

Matrix somewhere(std::uint64_t seed, double scale) {
  RandomStream r(seed);
  return translation_matrix({9 * r.next(), -7 * r.next(), 3 * r.next()}) *
         rotation_matrix({r.next() - 0.5, r.next() - 0.5, r.next() - 0.5, 6 * r.next()}) *
         scale_matrix({scale, scale, scale});
}

double farthest(const Mesh& from, const Matrix& m, const Mesh& to) {
  double worst = 0;
  for (auto c : from.corners) {
    const double* p = from.positions.data() + 3 * std::size_t{c};
    const Vec3 q = m.point({p[0], p[1], p[2]});
    double nearest = 1e300;
    for (auto d : to.corners) {
      const double* o = to.positions.data() + 3 * std::size_t{d};
      nearest = std::min(nearest, std::hypot(q[0] - o[0], q[1] - o[1], q[2] - o[2]));
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

std::optional<TransformFields> match(const Mesh& a, const Mesh& b, const MatchOptions& options) {
  MeshForm from, to;
  from.take(a);
  to.take(b);
  if (from.exact_key() != to.exact_key()) return std::nullopt;
  return Matcher(options).match(from, to);
}

}  // namespace

TEST_CASE("instance: bodies with many symmetries, scattered and rounded") {
  struct Body {
    std::uint32_t sides;
    double radius, height;
  };
  for (Body b : {Body{4, 1, std::sqrt(2.0)}, Body{4, 1, 1.5}, Body{3, 0.02, 0.01}, Body{6, 0.012, 0.008},
                 Body{64, 0.3, 4}, Body{5, 2, 0}})
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
      for (double scale : {1.0, 2.5}) {
        INFO(b.sides << " sides, radius " << b.radius << ", seed " << seed << ", scale " << scale);
        const Mesh a = prism(b.sides, b.radius, b.height), copy = scattered(a, somewhere(seed, scale), seed, 1e-5);
        const auto found = match(a, copy, {Scaling::uniform, false, 1e-4});
        REQUIRE(found);
        CHECK(farthest(a, matrix_of(*found), copy) <= 1e-4);
        CHECK(bool(match(a, copy, {Scaling::none, false, 1e-4})) == (scale == 1));
      }
}

TEST_CASE("instance: what is near a copy is none") {
  const Mesh a = prism(7, 1, 2);
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Mesh copy = scattered(a, somewhere(seed, 1), seed, 0);
    copy.positions.edit()[copy.corners[seed] * std::size_t{3}] += 3e-4;
    CHECK_FALSE(match(a, copy, {Scaling::uniform, false, 1e-4}));
    CHECK(match(a, copy, {Scaling::uniform, false, 4e-4}));
  }
}

TEST_CASE("instance: a mirror image is found on request only, with its faces turned") {
  const Mesh a = mesh_of({{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Matrix where = somewhere(seed, 1) * scale_matrix({1, -1, 1});
    Mesh inside_out = scattered(a, where, seed, 0), copy = inside_out;
    for (std::size_t f = 0; f < copy.n_faces(); ++f)
      std::reverse(copy.corners.begin() + static_cast<std::ptrdiff_t>(copy.begin_of(f)),
                   copy.corners.begin() + static_cast<std::ptrdiff_t>(copy.end_of(f)));
    CHECK_FALSE(match(a, copy, {Scaling::none, false, 1e-6}));
    const auto found = match(a, copy, {Scaling::none, true, 1e-6});
    REQUIRE(found);
    CHECK(matrix_of(*found).determinant() == Approx(-1));
    CHECK_FALSE(match(a, inside_out, {Scaling::none, true, 1e-6}));
  }
}

TEST_CASE("instance: pipes of any length, where faces stand in one order") {
  const Mesh a = prism(16, 0.1, 1);
  Mesh longer = prism(16, 0.1, 7.25);
  for (std::size_t i = 0; i < longer.positions.size(); i += 3) longer.positions.edit()[i] += 5;
  CHECK_FALSE(match(a, longer, {Scaling::uniform, false, 1e-4}));
  const auto found = match(a, longer, {Scaling::axis, false, 1e-4});
  REQUIRE(found);
  CHECK(farthest(a, matrix_of(*found), longer) <= 1e-4);
}

TEST_CASE("instance: far away, single points, and points in a line") {
  const Mesh a = prism(6, 1, 1);
  Mesh far = scattered(a, translation_matrix({5e6, 200, -3e6}), 3, 1e-4);
  CHECK(match(a, far, {Scaling::uniform, false, 2e-4}));
  Mesh p = mesh_of({{1, 2, 3}}, {{0}}), q = mesh_of({{4, 4, 4}}, {{0}});
  p.kind = q.kind = Mesh::Kind::points;
  CHECK(match(p, q, {Scaling::uniform, false, 1e-4}));
  const Mesh line = mesh_of({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {{0, 1, 2}}),
             turned = mesh_of({{0, 1, 0}, {0, 3, 0}, {0, 0, 0}}, {{2, 0, 1}});
  CHECK(match(line, turned, {Scaling::uniform, false, 1e-4}));
}
