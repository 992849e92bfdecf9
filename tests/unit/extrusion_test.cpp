// ElevationGrid and Extrusion as meshes. References are analytic or by the clauses of the standard.
#include <catch2/catch.hpp>
#include <limits>

#include "tests/unit/geometry_fixture.h"

using namespace wrlkit;
using namespace wrlkit::geometry_tests;

TEST_CASE("ElevationGrid: points, faces, texture", "[geometry]") {
  Fixture f(
      "ElevationGrid { xDimension 3 zDimension 2 xSpacing 2 zSpacing 5 height [ 0 1 2, 3 4 5 ] creaseAngle 0.5 }");
  auto& m = f.faces();
  CHECK(m.n_positions() == 6);
  CHECK(m.corners == Ints{0, 3, 4, 1, 1, 4, 5, 2});
  CHECK(m.face_begin == Ints{0, 4, 8});
  CHECK(Vec3{m.positions[15], m.positions[16], m.positions[17]} == Vec3{4, 5, 5});
  CHECK(area_vector(m, 0)[1] == Approx(10));  // up
  CHECK(m.crease_angle == 0.5);
  CHECK_FALSE(m.normal.present());
  CHECK_FALSE(m.primitive);
  CHECK(near(texcoord_at(m, {0, 0, 0}, {0, 1, 0}), 0, 0));
  CHECK(near(texcoord_at(m, {2, 1, 0}, {0, 1, 0}), 0.5, 0));
  CHECK(near(texcoord_at(m, {4, 5, 5}, {0, 1, 0}), 1, 1));
}

TEST_CASE("ElevationGrid: attributes", "[geometry]") {
  const std::string head = "ElevationGrid { xDimension 3 zDimension 2 height [ 0 1 2 3 4 5 ] ccw FALSE solid FALSE ";
  Fixture f(
      head +
      "color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0 1 1, 1 0 1 ] } normal Normal { vector [ 0 1 0, 0 2 0 ] } "
      "normalPerVertex FALSE texCoord TextureCoordinate { point [ 0 0, 1 0, 2 0, 0 1, 1 1, 2 1 ] } }");
  auto& m = f.faces();
  CHECK_FALSE((m.ccw || m.solid));
  CHECK(m.color.index == m.corners);
  CHECK(m.normal.index == Ints{0, 0, 0, 0, 1, 1, 1, 1});
  CHECK(m.texcoord.index == m.corners);
  CHECK(m.texcoord.at(5)[0] == 2);

  Fixture g(head + "color Color { color [ 1 0 0, 0 1 0 ] } colorPerVertex FALSE normal Normal { vector [ 0 1 0 ] } }");
  CHECK(g.faces().color.index == Ints{0, 0, 0, 0, 1, 1, 1, 1});
  CHECK(g.mesh.normal.index == Ints(8, 0));
  CHECK(g.diag.count(Diag::short_attribute) == 1);
}

TEST_CASE("ElevationGrid: dimensions that lie", "[geometry]") {
  auto faces = [](const std::string& fields, Diag expected) {
    Fixture f("ElevationGrid { " + fields + " }");
    auto before = f.diag.count(expected);
    f.faces();
    CHECK(f.diag.count(expected) == before + 1);
    CHECK(f.mesh.kind == Mesh::Kind::faces);
    CHECK(sound(f.mesh));
    return f.mesh.n_faces();
  };
  CHECK(faces("", Diag::degenerate_geometry) == 0);
  CHECK(faces("xDimension 1 zDimension 9 height [ 1 2 3 4 5 6 7 8 9 ]", Diag::degenerate_geometry) == 0);
  CHECK(faces("xDimension -2 zDimension -2 height [ 1 2 3 4 ]", Diag::degenerate_geometry) == 0);
  CHECK(faces("xDimension 2147483647 zDimension 2147483647 height [ 1 2 3 4 ]", Diag::degenerate_geometry) == 0);
  CHECK(faces("xDimension 2 zDimension 2147483647 height [ 1 2 3 4 5 6 7 ]", Diag::short_height) == 2);
  CHECK(faces("xDimension 2 zDimension 2 height [ 1 2 ]", Diag::degenerate_geometry) == 0);
}

TEST_CASE("Extrusion: the default is a box of 2 x 1 x 2", "[geometry]") {
  Fixture f("Extrusion { }");
  auto& m = f.faces();
  CHECK(m.n_positions() == 8);
  CHECK(m.n_faces() == 6);
  CHECK(euler(m) == 2);
  CHECK(volume(m) == Approx(4));
  CHECK(area(m) == Approx(16));
  CHECK(bounds(m).low == Vec3{-1, 0, -1});
  CHECK(bounds(m).high == Vec3{1, 1, 1});
  CHECK_FALSE((m.normal.present() || m.primitive));
  CHECK(area_vector(m, 4) == Vec3{0, -4, 0});  // beginCap
  CHECK(area_vector(m, 5) == Vec3{0, 4, 0});   // endCap
  CHECK(position(m, 0) == Vec3{1, 0, 1});      // the first quadrilateral, by 6.18.5
  CHECK(position(m, 1) == Vec3{1, 0, -1});
  CHECK(position(m, 2) == Vec3{1, 1, -1});
  CHECK(position(m, 3) == Vec3{1, 1, 1});
}

TEST_CASE("Extrusion: texture", "[geometry]") {
  Fixture f("Extrusion { crossSection [ 2 1, 2 -1, -2 -1, -2 1, 2 1 ] spine [ 0 0 0, 0 1 0, 0 3 0 ] }");
  auto& m = f.faces();
  CHECK(near(texcoord_at(m, {2, 0, 1}, {1, 0, 0}), 0, 0));
  CHECK(near(texcoord_at(m, {2, 0, -1}, {1, 0, 0}), 0.25, 0));
  CHECK(near(texcoord_at(m, {2, 1, 1}, {1, 0, 0}), 0, 0.5));  // by number, not by length
  CHECK(near(texcoord_at(m, {2, 3, 1}, {0, 0, 1}), 1, 1));
  CHECK(near(texcoord_at(m, {-2, 3, -1}, {0, 1, 0}), 0, 0));  // caps: S is X, T is Z, scaled alike
  CHECK(near(texcoord_at(m, {2, 3, 1}, {0, 1, 0}), 1, 0.5));
  CHECK(near(texcoord_at(m, {2, 0, -1}, {0, -1, 0}), 1, 0));
}

TEST_CASE("Extrusion: caps and flags", "[geometry]") {
  Fixture f("Extrusion { beginCap FALSE ccw FALSE solid FALSE convex FALSE creaseAngle 1 }");
  auto& m = f.faces();
  CHECK(m.n_faces() == 5);
  CHECK_FALSE((m.ccw || m.solid || m.convex));
  CHECK(m.crease_angle == 1);
  CHECK(m.n_positions() == 12);  // the cap has its own points, so that no creaseAngle can round its edge
  Fixture open("Extrusion { crossSection [ 1 0, 0 -1, -1 0 ] }");  // a soda can sliced in half
  CHECK(open.faces().n_faces() == 2 + 2);
  CHECK(open.mesh.end_of(2) - open.mesh.begin_of(2) == 3);
  CHECK(area_vector(open.mesh, 3)[1] == Approx(1));
}

TEST_CASE("Extrusion: scale and orientation", "[geometry]") {
  Fixture pyramid("Extrusion { scale [ 1 1, 0 0 ] spine [ 0 0 0, 0 3 0 ] }");
  CHECK(pyramid.faces().n_faces() == 5);  // no cap at the tip
  CHECK(volume(pyramid.mesh) == Approx(4));
  CHECK(pyramid.mesh.end_of(0) == 3);
  Fixture wide("Extrusion { scale 3 0.5 }");
  CHECK(bounds(wide.faces()).high == Vec3{3, 1, 0.5});
  Fixture turned("Extrusion { scale [ 2 1 ] orientation [ 0 1 0 1.5707963267948966 ] }");  // +X to -Z, after the scale
  CHECK(bounds(turned.faces()).high[2] == Approx(2));
  CHECK(bounds(turned.mesh).high[0] == Approx(1));
  Fixture twice(
      "Extrusion { spine [ 0 0 0, 0 1 0, 0 2 0 ] scale [ 1 1, 2 2 ] orientation [ 0 1 0 0, 0 1 0 0, 0 1 0 0, 0 1 0 1 ] "
      "}");
  CHECK(bounds(twice.faces()).high == Vec3{2, 2, 2});  // the last scale is repeated, the fourth orientation ignored
  CHECK(twice.message() == "Extrusion: fewer scale than spine needs; the last one is repeated");
  Fixture tilted("Extrusion { orientation [ 0 0 0 1, 0 0 1 1.5707963267948966 ] endCap FALSE beginCap FALSE }");
  CHECK(bounds(tilted.faces()).high[1] == Approx(2));  // about Z the upper section stands upright
}

TEST_CASE("Extrusion: closed spine", "[geometry]") {
  std::string spine, section = "0.5 0.5, 0.5 -0.5, -0.5 -0.5, -0.5 0.5, 0.5 0.5";
  for (int i = 0; i <= 16; ++i)
    spine += std::to_string(3 * std::cos(2 * pi * (i % 16) / 16)) + " 0 " +
             std::to_string(3 * std::sin(2 * pi * (i % 16) / 16)) + ", ";
  Fixture f("Extrusion { beginCap FALSE endCap FALSE crossSection [ " + section + " ] spine [ " + spine + " ] }");
  auto& m = f.faces();
  CHECK(m.n_positions() == 64);
  CHECK(m.n_faces() == 64);
  CHECK(euler(m) == 0);  // a torus
  CHECK(bounds(m).high[1] == Approx(0.5));
  CHECK(bounds(m).high[0] == Approx(3.5));
  // between prisms over 16-gons of radius 3.5 and 2.5
  CHECK(volume(m) == Approx(16 / 2.0 * std::sin(2 * pi / 16) * (3.5 * 3.5 - 2.5 * 2.5)).epsilon(1e-5));
  const auto last = m.texcoord.at(m.texcoord.index[m.begin_of(60) + 2]);
  CHECK(last[1] == 1);  // the texture does not run back at the seam
}

TEST_CASE("Extrusion: a surface of revolution around one point", "[geometry]") {
  // The spine stands still, the orientation turns a section next to the axis: a torus (6.18.3).
  std::string spine, orientation;
  for (int i = 0; i <= 12; ++i) {
    spine += "0 0 0, ";
    orientation += "1 0 0 " + std::to_string(2 * pi * (i % 12) / 12) + ", ";
  }
  Fixture f("Extrusion { beginCap FALSE endCap FALSE crossSection [ 1 3, 1 2, -1 2, -1 3, 1 3 ] spine [ " + spine +
            " ] orientation [ " + orientation + " ] }");
  auto& m = f.faces();
  CHECK(euler(m) == 0);
  CHECK(bounds(m).high[1] == Approx(3).epsilon(1e-5));
  CHECK(bounds(m).high[0] == Approx(1));
  CHECK(std::abs(volume(m)) == Approx(12 / 2.0 * std::sin(2 * pi / 12) * (9 - 4) * 2).epsilon(1e-5));
}

TEST_CASE("Extrusion: nothing to extrude", "[geometry]") {
  auto text = GENERATE("Extrusion { spine [ ] }", "Extrusion { spine [ 0 0 0 ] }", "Extrusion { crossSection [ ] }",
                       "Extrusion { crossSection [ 1 1 ] }", "Extrusion { crossSection [ 1 1, 1 1, 1 1 ] }",
                       "Extrusion { scale 0 0 }", "Extrusion { spine [ 0 0 0, 0 0 0 ] beginCap FALSE endCap FALSE }",
                       "Extrusion { crossSection [ 9 0, 0 9, -9 -9 ] scale 1e308 1 }");
  INFO(text);
  Fixture f(text);
  auto before = f.diag.count(Diag::degenerate_geometry);
  CHECK(f.faces().kind == Mesh::Kind::faces);
  CHECK(f.mesh.n_faces() == 0);
  CHECK(f.diag.count(Diag::degenerate_geometry) == before + 1);
}

TEST_CASE("Extrusion: empty scale and orientation, numbers that are none", "[geometry]") {
  Fixture f("Extrusion { scale [ ] orientation [ ] }");
  CHECK(volume(f.faces()) == Approx(4));
  f.scene.set(f.root(), nodes::extrusion::orientation, std::vector<double>{NAN, 1, 0, NAN});
  f.scene.set(f.root(), nodes::extrusion::spine, std::vector<double>{NAN, 0, 0, 0, 1, 0});
  f.mesh.clear();
  CHECK(volume(f.faces()) == Approx(4));
  CHECK(f.diag.count(Diag::not_finite) == 1);
}

TEST_CASE("Extrusion: a short file cannot ask for everything", "[geometry]") {
  Fixture f("Extrusion { }");
  std::vector<double> many(3 * 30'000), flat(2 * 30'000);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = std::sin(double(i));
  for (std::size_t i = 0; i < flat.size(); ++i) flat[i] = std::cos(double(i));
  f.scene.set(f.root(), nodes::extrusion::spine, many);
  f.scene.set(f.root(), nodes::extrusion::crossSection, flat);
  CHECK(f.faces().n_faces() <= 1'000'002);
  CHECK(f.mesh.n_faces() > 900'000);
  CHECK(f.diag.count(Diag::expansion_limit) == 1);
  CHECK(sound(f.mesh));
}
