#include "geometry/vertices.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <tuple>

using namespace wrlkit;

namespace {

using Indices = std::vector<std::uint32_t>;
using Floats = std::vector<float>;

/// A cube of edge 2 with one normal for each of its faces, as triangles.
Mesh cube() {
  Mesh m;
  m.kind = Mesh::Kind::faces;
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis) m.positions.edit().push_back(i >> axis & 1 ? 1 : -1);
  const std::uint32_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  m.normal.values = {-1, 0, 0, 1, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, -1, 0, 0, 1};
  for (std::uint32_t f = 0; f < 6; ++f)
    for (int c : {0, 1, 2, 0, 2, 3}) {
      m.corners.push_back(faces[f][c]);
      m.normal.index.push_back(f);
    }
  return m;
}

/// A mesh over the points (0 0 0) (1 0 0) (2 1 0) (3 0 0) ...
Mesh mesh(Mesh::Kind kind, const Indices& corners, const Indices& face_begin = {}) {
  Mesh m;
  m.kind = kind;
  for (int i = 0; i < 10; ++i)
    for (double x : {double(i), double(i == 2), 0.}) m.positions.edit().push_back(x);
  m.corners = corners;
  m.face_begin = face_begin;
  return m;
}

Vertices split(const Mesh& m, const SplitOptions& options = {}) {
  SplitScratch scratch;
  Vertices out;
  split_vertices(m, options, scratch, out);
  return out;
}

}  // namespace

TEST_CASE("vertices: a cube with a normal for each face has 24 of them") {
  Vertices v = split(cube());
  CHECK(v.count() == 24);
  CHECK(v.index.size() == 36);
  CHECK(v.min == std::array<float, 3>{-1, -1, -1});
  CHECK(v.max == std::array<float, 3>{1, 1, 1});
  CHECK(Indices(v.index.begin(), v.index.begin() + 12) == Indices{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7});
  CHECK(Floats(v.position.begin(), v.position.begin() + 6) == Floats{-1, -1, -1, -1, -1, 1});
  for (std::size_t i = 0; i < 24; ++i) {
    Floats n(3);
    n[i / 8] = i / 4 % 2 ? 1.f : -1.f;
    CHECK(Floats(&v.normal[3 * i], &v.normal[3 * i] + 3) == n);
  }
  CHECK(v.color.empty());
  CHECK(v.texcoord.empty());
  CHECK(v.n_dropped == 0);
}

TEST_CASE("vertices: without normals a cube has 8, in the order of their first corners") {
  Vertices v = split(cube(), {.normals = false});
  CHECK(v.count() == 8);
  CHECK(v.normal.empty());
  CHECK(Indices(v.index.begin(), v.index.begin() + 12) == Indices{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7});
  Floats expected;  // positions 0 4 6 2 1 3 7 5
  for (int i : {0, 4, 6, 2, 1, 3, 7, 5})
    for (int axis = 0; axis < 3; ++axis) expected.push_back(i >> axis & 1 ? 1.f : -1.f);
  CHECK(v.position == expected);
}

TEST_CASE("vertices: every attribute splits, and only where it differs") {
  Mesh m = mesh(Mesh::Kind::faces, {0, 1, 2, 2, 1, 3});
  m.color.values = {1, 0, 0, 0, 1, 0};
  m.color.index = {0, 0, 0, 0, 1, 0};
  m.texcoord.values = {0, 0, 0.25, 1};
  m.texcoord.index = {0, 0, 0, 1, 0, 0};
  Vertices v = split(m);
  CHECK(v.index == Indices{0, 1, 2, 3, 4, 5});
  CHECK(v.texcoord == Floats{0, 0, 0, 0, 0, 0, 0.25, 1, 0, 0, 0, 0});
  CHECK(v.color == Floats{1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0});
  v = split(m, {.colors = false});
  CHECK(v.index == Indices{0, 1, 2, 3, 1, 4});
  CHECK(v.color.empty());
  v = split(m, {.colors = false, .texcoords = false});
  CHECK(v.index == Indices{0, 1, 2, 2, 1, 3});
}

TEST_CASE("vertices: ccw FALSE and mirror each reverse the corners") {
  Mesh m = mesh(Mesh::Kind::faces, {4, 5, 2});
  CHECK(split(m).index == Indices{0, 1, 2});
  CHECK(split(m, {.mirror = true}).index == Indices{0, 2, 1});
  m.ccw = false;
  CHECK(split(m).index == Indices{0, 2, 1});
  CHECK(split(m, {.mirror = true}).index == Indices{0, 1, 2});
  CHECK(split(m).position == split(m, {.mirror = true}).position);
}

TEST_CASE("vertices: polygons are fans, polylines are segments, points are points") {
  CHECK(split(mesh(Mesh::Kind::faces, {1, 3, 2, 0, 4, 5, 6}, {0, 4, 4, 7})).index ==
        Indices{0, 1, 2, 0, 2, 3, 4, 5, 6});
  Vertices lines = split(mesh(Mesh::Kind::lines, {5, 6, 7, 5, 8, 9}, {0, 4, 6}));
  CHECK(lines.index == Indices{0, 1, 1, 2, 2, 0, 3, 4});
  CHECK(lines.count() == 5);
  CHECK(split(mesh(Mesh::Kind::lines, {5, 6, 6, 5})).index == Indices{0, 1, 1, 0});
  Vertices points = split(mesh(Mesh::Kind::points, {9, 8, 9}));
  CHECK(points.index == Indices{0, 1, 0});
  CHECK(points.min == std::array<float, 3>{8, 0, 0});
  CHECK(points.max == std::array<float, 3>{9, 0, 0});
}

TEST_CASE("vertices: only triangles that use a vertex twice are dropped") {
  Vertices v = split(mesh(Mesh::Kind::faces, {0, 1, 2, 0, 1, 3, 0, 1, 1, 2, 3, 2}));
  CHECK(v.n_dropped == 2);
  CHECK(v.index == Indices{0, 1, 2, 0, 1, 3});  // 0 1 3 has no area, but it stays
  v = split(mesh(Mesh::Kind::faces, {0, 1, 1, 2, 3}, {0, 5}));
  CHECK(v.n_dropped == 1);
  CHECK(v.index == Indices{0, 1, 2, 0, 2, 3});
  v = split(mesh(Mesh::Kind::faces, {0, 0, 0}));
  CHECK(v.n_dropped == 1);
  CHECK(v.index.empty());
}

TEST_CASE("vertices: the origin is subtracted before rounding") {
  Mesh m = mesh(Mesh::Kind::points, {0, 1});
  m.positions.edit() = {5'000'000.123, 2, 3, 5'000'000.25, 2, -3};
  Vertices v = split(m, {.origin = {5'000'000, 2, 0}});
  CHECK(v.position[0] == Approx(0.123).margin(1e-9));
  CHECK(Floats(v.position.begin() + 1, v.position.end()) == Floats{0, 3, 0.25, 0, -3});
  CHECK(v.origin == std::array<double, 3>{5'000'000, 2, 0});
  CHECK(v.max[0] == 0.25f);
  CHECK(v.min[2] == -3);

  m.positions.edit() = {0.1, 0.1, 0.1, 0.7, 0.7, 0.7};
  v = split(m);
  CHECK(v.min[0] == 0.1f);  // of what is written, not of the double
  CHECK(v.max[0] == 0.7f);
}

TEST_CASE("vertices: normals get unit length") {
  Mesh m = mesh(Mesh::Kind::faces, {0, 1, 2, 0, 1, 3});
  float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  m.normal.values = {0, 3, 4, 0, 0, 0, nan, 0, 0, inf, 0, 0, 1e-30f, 0, 0, 3e38f, 0, 0};
  m.normal.index = {0, 1, 2, 3, 4, 5};
  Vertices v = split(m);
  CHECK(v.normal == Floats{0, 0.6f, 0.8f, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0});
  m.ccw = false;  // the normal of the face is that of its front; the face 0 1 3 has none
  CHECK(split(m).normal == Floats{0, 0.6f, 0.8f, 0, 0, -1, 0, 0, -1, 0, 0, 1, 1, 0, 0, 1, 0, 0});
  m.kind = Mesh::Kind::points;
  CHECK(split(m).normal == Floats{0, 0.6f, 0.8f, 0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0});

  m = mesh(Mesh::Kind::faces, {0, 1, 2});
  m.normal.values = {0, 0, 0.9999999f};  // near enough
  m.normal.index = {0, 0, 0};
  v = split(m);
  CHECK(Floats(v.normal.begin(), v.normal.begin() + 3) == m.normal.values);
}

TEST_CASE("vertices: colors are clamped, and made linear when asked") {
  Mesh m = mesh(Mesh::Kind::points, {0, 1, 2});
  m.color.width = 4;
  m.color.values = {0, 1, 0.5f, 0.5f, -1, 2, std::numeric_limits<float>::quiet_NaN(), 0.04f, 0.5f, 0.04045f, 0.2f, 1};
  m.color.index = {0, 1, 2};
  Vertices v = split(m);
  CHECK(v.color_width == 4);
  CHECK(v.color == Floats{0, 1, 0.5f, 0.5f, 0, 1, 0, 0.04f, 0.5f, 0.04045f, 0.2f, 1});
  v = split(m, {.linear_colors = true});
  Floats expected{0, 1, 0.21404114f, 0.5f, 0, 1, 0, 0.04f, 0.21404114f, 0.0031308049f, 0.033104767f, 1};
  for (std::size_t i = 0; i < 12; ++i) CHECK(v.color[i] == Approx(expected[i]).epsilon(1e-6));
}

TEST_CASE("vertices: the table of conversions is the function itself") {
  Mesh m;
  m.kind = Mesh::Kind::points;
  m.positions.edit() = {0, 0, 0};
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    m.corners.push_back(0);
    for (std::uint32_t j : {i, i / 2, i / 3}) m.color.values.push_back(static_cast<float>(j) / 20'000);
    m.color.index.push_back(i);
  }
  Vertices v = split(m, {.linear_colors = true});
  REQUIRE(v.count() == 20'000);
  for (std::size_t i = 0; i < v.color.size(); ++i) {
    double x = m.color.values[i], expected = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    REQUIRE(v.color[i] == static_cast<float>(expected));
  }
}

TEST_CASE("vertices: texture coordinates are turned upside down when asked") {
  Mesh m = mesh(Mesh::Kind::points, {0, 1});
  m.texcoord.values = {0.25f, 0.125f, -3, std::numeric_limits<float>::infinity()};
  m.texcoord.index = {0, 1};
  CHECK(split(m, {.flip_v = true}).texcoord == Floats{0.25f, 0.875f, -3, -std::numeric_limits<float>::max()});
  CHECK(split(m, {.flip_v = true}).n_not_finite == 1);
}

TEST_CASE("vertices: all numbers are finite") {
  Mesh m = mesh(Mesh::Kind::points, {0, 1});
  m.positions.edit() = {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e39, -1e39, 1e-60};
  Vertices v = split(m);
  float largest = std::numeric_limits<float>::max();
  CHECK(v.position == Floats{0, largest, -largest, largest, -largest, 0});
  CHECK(v.n_not_finite == 5);
}

TEST_CASE("vertices: a mesh of nothing") {
  CHECK(split(Mesh{}).count() == 0);
  Vertices v = split(mesh(Mesh::Kind::faces, {}));
  CHECK(v.count() == 0);
  CHECK(v.max == std::array<float, 3>{0, 0, 0});
}

TEST_CASE("vertices: 100,000 vertices at one position, each of them twice") {
  constexpr std::uint32_t n = 100'000;
  Mesh m = mesh(Mesh::Kind::faces, {});
  for (std::uint32_t round = 0; round < 2; ++round)
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t p : {0, 1, 2}) {
        m.corners.push_back(p);
        m.texcoord.index.push_back(p == 0 ? i : 0);
      }
  m.texcoord.values.assign(2 * n, 0.5f);
  Vertices v = split(m);
  CHECK(v.count() == n + 2);
  CHECK(v.index.size() == 6 * n);
  CHECK(v.index[3 * (2 * n - 1)] == v.index[3 * (n - 1)]);
  CHECK(v.index[3 * (n - 1)] == n + 1);
}

TEST_CASE("vertices: a face of 100,000 corners that has neither normals nor one to give") {
  Mesh m = mesh(Mesh::Kind::faces, {}, {0, 100'000});
  m.normal.values.assign(3 * 100'000, 0);
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    m.corners.push_back(3 + i % 7);
    m.normal.index.push_back(i);
  }
  Vertices v = split(m);
  CHECK(v.count() == 100'000);
  CHECK(v.index.size() == 3 * 99'998);
  for (std::size_t i = 0; i < v.normal.size(); ++i) REQUIRE(v.normal[i] == (i % 3 == 2 ? 1 : 0));
}

TEST_CASE("vertices: few positions of very many, very often") {
  constexpr std::size_t n = 10'000'000;
  std::unique_ptr<double[], void (*)(void*)> points(static_cast<double*>(std::calloc(3 * n, sizeof(double))),
                                                    std::free);
  Mesh m;
  m.kind = Mesh::Kind::faces;
  m.positions = Array<double>::borrow({points.get(), 3 * n});
  m.corners = {n - 1, n - 2, 5, n - 2, 5, 7};
  SplitScratch scratch;
  Vertices v;
  for (int i = 0; i < 100'000; ++i) split_vertices(m, {}, scratch, v);
  CHECK(v.index == Indices{0, 1, 2, 1, 2, 3});
  CHECK(v.count() == 4);
}

TEST_CASE("vertices: agrees with a map of the four indices, whatever came before") {
  std::mt19937 random(2);
  SplitScratch scratch;
  Vertices v;
  for (int round = 0; round < 200; ++round) {
    std::uint32_t some = 1 + random() % 40;
    Mesh m = mesh(Mesh::Kind::points, {});
    m.normal.values.assign(3 * some, 1);
    m.color.values.assign(3 * some, 1);
    m.texcoord.values.assign(2 * some, 1);
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> expected;
    Indices index;
    for (std::uint32_t c = random() % 2000; c > 0; --c) {
      std::tuple key{std::uint32_t(random() % 4), std::uint32_t(random() % some), std::uint32_t(random() % some),
                     std::uint32_t(random() % some / 8)};
      m.corners.push_back(std::get<0>(key));
      m.normal.index.push_back(std::get<1>(key));
      m.color.index.push_back(std::get<2>(key));
      m.texcoord.index.push_back(std::get<3>(key));
      index.push_back(expected.emplace(key, static_cast<std::uint32_t>(expected.size())).first->second);
    }
    split_vertices(m, {}, scratch, v);
    REQUIRE(v.index == index);
    REQUIRE(v.count() == expected.size());
  }
}
