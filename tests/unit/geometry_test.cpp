// Geometry nodes as meshes: read_mesh, and the default texture coordinates. References are the clauses of the standard.
#include <catch2/catch.hpp>
#include <limits>

#include "tests/unit/geometry_fixture.h"

using namespace wrlkit;
using namespace wrlkit::geometry_tests;

TEST_CASE("IndexedFaceSet: corners, faces and flags", "[geometry]") {
  Fixture f(grid("ccw FALSE solid FALSE convex FALSE creaseAngle 0.5"));
  auto& m = f.read();
  CHECK(m.kind == Mesh::Kind::faces);
  CHECK(m.corners == Ints{0, 3, 4, 1, 1, 4, 5, 2});
  CHECK(m.face_begin == Ints{0, 4, 8});
  CHECK(m.positions.data() ==
        f.scene.get(f.scene.get(f.root(), nodes::indexed_face_set::coord), nodes::coordinate::point).data());
  CHECK_FALSE((m.ccw || m.solid || m.convex || m.primitive));
  CHECK(m.crease_angle == 0.5);
  CHECK_FALSE((m.color.present() || m.normal.present() || m.texcoord.present()));
  CHECK(f.diag.messages().empty());
  CHECK(area(m) == Approx(2));
}

TEST_CASE("IndexedFaceSet: triangles need no face_begin", "[geometry]") {
  auto list =
      GENERATE("0 3 1 -1 1 3 4 -1", "0 3 1 -1 1 3 4", "0 3 1 -1, 2 -1 1 3 4", "-1 0 3 1 -1 9 8 7 -1 1 3 4 -1 -1");
  Fixture f(grid("", list));
  CHECK(f.read().corners == Ints{0, 3, 1, 1, 3, 4});
  CHECK(f.mesh.face_begin.empty());
  CHECK(f.mesh.n_faces() == 2);
}

TEST_CASE("IndexedFaceSet: triangles and then something else", "[geometry]") {
  Fixture f(grid("", "0 3 1 -1 1 3 4 -1 1 4 5 2 -1 0 1 2"));
  CHECK(f.read().corners == Ints{0, 3, 1, 1, 3, 4, 1, 4, 5, 2, 0, 1, 2});
  CHECK(f.mesh.face_begin == Ints{0, 3, 6, 10, 13});
}

TEST_CASE("IndexedFaceSet: bad indices and faces that are none are dropped and counted", "[geometry]") {
  Fixture f(grid("", "0 3 4 1 -1 0 6 1 -1 -1 0 1 -1 -2 0 1 -1 2000000000 2 3 4 -1 1 4 5 2"));
  CHECK(f.read().corners == Ints{0, 3, 4, 1, 1, 4, 5, 2});
  CHECK(f.mesh.face_begin == Ints{0, 4, 8});
  CHECK(f.diag.count(Diag::bad_index) == 1);
  CHECK(f.message(0) == "IndexedFaceSet: indices out of range (3 of 26); their faces are dropped");
  CHECK(f.message(1) == "IndexedFaceSet: 2 faces without area are dropped");
}

TEST_CASE("IndexedFaceSet: nothing to read", "[geometry]") {
  Fixture f(
      "IndexedFaceSet { solid TRUE } IndexedFaceSet { solid TRUE coordIndex [ 0 1 2 -1 ] } "
      "DEF Name IndexedFaceSet { coord Color { } coordIndex [ 0 1 2 ] } "
      "IndexedFaceSet { coord Coordinate { point [ 0 0 0 ] } coordIndex [ -1 -1 ] }");
  auto before = f.diag.messages().size();
  for (std::size_t i = 0; i < 4; ++i) {
    auto& m = f.read(f.root(i));
    CHECK(m.kind == Mesh::Kind::faces);
    CHECK(m.n_faces() == 0);
    CHECK(m.corners.empty());
  }
  CHECK(f.diag.count(Diag::degenerate_geometry) == 2);
  CHECK(f.message(before + 1) == "IndexedFaceSet Name has no surface: it has no points");
}

TEST_CASE("IndexedFaceSet: the four colour bindings", "[geometry]") {
  const std::string color = "color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0 1 1, 1 0 1 ] } ";
  auto index = [&](const std::string& rest) {
    Fixture f(grid(color + rest));
    auto i = f.read().color.index;
    CHECK(f.diag.messages().empty());
    CHECK(f.mesh.color.values.size() == 18);
    CHECK(sound(f.mesh));
    return i;
  };
  CHECK(index("") == Ints{0, 3, 4, 1, 1, 4, 5, 2});
  CHECK(index("colorIndex [ 5 4 3 2 -1 0 1 2 3 -1 ]") == Ints{5, 4, 3, 2, 0, 1, 2, 3});
  CHECK(index("colorIndex [ 5 4 3 2 -1 0 1 2 3 ]") == Ints{5, 4, 3, 2, 0, 1, 2, 3});
  CHECK(index("colorPerVertex FALSE") == Ints{0, 0, 0, 0, 1, 1, 1, 1});
  CHECK(index("colorPerVertex FALSE colorIndex [ 4 2 ]") == Ints{4, 4, 4, 4, 2, 2, 2, 2});
  CHECK(index("colorPerVertex FALSE colorIndex [ 4 -1 2 -1 ]") == Ints{4, 4, 4, 4, 2, 2, 2, 2});
}

TEST_CASE("IndexedFaceSet: the four normal bindings, values as authored", "[geometry]") {
  const std::string normal = "normal Normal { vector [ 0 0 1, 0 0 2, 0 1 0, 1 0 0, 0 0 -1, 3 4 0 ] } ";
  auto index = [&](const std::string& rest) {
    Fixture f(grid(normal + rest));
    auto i = f.read().normal.index;
    CHECK(f.mesh.normal.at(5)[1] == 4);
    return i;
  };
  CHECK(index("") == Ints{0, 3, 4, 1, 1, 4, 5, 2});
  CHECK(index("normalIndex [ 5 4 3 2 -1 0 1 2 3 -1 ]") == Ints{5, 4, 3, 2, 0, 1, 2, 3});
  CHECK(index("normalPerVertex FALSE") == Ints{0, 0, 0, 0, 1, 1, 1, 1});
  CHECK(index("normalPerVertex FALSE normalIndex [ 4 5 ]") == Ints{4, 4, 4, 4, 5, 5, 5, 5});
}

TEST_CASE("IndexedFaceSet: texture coordinates", "[geometry]") {
  const std::string texCoord = "texCoord TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1, 0.5 0.5, 0.25 0.75 ] } ";
  Fixture by_coord(grid(texCoord)), by_own(grid(texCoord + "texCoordIndex [ 0 1 2 3 -1 3 2 1 0 -1 ]"));
  CHECK(by_coord.read().texcoord.index == Ints{0, 3, 4, 1, 1, 4, 5, 2});
  CHECK(by_own.read().texcoord.index == Ints{0, 1, 2, 3, 3, 2, 1, 0});
  CHECK(by_own.mesh.texcoord.at(5)[1] == 0.75f);
}

TEST_CASE("IndexedFaceSet: dropped faces keep their turn in the attributes", "[geometry]") {
  const std::string color = "color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0 1 1, 1 0 1 ] } ";
  const std::string list = "0 3 -1 0 3 4 1 -1 0 77 1 -1 1 4 5 2 -1";
  auto index = [&](const std::string& rest) {
    Fixture f(grid(color + rest, list));
    return f.read().color.index;
  };
  CHECK(index("colorPerVertex FALSE") == Ints{1, 1, 1, 1, 3, 3, 3, 3});
  CHECK(index("colorPerVertex FALSE colorIndex [ 5 4 3 2 ]") == Ints{4, 4, 4, 4, 2, 2, 2, 2});
  CHECK(index("colorIndex [ 9 9 -1 5 4 3 2 -1 9 9 9 -1 0 1 2 3 -1 ]") == Ints{5, 4, 3, 2, 0, 1, 2, 3});
}

TEST_CASE("IndexedFaceSet: attribute lists that do not match coordIndex", "[geometry]") {
  const std::string color = "color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0 1 1, 1 0 1 ] } ";
  struct Case {
    std::string rest;
    Ints index;
    int n_short;
  };
  auto c = GENERATE_COPY(values<Case>({
      {color + "colorIndex [ 5 4 3 -1 0 1 2 3 -1 ]", {5, 4, 3, 3, 0, 1, 2, 3}, 1},        // a face is short
      {color + "colorIndex [ 5 4 3 2 1 1 -1 0 1 2 3 -1 ]", {5, 4, 3, 2, 0, 1, 2, 3}, 0},  // a face is long
      {color + "colorIndex [ 5 4 3 2 -1 ]", {5, 4, 3, 2, 2, 2, 2, 2}, 1},                 // the second is missing
      {color + "colorIndex [ 5 4 3 2 0 1 2 3 ]", {5, 4, 3, 2, 0, 1, 2, 3}, 0},            // no -1 at all
      {color + "colorIndex [ 5 4 3 2 -1 0 1 2 99 -1 ]", {5, 4, 3, 2, 0, 1, 2, 5}, 1},     // beyond the values
      {color + "colorIndex [ 5 4 3 2 -1 0 1 2 -7 -1 ]", {5, 4, 3, 2, 0, 1, 2, 0}, 1},
      {color + "colorIndex [ 5 4 3 2 -1 0 1 2 3 -1 1 1 1 1 -1 ]", {5, 4, 3, 2, 0, 1, 2, 3}, 0},
      {color + "colorPerVertex FALSE colorIndex [ 4 ]", {4, 4, 4, 4, 4, 4, 4, 4}, 1},
      {"color Color { color [ 1 0 0, 0 1 0 ] }", {0, 1, 1, 1, 1, 1, 1, 1}, 1},
      {"color Color { color 1 0 0 } colorPerVertex FALSE", {0, 0, 0, 0, 0, 0, 0, 0}, 1},
      {"color Color { color [ ] }", {}, 0},
  }));
  Fixture f(grid(c.rest));
  INFO(c.rest);
  auto before = f.diag.count(Diag::short_attribute);
  CHECK(f.read().color.index == c.index);
  CHECK(int(f.diag.count(Diag::short_attribute) - before) == c.n_short);
  CHECK(sound(f.mesh));
}

TEST_CASE("IndexedFaceSet: short attributes say what is missing", "[geometry]") {
  Fixture f(grid("normal Normal { vector [ 0 0 1, 0 0 1 ] } normalIndex [ 0 1 2 -1 0 ]"));
  f.read();
  CHECK(f.message(0) == "IndexedFaceSet: fewer normal values than the geometry needs; the last one is repeated");
  CHECK(f.message(1) == "IndexedFaceSet: fewer normalIndex entries than coordIndex needs; the last one is repeated");
}

TEST_CASE("IndexedFaceSet: numbers that are none become 0", "[geometry]") {
  Fixture f(grid("color Color { color [ 1 0 0 ] } colorPerVertex FALSE colorIndex [ 0 0 ]"));
  auto nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  NodeId coord = f.scene.get(f.root(), nodes::indexed_face_set::coord),
         color = f.scene.get(f.root(), nodes::indexed_face_set::color);
  f.scene.set(coord, nodes::coordinate::point,
              std::vector<double>{nan, 1, 0, 1, 1, 0, 2, 1, 0, 0, 0, -inf, 1, 0, 0, 2, 0, 0});
  f.scene.set(color, nodes::color::color, std::vector<double>{0.25, 0.5, 1e300});
  auto& m = f.read();
  CHECK(m.corners == Ints{0, 3, 4, 1, 1, 4, 5, 2});
  CHECK(position(m, 0) == Vec3{0, 1, 0});
  CHECK(position(m, 1) == Vec3{0, 0, 0});
  CHECK(m.color.values == std::vector<float>{0.25f, 0.5f, 0});
  CHECK(f.message(0) == "IndexedFaceSet: 1 number is not finite; 0 is used");
  CHECK(f.message(1) == "IndexedFaceSet: 2 numbers are not finite; 0 is used");
  CHECK(std::isnan(f.scene.get(coord, nodes::coordinate::point)[0]));  // the scene is not touched
}

TEST_CASE("IndexedFaceSet: numbers that are not finite do not matter where no corner is", "[geometry]") {
  Fixture f(grid("", "1 4 5"));
  NodeId coord = f.scene.get(f.root(), nodes::indexed_face_set::coord);
  f.scene.set(coord, nodes::coordinate::point,
              std::vector<double>{NAN, 1, 0, 1, 1, 0, 2, 1, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0});
  CHECK(f.read().corners == Ints{1, 4, 5});
  CHECK(f.diag.messages().empty());
}

TEST_CASE("One face of a huge Coordinate costs one face", "[geometry]") {
  // A million points, colours and normals, used by 30,000 Shapes of one face: 10^11 steps if each looked at all.
  Fixture f;
  const std::size_t n = 1'000'000;
  std::vector<double> points(3 * n);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = double(i % 1000) / 1000;
  points[3 * 500] = NAN;
  NodeId coord = f.scene.add(nodes::Coordinate), color = f.scene.add(nodes::Color), normal = f.scene.add(nodes::Normal);
  f.scene.set(coord, nodes::coordinate::point, points);
  f.scene.set(normal, nodes::normal::vector, points);
  f.scene.set(color, nodes::color::color, points);
  namespace ifs = nodes::indexed_face_set;
  NodeId face = f.scene.add(nodes::IndexedFaceSet);
  f.scene.set(face, ifs::coord, coord);
  f.scene.set(face, ifs::color, color);
  f.scene.set(face, ifs::normal, normal);
  std::size_t n_corners = 0;
  for (std::int32_t i = 0; i < 30'000; ++i) {
    f.scene.set(face, ifs::coordIndex, std::vector<std::int32_t>{i % 2 ? 500 : i, i + 1000, i + 900'000, -1});
    n_corners += f.read(face).corners.size();
    auto j = f.job(face);
    TessellateOptions options{.triangles = false, .texcoords = true};
    tessellate(j, options);
  }
  CHECK(n_corners == 90'000);
  CHECK(f.mesh.color.index == Ints{0, 1, 2});
  CHECK(f.mesh.color.values.size() == 9);
  CHECK(f.mesh.texcoord.values.size() == 6);
  CHECK(f.diag.count(Diag::not_finite) >= 15'000);
}

TEST_CASE("IndexedLineSet: polylines and their colours", "[geometry]") {
  auto text = [](const std::string& rest) {
    return "IndexedLineSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 -1 3 -1 2 3 "
           "-1 ] "
           "color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 1 ] } " +
           rest + " }";
  };
  auto index = [&](const std::string& rest) {
    Fixture f(text(rest));
    auto& m = f.read();
    CHECK(m.kind == Mesh::Kind::lines);
    CHECK(m.corners == Ints{0, 1, 2, 2, 3});
    CHECK(m.face_begin == Ints{0, 3, 5});
    CHECK(f.message() == "IndexedLineSet: 1 polyline of fewer than two points is dropped");
    return m.color.index;
  };
  CHECK(index("") == Ints{0, 1, 2, 2, 3});
  CHECK(index("colorIndex [ 3 2 1 -1 0 -1 1 0 -1 ]") == Ints{3, 2, 1, 1, 0});
  CHECK(index("colorPerVertex FALSE") == Ints{0, 0, 0, 2, 2});
  CHECK(index("colorPerVertex FALSE colorIndex [ 3 0 1 ]") == Ints{3, 3, 3, 1, 1});
}

TEST_CASE("IndexedLineSet: segments need no face_begin", "[geometry]") {
  Fixture f("IndexedLineSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0 ] } coordIndex [ 0 1 -1 1 2 ] }");
  CHECK(f.read().corners == Ints{0, 1, 1, 2});
  CHECK(f.mesh.face_begin.empty());
  CHECK(f.mesh.n_faces() == 2);
}

TEST_CASE("PointSet: a colour for each point", "[geometry]") {
  Fixture f(
      "PointSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0 ] } color Color { color [ 1 0 0, 0 1 0, 0 0 1 ] } } "
      "PointSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0 ] } color Color { color [ 1 0 0 ] } } PointSet { }");
  CHECK(f.read().kind == Mesh::Kind::points);
  CHECK(f.mesh.corners == Ints{0, 1, 2});
  CHECK(f.mesh.color.index == Ints{0, 1, 2});
  CHECK(f.read(f.root(1)).color.index == Ints{0, 0, 0});
  CHECK(f.diag.count(Diag::short_attribute) == 1);
  CHECK(f.read(f.root(2)).n_faces() == 0);
}

TEST_CASE("read_mesh leaves other nodes to tessellate", "[geometry]") {
  Fixture f("Box { } Transform { }");
  CHECK(f.read().kind == Mesh::Kind::none);
  auto j = f.job(f.root(1));
  CHECK(tessellate(j, {}) == Outcome::unchanged);
  CHECK(f.mesh.kind == Mesh::Kind::none);
}

TEST_CASE("default_texcoords: longest side S, second T, ties in the order of axes", "[geometry]") {
  struct Case {
    std::string points;
    std::vector<float> values;
  };
  auto c = GENERATE(values<Case>({
      {"0 0 0, 4 0 0, 4 2 0", {0, 0, 1, 0, 1, 0.5}},    // X, Y
      {"0 0 0, 0 4 0, 0 4 8", {0, 0, 0, 0.5, 1, 0.5}},  // Z, Y
      {"1 1 1, 3 1 1, 3 3 3", {0, 0, 1, 0, 1, 1}},      // all equal: X, Y
      {"1 1 1, 1 2 1, 1 2 2", {0, 0, 1, 0, 1, 1}},      // Y = Z > X: Y, Z
      {"5 5 5, 5 5 5, 5 5 5", {0, 0, 0, 0, 0, 0}},
  }));
  Fixture f("IndexedFaceSet { coord Coordinate { point [ " + c.points + " ] } coordIndex [ 0 1 2 ] }");
  CHECK_FALSE(f.faces().texcoord.present());
  CHECK(f.faces({.texcoords = true}).texcoord.values == c.values);
  CHECK(f.mesh.texcoord.index == Ints{0, 1, 2});
}

TEST_CASE("default_texcoords: only points in use count, and given ones stay", "[geometry]") {
  Fixture f(grid("", "0 3 4 -1") +
            grid("texCoord TextureCoordinate { point [ 0 0, 9 9 ] } texCoordIndex [ 0 0 0 1 -1 1 0 0 0 ]"));
  f.faces({.texcoords = true});
  CHECK(f.mesh.texcoord.values == std::vector<float>{0, 1, 0, 0, 1, 0});  // width 1, not 2
  Mesh& m = f.read(f.root(1));
  default_texcoords(m);
  CHECK(m.texcoord.values == std::vector<float>{0, 0, 9, 9});
}

TEST_CASE("default_texcoords: only for geometry that has a texture", "[geometry]") {
  Fixture f(grid(""));
  auto j = f.job(f.root(), false);
  tessellate(j, {.triangles = false, .texcoords = true});
  CHECK_FALSE(f.mesh.texcoord.present());
}
