// The rungs that one part goes down by: how far off each is, and what is left of forms, pieces and texture coordinates.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>

#include "geometry/simplify/given_attributes.h"
#include "geometry/simplify/ladder.h"
#include "geometry/simplify/like_form.h"
#include "geometry/simplify/pieces.h"
#include "geometry/simplify/world_parts.h"
#include "test_world.h"

using namespace wrlkit;
using namespace wrlkit::simplify;

namespace {

Mesh grid_box(std::size_t n) {
  TestWorld w("Shape { geometry Box { size 2 2 2 } }");
  Mesh mesh;
  SurfaceReader(w.scene, w.ctx).read(surfaces_of(w.scene)[0], mesh);
  for (std::size_t round = 0; round < n; ++round) {
    Mesh finer;
    finer.kind = Mesh::Kind::faces;
    auto& p = finer.positions.edit();
    std::map<Vec3, std::uint32_t> number;
    auto index = [&](const Vec3& v) {
      const auto [found, is_new] = number.try_emplace(v, static_cast<std::uint32_t>(number.size()));
      if (is_new) p.insert(p.end(), v.begin(), v.end());
      return found->second;
    };
    const auto triangles = triangles_of(mesh);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto c = triangles[t];
      auto middle = [&](int a, int b) {
        Vec3 m;
        for (std::size_t k = 0; k < 3; ++k) m[k] = (c[std::size_t(a)][k] + c[std::size_t(b)][k]) / 2;
        return m;
      };
      const Vec3 ab = middle(0, 1), bc = middle(1, 2), ca = middle(2, 0);
      for (const auto& f :
           {std::array{c[0], ab, ca}, std::array{ab, c[1], bc}, std::array{ca, bc, c[2]}, std::array{ab, bc, ca}})
        for (const auto& v : f) finer.corners.push_back(index(v));
    }
    mesh = std::move(finer);
  }
  return mesh;
}

}  // namespace

TEST_CASE("ladder: a cap that something hides goes", "[levels]") {
  Mesh box = grid_box(0);
  auto samples = sample_surface(triangles_of(box), 100);
  for (auto& s : samples)
    if (s.normal[1] > 0.5) s.enough = 0;
  const auto rungs = make_ladder({box, samples, {}});
  const auto open = std::ranges::find_if(rungs, [](const Rung& r) { return r.n_faces == 10; });
  REQUIRE(open != rungs.end());
  CHECK(open->distortion.squares < 1e-9);
  CHECK(open->loose);
}

TEST_CASE("ladder: a box of many triangles becomes twelve without an error", "[levels]") {
  const Mesh box = grid_box(2);
  REQUIRE(box.n_faces() == 192);
  const auto samples = sample_surface(triangles_of(box), 800);
  double area = 0;
  for (const auto& s : samples) area += s.weight;
  CHECK(area == Approx(24));
  const auto rungs = make_ladder({box, samples, {}});
  REQUIRE(rungs.size() > 2);
  CHECK(rungs[0].n_faces == 192);
  for (std::size_t i = 1; i < rungs.size(); ++i) CHECK(rungs[i].n_faces < rungs[i - 1].n_faces);
  for (std::size_t i = 2; i < rungs.size(); ++i) CHECK(rungs[i].distortion.squares > rungs[i - 1].distortion.squares);
  const auto exact = std::ranges::find_if(rungs, [](const Rung& r) { return r.n_faces <= 14; });
  REQUIRE(exact != rungs.end());
  CHECK(exact->distortion.squares < 1e-3);
  const auto hull = convex_hull(rungs);
  CHECK(hull.front() == 0);
  CHECK(hull.back() == rungs.size() - 1);
}

/// A plate with rows of square holes.
Mesh grating(int n_holes) {
  Mesh mesh;
  mesh.kind = Mesh::Kind::faces;
  auto& positions = mesh.positions.edit();
  std::map<Vec3, std::uint32_t> number;
  const auto point = [&](int i, int j, double z) {
    const Vec3 p{i / 2 + 0.1 * (i % 2), j / 2 + 0.1 * (j % 2), z};
    const auto [found, is_new] = number.try_emplace(p, static_cast<std::uint32_t>(number.size()));
    if (is_new) positions.insert(positions.end(), p.begin(), p.end());
    return found->second;
  };
  const int n = 2 * n_holes + 1;
  const auto is_solid = [&](int i, int j) { return i >= 0 && i < n && j >= 0 && j < n && !(i % 2 == 1 && j % 2 == 1); };
  const auto quad = [&](std::array<std::uint32_t, 4> c) {
    mesh.corners.insert(mesh.corners.end(), {c[0], c[1], c[2], c[0], c[2], c[3]});
  };
  const auto wall = [&](int i, int j, int to_i, int to_j) {
    quad({point(i, j, 0), point(to_i, to_j, 0), point(to_i, to_j, 0.2), point(i, j, 0.2)});
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (!is_solid(i, j)) continue;
      quad({point(i, j, 0.2), point(i + 1, j, 0.2), point(i + 1, j + 1, 0.2), point(i, j + 1, 0.2)});
      quad({point(i, j + 1, 0), point(i + 1, j + 1, 0), point(i + 1, j, 0), point(i, j, 0)});
      if (!is_solid(i - 1, j)) wall(i, j + 1, i, j);
      if (!is_solid(i + 1, j)) wall(i + 1, j, i + 1, j + 1);
      if (!is_solid(i, j - 1)) wall(i, j, i + 1, j);
      if (!is_solid(i, j + 1)) wall(i + 1, j + 1, i, j + 1);
    }
  return mesh;
}

TEST_CASE("ladder: a grating goes down to a sheet", "[levels]") {
  const Mesh mesh = grating(12);
  REQUIRE(mesh.n_faces() == 3276);
  const auto samples = sample_surface(triangles_of(mesh), 4 * mesh.n_faces());
  const auto rungs = make_ladder({mesh, samples, {}});
  CHECK(rungs.back().n_faces <= 4);
}

TEST_CASE("ladder: texture coordinates stay where they are on the surface", "[levels]") {
  Mesh box = grid_box(2);
  box.texcoord.width = 2;
  box.texcoord.index = box.corners;
  const auto vertices = triangles_of(box);
  for (std::uint32_t i = 0; i < box.n_positions(); ++i)
    for (std::size_t k = 0; k < 2; ++k) box.texcoord.values.push_back(static_cast<float>(vertices.position(i)[k]));
  const auto samples = sample_surface(triangles_of(box), 800);
  const auto rungs = make_ladder({box, samples, {}});
  const auto exact = std::ranges::find_if(rungs, [](const Rung& r) { return r.n_faces <= 14; });
  REQUIRE(exact != rungs.end());
  Mesh level = exact->mesh;
  GivenAttributes(box).give(level);
  REQUIRE(level.texcoord.present());
  const auto at = triangles_of(level);
  for (std::size_t c = 0; c < level.corners.size(); ++c) {
    const float* uv = level.texcoord.at(level.texcoord.index[c]);
    CHECK(static_cast<double>(uv[0]) == Approx(at.position(level.corners[c])[0]).margin(5e-3));
  }
}

TEST_CASE("pieces: what is connected, and the same form elsewhere", "[levels]") {
  Mesh two = grid_box(0);
  append(two, grid_box(0));
  const auto pieces = connected_pieces(two);
  REQUIRE(pieces.size() == 2);
  CHECK(pieces[0].size() == 12);
  std::vector<std::uint32_t> original;
  const Mesh first = piece_of(two, pieces[0], original);
  CHECK(first.n_positions() == 8);

  Mesh moved = first;
  const Matrix place = translation_matrix({3, 4, 5}) * rotation_matrix({1, 2, 3, 0.7});
  transform(moved, place);
  const auto found = LikeForm(first).to(moved);
  REQUIRE(found);
  for (std::size_t i = 0; i < 12; ++i) CHECK(found->m[i] == Approx(place.m[i]).margin(1e-9));
  transform(moved, scale_matrix({1, 1.1, 1}));
  CHECK(LikeForm(first).to(moved));
  transform(moved, scale_matrix({1, 3, 1}));
  CHECK_FALSE(LikeForm(first).to(moved));
  Mesh mirrored = first;
  transform(mirrored, scale_matrix({-1, 1, 1}));
  CHECK(hash_of_corners(mirrored) == hash_of_corners(first));
  CHECK_FALSE(LikeForm(first).to(mirrored));
}

TEST_CASE("levels: what is held back with many triangles has rungs below, too", "[levels]") {
  // Half of a vessel: a dish and a wall, whose rows can go one by one at no cost.
  constexpr std::uint32_t n = 80, dish = 60, rows = 210;
  Mesh mesh;
  mesh.kind = Mesh::Kind::faces;
  auto& points = mesh.positions.edit();
  for (std::uint32_t row = 0; row <= rows; ++row)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double angle = 3.14159265358979 * i / n, tilt = 1.5707963267949 * std::min(row, dish) / dish;
      const double radius = 0.01 + std::sin(tilt), wall = row > dish ? 0.01 * (row - dish) : 0;
      points.insert(points.end(), {radius * std::cos(angle), wall - 0.5 * std::cos(tilt), radius * std::sin(angle)});
      if (row == rows || i == n) continue;
      const auto k = row * (n + 1) + i;
      mesh.corners.insert(mesh.corners.end(), {k, k + n + 1, k + 1, k + 1, k + n + 1, k + n + 2});
    }
  const auto samples = sample_surface(triangles_of(mesh), 20'000);
  const auto rungs = make_ladder({mesh, samples, {}, 0.25});
  CHECK(rungs.back().n_faces < 100);
  const auto few = std::ranges::find_if(rungs, [](const Rung& r) { return r.n_faces < 4000; });
  REQUIRE(few != rungs.end());
  CHECK(few->distortion.max < 0.02);
}
