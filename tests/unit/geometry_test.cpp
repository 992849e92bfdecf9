// Geometry nodes as meshes: read_mesh, store_mesh, tessellate. References are analytic or by the clauses of the
// standard.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include "parsers/vrml/parser.h"
#include "passes/geometry.h"
#include "passes/shapes/spine.h"
#include "passes/tessellate.h"
#include "scenegraph/nodes.h"

using namespace wrlkit;

namespace {

constexpr double pi = std::numbers::pi;
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

Vec3 position(const Mesh& m, std::size_t corner) {
  const double* p = m.positions.data() + 3 * std::size_t{m.corners[corner]};
  return {p[0], p[1], p[2]};
}
Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vec3& a) { return std::sqrt(dot(a, a)); }

// Newell's: half the sum of cross products; its length is the area of a planar polygon, concave or not.
Vec3 area_vector(const Mesh& m, std::size_t face) {
  Vec3 sum{};
  const auto first = m.begin_of(face);
  for (auto c = first + 1; c + 1 < m.end_of(face); ++c) {
    auto n = cross(minus(position(m, c), position(m, first)), minus(position(m, c + 1), position(m, first)));
    for (int k = 0; k < 3; ++k) sum[k] += n[k] / 2;
  }
  return sum;
}

double area(const Mesh& m) {
  double sum = 0;
  for (std::size_t f = 0; f < m.n_faces(); ++f) sum += length(area_vector(m, f));
  return sum;
}

// Of planar faces; positive when they are counterclockwise seen from outside.
double volume(const Mesh& m) {
  double sum = 0;
  for (std::size_t f = 0; f < m.n_faces(); ++f) sum += dot(position(m, m.begin_of(f)), area_vector(m, f)) / 3;
  return sum;
}

struct Bounds {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
};
Bounds bounds(const Mesh& m) {
  Bounds b;
  for (std::size_t c = 0; c < m.corners.size(); ++c)
    for (int k = 0; k < 3; ++k) {
      b.low[k] = std::min(b.low[k], position(m, c)[k]);
      b.high[k] = std::max(b.high[k], position(m, c)[k]);
    }
  return b;
}

// Vertices - edges + faces of a closed oriented surface; -1000 where an edge is not met once from each side.
int euler(const Mesh& m) {
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

Vec3 normal_at(const Mesh& m, std::size_t corner) {
  const float* n = m.normal.at(m.normal.index[corner]);
  return {n[0], n[1], n[2]};
}

// The texture coordinate of the corner nearest to a point, on a face whose normal is nearest to a direction.
std::array<double, 2> texcoord_at(const Mesh& m, const Vec3& point, const Vec3& direction) {
  std::array<double, 2> found{-1, -1};
  double best = 1e300;
  for (std::size_t f = 0; f < m.n_faces(); ++f) {
    auto n = area_vector(m, f);
    double off = 1 - dot(n, direction) / length(n) / length(direction);
    for (auto c = m.begin_of(f); c < m.end_of(f); ++c)
      if (double d = length(minus(position(m, c), point)) + off; d < best) {
        best = d;
        const float* t = m.texcoord.at(m.texcoord.index[c]);
        found = {t[0], t[1]};
      }
  }
  return found;
}
bool near(const std::array<double, 2>& a, double s, double t) { return std::abs(a[0] - s) + std::abs(a[1] - t) < 1e-6; }

// Whether the picture is seen the right way round from the side that the face turns to.
bool texture_mirrored(const Mesh& m) {
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
bool normals_fit(const Mesh& m) {
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
bool sound(const Mesh& m) {
  auto good = [&](const Attribute& a) {
    return !a.present() ||
           (a.index.size() == m.corners.size() && std::ranges::all_of(a.index, [&](auto i) { return i < a.count(); }));
  };
  return std::ranges::all_of(m.corners, [&](auto p) { return p < m.n_positions(); }) && good(m.color) &&
         good(m.normal) && good(m.texcoord) && (m.face_begin.empty() || m.face_begin.back() == m.corners.size());
}

bool same(const Attribute& a, const Attribute& b) { return a.values == b.values && a.index == b.index; }
bool same(const Mesh& a, const Mesh& b) {
  auto equal = [](double x, double y) {
    return x == y || (std::isnan(x) && std::isnan(y));
  };  // points not in use may be anything
  return a.kind == b.kind && std::ranges::equal(a.positions.span(), b.positions.span(), equal) &&
         a.corners == b.corners && a.face_begin == b.face_begin && same(a.color, b.color) && same(a.normal, b.normal) &&
         same(a.texcoord, b.texcoord) && a.ccw == b.ccw && a.solid == b.solid && a.convex == b.convex &&
         a.crease_angle == b.crease_angle;
}

// Two quadrilaterals side by side: positions 0 1 2 / 3 4 5, faces 0 3 4 1 and 1 4 5 2.
std::string grid(const std::string& rest, const std::string& coordIndex = "0 3 4 1 -1 1 4 5 2 -1") {
  return "IndexedFaceSet { coord Coordinate { point [ 0 1 0, 1 1 0, 2 1 0, 0 0 0, 1 0 0, 2 0 0 ] } coordIndex [ " +
         coordIndex + " ] " + rest + " }";
}

}  // namespace

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
  CHECK(f.message(0) == "IndexedFaceSet: 3 of 26 indices point at nothing; their faces are dropped");
  CHECK(f.message(1) == "IndexedFaceSet: 2 faces without area are dropped");
}

TEST_CASE("IndexedFaceSet: nothing to read", "[geometry]") {
  Fixture f(
      "IndexedFaceSet { } IndexedFaceSet { coordIndex [ 0 1 2 -1 ] } DEF Name IndexedFaceSet { coord Color { } "
      "coordIndex [ 0 1 2 ] } "
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
  CHECK(f.message(0) == "IndexedFaceSet: 1 numbers are not finite; 0 is taken");
  CHECK(f.message(1) == "IndexedFaceSet: 2 numbers are not finite; 0 is taken");
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
    CHECK(f.message() == "IndexedLineSet: 1 polylines of fewer than two points are dropped");
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

TEST_CASE("store_mesh: what was read is read again", "[geometry]") {
  const std::string color = "color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0.1 0.2 0.3, 1 0 1 ] } ";
  auto text = GENERATE_COPY(
      grid(""), grid("", "0 3 1 -1 1 3 4 -1"), grid("ccw FALSE solid FALSE convex FALSE creaseAngle 0.5"), grid(color),
      grid(color + "colorPerVertex FALSE"), grid(color + "colorPerVertex FALSE colorIndex [ 4 2 ]"),
      grid(color + "colorIndex [ 5 4 3 2 -1 0 1 2 3 -1 ]"),
      grid("normal Normal { vector [ 0 0.6 0.8, 0.1 0 1 ] } normalPerVertex FALSE"),
      grid("texCoord TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] } texCoordIndex [ 0 0 0 0 -1 3 2 1 0 -1 ]"),
      std::string("IndexedFaceSet { }"),
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
  // The spine stands still, the orientation turns a section beside the axis: a torus (6.18.3).
  std::string spine, orientation;
  for (int i = 0; i <= 12; ++i)
    spine += "0 0 0, ", orientation += "1 0 0 " + std::to_string(2 * pi * (i % 12) / 12) + ", ";
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

namespace {

using Points = std::vector<Vec3>;
bool close(const Vec3& a, const Vec3& b) { return length(minus(a, b)) < 1e-9; }

}  // namespace

TEST_CASE("Spine: straight ones turn Y into their direction", "[geometry]") {
  auto up = spine_planes(Points{{0, 0, 0}, {0, 1, 0}, {0, 3, 0}});
  for (auto& p : up) CHECK((close(p.x, {1, 0, 0}) && close(p.y, {0, 1, 0}) && close(p.z, {0, 0, 1})));
  auto right = spine_planes(Points{{0, 0, 0}, {1, 0, 0}});
  CHECK((close(right[1].x, {0, -1, 0}) && close(right[1].y, {1, 0, 0}) && close(right[1].z, {0, 0, 1})));
  auto down = spine_planes(Points{{0, 0, 0}, {0, -1, 0}});
  CHECK((close(down[0].x, {-1, 0, 0}) && close(down[0].y, {0, -1, 0}) && close(down[0].z, {0, 0, 1})));
  auto front = spine_planes(Points{{0, 0, 0}, {0, 0, 2}, {0, 0, 2}});
  CHECK((close(front[2].x, {1, 0, 0}) && close(front[2].y, {0, 0, 1}) && close(front[2].z, {0, -1, 0})));
}

TEST_CASE("Spine: six printed digits of a slanted line are straight", "[geometry]") {
  auto planes = spine_planes(Points{
      {0.123457, 0.234568, 0.345679}, {1.12346, 1.23457, 1.34568}, {2.12346, 2.23457, 2.34568}, {5, 5.11111, 5.22222}});
  for (auto& p : planes) CHECK(length(minus(p.x, planes[0].x)) < 1e-4);
  CHECK(dot(planes[0].y, Vec3{1, 1, 1}) == Approx(std::sqrt(3)));
}

TEST_CASE("Spine: bends, straight parts and flips", "[geometry]") {
  // up, to the right, up again: the second bend turns the other way, its Z axis is flipped (g)
  auto p = spine_planes(Points{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}});
  for (auto& plane : p) CHECK(close(plane.z, {0, 0, -1}));
  CHECK(close(p[0].y, {0, 1, 0}));
  CHECK(close(p[0].x, {-1, 0, 0}));
  CHECK(close(p[1].y, {std::sqrt(0.5), std::sqrt(0.5), 0}));
  CHECK(close(p[2].y, {1, 0, 0}));  // collinear: the Z axis of the point before
  CHECK(close(p[4].y, {0, 1, 0}));
}

TEST_CASE("Spine: leading straight parts take the first Z axis there is", "[geometry]") {
  auto p = spine_planes(Points{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 1}});
  for (auto& plane : p) CHECK(close(plane.z, {1, 0, 0}));
}

TEST_CASE("Spine: coincident points have one plane", "[geometry]") {
  auto p = spine_planes(Points{{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 1, 0}});
  CHECK(close(p[1].y, {std::sqrt(0.5), std::sqrt(0.5), 0}));
  CHECK(close(p[1].y, p[2].y));
  CHECK(close(p[1].x, p[2].x));
  auto still = spine_planes(Points(3, Vec3{7, 8, 9}));
  CHECK(still.size() == 3);
  CHECK((close(still[2].x, {1, 0, 0}) && close(still[2].y, {0, 1, 0})));
  CHECK(spine_planes({}).empty());
}

TEST_CASE("Spine: closed ones have the same plane at both ends", "[geometry]") {
  auto p = spine_planes(Points{{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}, {1, 0, 0}});
  CHECK(close(p[0].y, {0, 0, 1}));  // from the point before the seam to the one behind it
  CHECK(close(p[0].z, p[4].z));
  CHECK(std::abs(p[0].z[1]) == Approx(1));
  CHECK(close(p[0].x, p[4].x));
  for (auto& plane : p) CHECK(close(plane.x, cross(plane.y, plane.z)));
}

TEST_CASE("Spine: hairpins and noise stay orthonormal", "[geometry]") {
  auto points = GENERATE(Points{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, Points{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}},
                         Points{{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 0}, {0, 5, 0}, {1e-20, 0, 0}},
                         Points{{1e6, 0, 0}, {1e6, 1, 0}, {1e6, 2, 1e-9}, {1e6, 3, 0}, {1e6, 3, 1e-9}});
  for (auto& plane : spine_planes(points)) {
    CHECK(length(plane.x) == Approx(1));
    CHECK(length(plane.y) == Approx(1));
    CHECK(close(plane.z, cross(plane.x, plane.y)));
    CHECK(dot(plane.x, plane.y) == Approx(0).margin(1e-9));
  }
}
