// Box, Cone, Cylinder and Sphere as meshes. References are analytic.
#include <catch2/catch.hpp>

#include "tests/unit/geometry_fixture.h"

using namespace wrlkit;
using namespace wrlkit::geometry_tests;

TEST_CASE("Box", "[geometry]") {
  Fixture f("Box { size 2 4 6 }");
  auto& m = f.faces();
  CHECK(m.primitive);
  CHECK(m.n_positions() == 8);
  CHECK(m.n_faces() == 6);
  CHECK(m.corners.size() == 24);
  CHECK(euler(m) == 2);
  CHECK(area(m) == Approx(88));
  CHECK(volume(m) == Approx(48));
  CHECK(bounds(m).low == Vec3{-1, -2, -3});
  CHECK(bounds(m).high == Vec3{1, 2, 3});
  CHECK(normals_fit(m));
  CHECK_FALSE(texture_mirrored(m));
  for (std::size_t face = 0; face < 6; ++face)  // flat
    for (auto c = m.begin_of(face); c < m.end_of(face); ++c)
      CHECK(dot(normal_at(m, c), area_vector(m, face)) == Approx(length(area_vector(m, face))));
}

TEST_CASE("Box: the lower left corner of the picture on each face", "[geometry]") {
  Fixture f("Box { }");
  auto& m = f.faces();
  CHECK(near(texcoord_at(m, {-1, -1, 1}, {0, 0, 1}), 0, 0));    // front
  CHECK(near(texcoord_at(m, {1, -1, -1}, {0, 0, -1}), 0, 0));   // back
  CHECK(near(texcoord_at(m, {1, -1, 1}, {1, 0, 0}), 0, 0));     // right
  CHECK(near(texcoord_at(m, {-1, -1, -1}, {-1, 0, 0}), 0, 0));  // left
  CHECK(near(texcoord_at(m, {-1, 1, 1}, {0, 1, 0}), 0, 0));     // top, -Z up
  CHECK(near(texcoord_at(m, {-1, -1, -1}, {0, -1, 0}), 0, 0));  // bottom, +Z up
  CHECK(near(texcoord_at(m, {1, 1, 1}, {0, 0, 1}), 1, 1));
  CHECK(near(texcoord_at(m, {1, 1, -1}, {0, 1, 0}), 1, 1));
}

TEST_CASE("Box: flat, inside out, impossible", "[geometry]") {
  Fixture flat("Box { size 2 0 2 }"), negative("Box { size -2 4 6 }"), line("Box { size 0 0 2 }");
  CHECK(flat.faces().n_faces() == 2);
  CHECK(area(flat.mesh) == Approx(8));
  CHECK(volume(negative.faces()) == Approx(48));
  CHECK(line.faces().n_faces() == 0);
  CHECK(line.diag.count(Diag::degenerate_geometry) == 1);
  Fixture nan("Box { }");
  nan.scene.set(nan.root(), nodes::box::size, Vec3{1, NAN, 1});
  CHECK(nan.faces().n_faces() == 0);
  CHECK(nan.message(0) == "Box has no surface: its size is zero or not finite");
}

TEST_CASE("Circles: segments by size and by tolerance", "[geometry]") {
  auto segments = [](double radius, TessellateOptions options) {
    Fixture f("Cylinder { top FALSE bottom FALSE }");
    f.scene.set(f.root(), nodes::cylinder::radius, radius);
    return f.faces(options).n_faces();
  };
  CHECK(segments(0.0001, {}) == 8);
  CHECK(segments(0.005, {}) == 12);
  CHECK(segments(0.1, {}) == 20);
  CHECK(segments(1, {}) == 32);
  CHECK(segments(10, {}) == 56);
  CHECK(segments(1e6, {}) == 64);
  CHECK(segments(1, {.tolerance = 1}) == 8);
  CHECK(segments(1, {.tolerance = 1e-12}) == 256);
  CHECK(segments(1, {.segments = 5}) == 5);
  CHECK(segments(1, {.segments = 1}) == 3);
  CHECK(segments(1, {.segments = 1000000}) == 1024);
  for (double radius : {0.1, 1.0, 30.0})
    for (double tolerance : {0.001, 0.01}) {
      double n = double(segments(radius, {.tolerance = tolerance}));
      CHECK((n == 256 || radius * (1 - std::cos(pi / n)) <= tolerance));
      if (n > 8) CHECK(radius * (1 - std::cos(pi / (n - 4))) > tolerance);
    }
}

TEST_CASE("Cylinder", "[geometry]") {
  Fixture f("Cylinder { radius 2 height 6 }");
  auto& m = f.faces({.segments = 16});
  CHECK(m.n_positions() == 32);
  CHECK(m.n_faces() == 18);
  CHECK(euler(m) == 2);
  const double base = 16 / 2.0 * std::sin(2 * pi / 16) * 4, edge = 2 * 2 * std::sin(pi / 16);
  CHECK(volume(m) == Approx(base * 6));
  CHECK(area(m) == Approx(2 * base + 16 * edge * 6));
  CHECK(bounds(m).low == Vec3{-2, -3, -2});
  CHECK(bounds(m).high == Vec3{2, 3, 2});
  CHECK(normals_fit(m));
  CHECK_FALSE(texture_mirrored(m));
  for (std::size_t c = 0; c < m.begin_of(16); ++c) {  // the side: radial
    auto p = position(m, c), n = normal_at(m, c);
    CHECK(n[0] == Approx(p[0] / 2).margin(1e-6));
    CHECK(n[2] == Approx(p[2] / 2).margin(1e-6));
    CHECK(n[1] == 0);
  }
  CHECK(normal_at(m, m.begin_of(16)) == Vec3{0, 1, 0});
  CHECK(normal_at(m, m.begin_of(17)) == Vec3{0, -1, 0});
}

TEST_CASE("Cylinder: texture", "[geometry]") {
  Fixture f("Cylinder { }");
  auto& m = f.faces({.segments = 16});
  CHECK(near(texcoord_at(m, {-1, -1, 0}, {-1, 0, 0}), 0.25, 0));  // counterclockwise from the back: left at a quarter
  CHECK(near(texcoord_at(m, {0, 1, 1}, {0, 0, 1}), 0.5, 1));      // front in the middle
  CHECK(near(texcoord_at(m, {1, 1, 0}, {1, 0, 0}), 0.75, 1));
  CHECK(near(texcoord_at(m, {0, -1, -1}, {-0.2, 0, -1}), 0, 0));  // the seam, on either side
  CHECK(near(texcoord_at(m, {0, -1, -1}, {0.2, 0, -1}), 1, 0));
  CHECK(near(texcoord_at(m, {0, 1, -1}, {0, 1, 0}), 0.5, 1));  // top: -Z is up
  CHECK(near(texcoord_at(m, {1, 1, 0}, {0, 1, 0}), 1, 0.5));
  CHECK(near(texcoord_at(m, {0, -1, 1}, {0, -1, 0}), 0.5, 1));  // bottom: +Z is up
  CHECK(near(texcoord_at(m, {1, -1, 0}, {0, -1, 0}), 1, 0.5));
}

TEST_CASE("Cylinder and Cone: parts", "[geometry]") {
  struct Case {
    std::string text;
    std::size_t n_faces;
  };
  auto c = GENERATE(values<Case>({{"Cylinder { side FALSE }", 2},
                                  {"Cylinder { top FALSE }", 13},
                                  {"Cylinder { bottom FALSE side FALSE }", 1},
                                  {"Cylinder { side FALSE top FALSE bottom FALSE }", 0},
                                  {"Cylinder { height 0 }", 2},
                                  {"Cone { side FALSE }", 1},
                                  {"Cone { bottom FALSE }", 12},
                                  {"Cone { bottom FALSE side FALSE }", 0}}));
  Fixture f(c.text);
  INFO(c.text);
  CHECK(f.faces({.segments = 12}).n_faces() == c.n_faces);
  CHECK(f.diag.count(Diag::degenerate_geometry) == (c.n_faces == 0 ? 1 : 0));
  CHECK(sound(f.mesh));
  CHECK(normals_fit(f.mesh));
}

TEST_CASE("Cylinder: which cap is the top", "[geometry]") {
  Fixture f("Cylinder { side FALSE bottom FALSE }"), g("Cylinder { side FALSE top FALSE }");
  CHECK(bounds(f.faces()).low[1] == 1);
  CHECK(area_vector(f.mesh, 0)[1] > 0);
  CHECK(bounds(g.faces()).high[1] == -1);
  CHECK(area_vector(g.mesh, 0)[1] < 0);
}

TEST_CASE("Cone", "[geometry]") {
  Fixture f("Cone { bottomRadius 2 height 6 }");
  auto& m = f.faces({.segments = 16});
  CHECK(m.n_positions() == 17);
  CHECK(m.n_faces() == 17);
  CHECK(euler(m) == 2);
  CHECK(volume(m) == Approx(16 / 2.0 * std::sin(2 * pi / 16) * 4 * 6 / 3));
  CHECK(bounds(m).low == Vec3{-2, -3, -2});
  CHECK(bounds(m).high == Vec3{2, 3, 2});
  CHECK(normals_fit(m));
  CHECK_FALSE(texture_mirrored(m));
  for (std::size_t c = 0; c < 48; ++c) {  // the side: square to the slope, which is (-2, 6) in radius and height
    auto p = position(m, c), n = normal_at(m, c);
    const double radial = std::hypot(n[0], n[2]);
    CHECK(n[1] / radial == Approx(2.0 / 6));
    if (p[1] < 0) CHECK(n[0] * p[2] - n[2] * p[0] == Approx(0).margin(1e-6));
  }
  for (std::size_t t = 0; t < 16; ++t)  // at the apex: that of the triangle itself
    CHECK(dot(normal_at(m, 3 * t + 2), area_vector(m, t)) == Approx(length(area_vector(m, t))).epsilon(0.002));
  CHECK(near(texcoord_at(m, {-2, -3, 0}, {-1, 0, 0}), 0.25, 0));
  CHECK(near(texcoord_at(m, {0, -3, 2}, {0, 0, 1}), 0.5, 0));
  CHECK(near(texcoord_at(m, {0, -3, 2}, {0, -1, 0}), 0.5, 1));
  CHECK(texcoord_at(m, {0, 3, 0}, {-0.2, 0.5, -1})[0] == Approx(0.5 / 16));
  CHECK(texcoord_at(m, {0, 3, 0}, {-0.2, 0.5, -1})[1] == 1);
}

TEST_CASE("Cone: no bottom means triangles only", "[geometry]") {
  Fixture f("Cone { bottom FALSE }");
  CHECK(f.faces().is_triangles());
}

TEST_CASE("Sphere", "[geometry]") {
  Fixture f("Sphere { radius 3 }");
  auto& m = f.faces({.segments = 16});
  CHECK(m.n_positions() == 2 + 7 * 16);
  CHECK(m.n_faces() == 8 * 16);
  CHECK(euler(m) == 2);
  double v = 0;  // frusta of 16-gons
  auto base = [](int j) { return 16 / 2.0 * std::sin(2 * pi / 16) * std::pow(3 * std::sin(pi * j / 8), 2); };
  auto y = [](int j) { return -3 * std::cos(pi * j / 8); };
  for (int j = 0; j < 8; ++j)
    v += (y(j + 1) - y(j)) / 3 * (base(j) + base(j + 1) + std::sqrt(std::abs(base(j) * base(j + 1))));
  CHECK(volume(m) == Approx(v));
  CHECK(bounds(m).low == Vec3{-3, -3, -3});
  CHECK(bounds(m).high == Vec3{3, 3, 3});
  CHECK(normals_fit(m));
  CHECK_FALSE(texture_mirrored(m));
  for (std::size_t c = 0; c < m.corners.size(); ++c) {
    CHECK(length(position(m, c)) == Approx(3));
    CHECK(dot(position(m, c), normal_at(m, c)) == Approx(3));
  }
  for (std::size_t face = 0; face < m.n_faces(); ++face) CHECK(length(area_vector(m, face)) > 0.01);
  std::size_t n_triangles = 0;
  for (std::size_t face = 0; face < m.n_faces(); ++face) n_triangles += m.end_of(face) - m.begin_of(face) == 3;
  CHECK(n_triangles == 32);
}

TEST_CASE("Sphere: texture", "[geometry]") {
  Fixture f("Sphere { }");
  auto& m = f.faces({.segments = 32});
  CHECK(near(texcoord_at(m, {0, 0, 1}, {0, 0, 1}), 0.5, 0.5));
  CHECK(near(texcoord_at(m, {-1, 0, 0}, {-1, 0, 0}), 0.25, 0.5));
  CHECK(near(texcoord_at(m, {0, 0, -1}, {-0.1, 0, -1}), 0, 0.5));
  CHECK(near(texcoord_at(m, {0, 0, -1}, {0.1, 0, -1}), 1, 0.5));
  CHECK(near(texcoord_at(m, {0, std::sqrt(0.5), std::sqrt(0.5)}, {0, 1, 1}), 0.5, 0.75));
  CHECK(texcoord_at(m, {0, 1, 0}, {-0.1, 1, -1})[0] == Approx(0.5 / 32));
  CHECK(texcoord_at(m, {0, -1, 0}, {-0.1, -1, -1})[1] == 0);
}

TEST_CASE("Sphere: converges, whatever the segments", "[geometry]") {
  Fixture f("Sphere { radius 2 }");
  CHECK(volume(f.faces({.segments = 256})) == Approx(4 / 3.0 * pi * 8).epsilon(0.001));
  for (int n : {3, 4, 5, 7, 10}) {
    CHECK(euler(f.faces({.segments = n})) == 2);
    CHECK(sound(f.mesh));
    CHECK(f.mesh.n_faces() == std::size_t((n + n % 2) * ((n + n % 2) / 2)));
  }
}

TEST_CASE("Primitives without a surface", "[geometry]") {
  auto text = GENERATE("Sphere { }", "Cylinder { radius 0 }", "Cone { bottomRadius 0 }");
  Fixture f(text);
  if (f.scene.is(f.root(), nodes::Sphere)) f.scene.set(f.root(), nodes::sphere::radius, GENERATE(0.0, INFINITY, NAN));
  CHECK(f.faces().kind == Mesh::Kind::faces);
  CHECK(f.mesh.n_faces() == 0);
  CHECK(f.diag.count(Diag::degenerate_geometry) == 1);
}

TEST_CASE("tessellate tells what it did", "[geometry]") {
  Fixture f("Box { }" + grid(""));
  auto box = f.job(f.root(0));
  CHECK(tessellate(box, {.triangles = false}) == Outcome::changed);
  CHECK(tessellate(box, {.triangles = false}) == Outcome::unchanged);  // the mesh is there
  f.read(f.root(1));
  auto set = f.job(f.root(1));
  CHECK(tessellate(set, {.triangles = false}) == Outcome::unchanged);
  CHECK(tessellate(set, {.triangles = false, .texcoords = true}) == Outcome::changed);
  CHECK(f.stats["tessellate.shapes"] == 1);
}
