// store_mesh: what a pass has made of a mesh becomes nodes that read the same.
#include <catch2/catch.hpp>
#include <random>

#include "tests/unit/geometry_fixture.h"

using namespace wrlkit;
using namespace wrlkit::geometry_tests;

TEST_CASE("store_mesh: what was read is read again", "[geometry]") {
  const std::string color = "color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0.1 0.2 0.3, 1 0 1 ] } ";
  auto text = GENERATE_COPY(
      grid(""), grid("", "0 3 1 -1 1 3 4 -1"), grid("ccw FALSE solid FALSE convex FALSE creaseAngle 0.5"), grid(color),
      grid(color + "colorPerVertex FALSE"), grid(color + "colorPerVertex FALSE colorIndex [ 4 2 ]"),
      grid(color + "colorIndex [ 5 4 3 2 -1 0 1 2 3 -1 ]"),
      grid("normal Normal { vector [ 0 0.6 0.8, 0.1 0 1 ] } normalPerVertex FALSE"),
      grid("texCoord TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] } texCoordIndex [ 0 0 0 0 -1 3 2 1 0 -1 ]"),
      std::string("IndexedFaceSet { solid TRUE }"),
      std::string(
          "IndexedLineSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 -1 2 3 -1 ] "
          "color Color { color [ 1 0 0, 0 1 0 ] } colorPerVertex FALSE }"),
      std::string("PointSet { coord Coordinate { point [ 0 0 0, 1 0 0 ] } color Color { color [ 1 0 0, 0 1 0 ] } }"));
  INFO(text);
  Fixture f(text);
  const auto n_nodes = f.scene.node_count();
  const Mesh before = f.read();
  store_mesh(f.scene, f.root(), before);
  CHECK(same(f.read(), before));
  CHECK(f.scene.node_count() == n_nodes);  // Coordinate, Color, Normal are those of the file
  CHECK(f.diag.messages().empty());
}

TEST_CASE("store_mesh: shapes become IndexedFaceSets that read the same", "[geometry]") {
  auto text =
      GENERATE("Box { }", "Cone { }", "Cylinder { }", "Sphere { radius 0.3 }", "Extrusion { creaseAngle 2 ccw FALSE }",
               "ElevationGrid { xDimension 2 zDimension 3 height [ 0 1 2 3 4 5 ] solid FALSE }", "Sphere { radius 0 }");
  INFO(text);
  Fixture f(text);
  const NodeId n = f.root();
  f.scene.set_name(n, "Shape_1");
  Mesh before = f.faces();
  store_mesh(f.scene, n, before);
  CHECK(f.scene.is(n, nodes::IndexedFaceSet));
  CHECK(f.scene.name(n) == "Shape_1");
  auto warnings = f.diag.messages().size();
  f.read(n);
  before.face_begin = before.corners.empty() ? Ints{} : before.face_begin;
  f.mesh.face_begin = f.mesh.corners.empty() ? Ints{} : f.mesh.face_begin;
  CHECK(same(f.mesh, before));
  CHECK(f.diag.messages().size() == warnings);
}

TEST_CASE("store_mesh: bindings are as short as they can be", "[geometry]") {
  namespace ifs = nodes::indexed_face_set;
  const std::string color = "color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0 1 1, 1 0 1 ] } ";
  Fixture f(grid(color + "colorIndex [ 0 3 4 1 -1 1 4 5 2 -1 ]") +
            grid(color + "colorIndex [ 0 0 0 0 -1 1 1 1 1 -1 ]") +
            grid(color + "colorIndex [ 3 3 3 3 -1 1 1 1 1 -1 ]"));
  for (std::size_t i = 0; i < 3; ++i) {
    const Mesh m = f.read(f.root(i));
    store_mesh(f.scene, f.root(i), m);
    CHECK(same(f.read(f.root(i)), m));
  }
  auto index = [&](std::size_t i) { return f.scene.get(f.root(i), ifs::colorIndex); };
  CHECK((index(0).empty() && f.scene.get(f.root(0), ifs::colorPerVertex)));
  CHECK((index(1).empty() && !f.scene.get(f.root(1), ifs::colorPerVertex)));
  CHECK((index(2).size() == 2 && index(2)[0] == 3 && !f.scene.get(f.root(2), ifs::colorPerVertex)));
}

TEST_CASE("store_mesh: changed values go into new nodes, indices into old ones", "[geometry]") {
  namespace ifs = nodes::indexed_face_set;
  Fixture f(grid("color DEF C Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0 1 1, 1 0 1 ] }"));
  const NodeId coord = f.scene.get(f.root(), ifs::coord), color = f.scene.get(f.root(), ifs::color);
  Mesh m = f.read();
  m.corners = m.color.index = {0, 3, 4, 0, 4, 1};
  m.face_begin.clear();
  store_mesh(f.scene, f.root(), m);
  CHECK(f.scene.get(f.root(), ifs::coord) == coord);
  CHECK(f.scene.get(f.root(), ifs::color) == color);

  m.positions.edit()[0] = -1;
  m.color.values[1] = 0.1f;
  store_mesh(f.scene, f.root(), m);
  CHECK(f.scene.get(f.root(), ifs::coord) != coord);
  CHECK(f.scene.get(f.root(), ifs::color) != color);
  CHECK(f.scene.get(coord, nodes::coordinate::point)[0] == 0);
  CHECK(f.scene.get(color, nodes::color::color)[1] == 0);
  CHECK(f.scene.get(f.scene.get(f.root(), ifs::color), nodes::color::color)[1] == 0.1);  // the digits, not the bits
  CHECK(same(f.read(), m));
}

TEST_CASE("store_mesh: points out of order", "[geometry]") {
  Fixture f(
      "PointSet { coord Coordinate { point [ 0 0 0, 1 0 0, 2 0 0 ] } color Color { color [ 1 0 0, 0 1 0, 0 0 1 ] } }");
  Mesh m = f.read();
  m.corners = m.color.index = {2, 0};
  store_mesh(f.scene, f.root(), m);
  f.read();
  CHECK(f.mesh.corners == Ints{0, 1});
  CHECK(position(f.mesh, 0) == Vec3{2, 0, 0});
  CHECK(f.mesh.color.values == std::vector<float>{0, 0, 1, 1, 0, 0});
}

TEST_CASE("store_mesh: a mesh of nothing changes nothing", "[geometry]") {
  Fixture f("Box { size 1 2 3 }");
  store_mesh(f.scene, f.root(), Mesh{});
  CHECK(f.scene.is(f.root(), nodes::Box));
  CHECK(f.scene.get(f.root(), nodes::box::size) == Vec3{1, 2, 3});
}

TEST_CASE("Any lists of indices give a sound mesh that is read again", "[geometry]") {
  namespace ifs = nodes::indexed_face_set;
  std::mt19937 random(2);
  auto list = [&](std::size_t longest) {
    std::vector<std::int32_t> v(random() % longest);
    for (auto& i : v) i = static_cast<std::int32_t>(random() % 9) - 2 + (random() % 30 == 0 ? 1 << 30 : 0);
    return v;
  };
  auto numbers = [&](std::size_t n) {
    std::vector<double> v(n * (random() % 8));
    for (auto& d : v) d = random() % 50 == 0 ? NAN : double(random() % 100) / 10;
    return v;
  };
  for (int run = 0; run < 3000; ++run) {
    Fixture f(
        "IndexedFaceSet { coord Coordinate { } color Color { } normal Normal { } texCoord TextureCoordinate { } }");
    auto& s = f.scene;
    const NodeId n = f.root();
    s.set(s.get(n, ifs::coord), nodes::coordinate::point, numbers(3));
    s.set(s.get(n, ifs::color), nodes::color::color, numbers(3));
    s.set(s.get(n, ifs::normal), nodes::normal::vector, numbers(3));
    s.set(s.get(n, ifs::texCoord), nodes::texture_coordinate::point, numbers(2));
    for (auto key : {ifs::coordIndex, ifs::colorIndex, ifs::normalIndex, ifs::texCoordIndex}) s.set(n, key, list(40));
    s.set(n, ifs::colorPerVertex, random() % 2 == 0);
    s.set(n, ifs::normalPerVertex, random() % 2 == 0);
    const Mesh m = f.read();
    REQUIRE(sound(m));
    REQUIRE(std::ranges::all_of(m.corners, [&](auto p) {
      return std::isfinite(m.positions[3 * p] + m.positions[3 * p + 1] + m.positions[3 * p + 2]);
    }));
    store_mesh(s, n, m);
    const auto warnings = f.diag.messages().size();
    if (m.corners.empty()) continue;
    REQUIRE(same(f.read(), m));
    REQUIRE(f.diag.messages().size() == warnings);
  }
}
