// The pass `lightmap` from world to picture: closed formulas, leaks, seams, both sides, and the same bytes on any
// number of threads.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "base/image/srgb.h"
#include "base/parallel.h"
#include "geometry/geometry.h"
#include "light/render/linear.h"
#include "parsers/parsers.h"
#include "parsers/resources.h"
#include "passes/lightmap/lightmap.h"
#include "passes/pipeline/pipeline.h"
#include "passes/triangulate/triangulate.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

using namespace wrlkit;

namespace {

/// A world that was baked.
struct Baked {
  Diagnostics diag;
  Statistics stats;
  FileResources resources{{.input = "test.wrl"}, [](const std::string&, Diagnostics&) { return nullptr; }};
  PassContext ctx{diag, stats, &resources};
  std::unique_ptr<World> world;

  Baked(const std::string& body, const std::string& options, const std::string& head = "#VRML V2.0 utf8\n")
      : world(parse_world(head + body, "test.wrl", {}, diag)) {
    REQUIRE(world);
    std::string why;
    auto p = Pipeline::parse("lightmap{" + options + "}", why);
    INFO(why);
    REQUIRE(p);
    REQUIRE(p->run(world->scene, ctx));
  }

  NodeId shape(std::string_view name) const {
    for (NodeId n : all_nodes(world->scene))
      if (world->scene.name(n) == name) return n;
    FAIL("there is no " << name);
    return {};
  }
};

/// The lightmap of one Shape.
class Light {
 public:
  Light(Baked& b, std::string_view name) {
    const Scene& scene = b.world->scene;
    const NodeId shape = b.shape(name), appearance = scene.get(shape, nodes::shape::appearance),
                 map = scene.get(appearance, nodes::appearance::lightmap);
    REQUIRE(map);
    if (const NodeId t = scene.get(appearance, nodes::appearance::lightmapTransform)) read_transform(scene, t);
    picture_ = b.resources.image(scene.get(map, nodes::image_texture::url), scene.where(map), b.diag);
    REQUIRE(picture_);
    scale_ = scene.get(appearance, nodes::appearance::lightmapScale);
    MeshScratch scratch;
    MeshJob job{scene, scene.get(shape, nodes::shape::geometry), mesh, scratch, b.ctx};
    read_mesh(job);
    triangulate(job, {});
    REQUIRE(mesh.lightcoord.present());
  }

  /// What a bilinear filter shows there: irradiance / pi, green.
  double at(double s, double t) const {
    const double x = s * picture_->width - 0.5, y = (1 - t) * picture_->height - 0.5;
    const int u = static_cast<int>(std::floor(x)), v = static_cast<int>(std::floor(y));
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
      const double w = (k & 1 ? x - u : 1 - (x - u)) * (k >> 1 ? y - v : 1 - (y - v));
      sum += w * srgb_to_linear(texel(u + (k & 1), v + (k >> 1)) / 255.0);
    }
    return scale_ * sum;
  }
  /// At weights of the corners of a triangle.
  double at(std::size_t triangle, double a, double b) const {
    const double w[] = {a, b, 1 - a - b};
    double s = 0, t = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const float* c = mesh.lightcoord.at(mesh.lightcoord.index[3 * triangle + k]);
      s += w[k] * c[0];
      t += w[k] * c[1];
    }
    return at(a_ * s + b_ * t + c_, d_ * s + e_ * t + f_);
  }
  /// At a place of the local frame that lies in a triangle of the plane y = 0.
  double on_floor(double x, double z) const {
    for (std::size_t i = 0; i < mesh.corners.size() / 3; ++i) {
      double p[3][2];
      for (std::size_t k = 0; k < 3; ++k) {
        p[k][0] = mesh.positions[3 * mesh.corners[3 * i + k]];
        p[k][1] = mesh.positions[3 * mesh.corners[3 * i + k] + 2];
      }
      auto area = [](double ax, double ay, double bx, double by, double cx, double cy) {
        return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
      };
      const double all = area(p[0][0], p[0][1], p[1][0], p[1][1], p[2][0], p[2][1]);
      const double a = area(x, z, p[1][0], p[1][1], p[2][0], p[2][1]) / all,
                   b = area(p[0][0], p[0][1], x, z, p[2][0], p[2][1]) / all;
      if (a >= -1e-9 && b >= -1e-9 && a + b <= 1 + 1e-9) return at(i, a, b);
    }
    FAIL("no triangle there");
    return 0;
  }

  /// How far two corners are from one another on the page.
  double texels(std::size_t corner, std::size_t other) const {
    const float *p = mesh.lightcoord.at(mesh.lightcoord.index[corner]),
                *q = mesh.lightcoord.at(mesh.lightcoord.index[other]);
    const double s = double{p[0]} - q[0], t = double{p[1]} - q[1];
    return std::hypot((a_ * s + b_ * t) * picture_->width, (d_ * s + e_ * t) * picture_->height);
  }

  Mesh mesh;

 private:
  /// ISO/IEC 14772-1, 6.49, without a center.
  void read_transform(const Scene& scene, NodeId n) {
    namespace f = nodes::texture_transform;
    const auto scale = scene.get(n, f::scale), shift = scene.get(n, f::translation);
    const double c = std::cos(scene.get(n, f::rotation)), s = std::sin(scene.get(n, f::rotation));
    a_ = scale[0] * c;
    b_ = -scale[0] * s;
    d_ = scale[1] * s;
    e_ = scale[1] * c;
    c_ = a_ * shift[0] + b_ * shift[1];
    f_ = d_ * shift[0] + e_ * shift[1];
  }
  int texel(int x, int y) const {
    x = std::clamp(x, 0, picture_->width - 1);
    y = std::clamp(y, 0, picture_->height - 1);
    return picture_->pixels[(std::size_t(y) * picture_->width + x) * picture_->channels + 1];
  }

  std::shared_ptr<const Image> picture_;
  double scale_ = 1, a_ = 1, b_ = 0, c_ = 0, d_ = 0, e_ = 1, f_ = 0;  // the last six: lightmapTransform
};

/// A box of 2 m; its faces look inward or outward.
std::string box(bool inward, double half) {
  const auto h = std::to_string(half);
  std::string points;
  for (int i = 0; i < 8; ++i)
    points += std::string(i & 1 ? "" : "-") + h + (i & 2 ? " " : " -") + h + (i & 4 ? " " : " -") + h + ", ";
  std::string faces = "0 2 3 1 -1 4 5 7 6 -1 0 1 5 4 -1 2 6 7 3 -1 0 4 6 2 -1 1 3 7 5 -1";
  return "IndexedFaceSet { ccw " + std::string(inward ? "FALSE" : "TRUE") + " coord Coordinate { point [ " + points +
         " ] } coordIndex [ " + faces + " ] }";
}

std::string material(double diffuse, double emissive = 0) {
  auto c = [](double linear) {
    auto v = std::to_string(linear_to_srgb(linear));
    return v + " " + v + " " + v;
  };
  return "appearance Appearance { material Material { diffuseColor " + c(diffuse) + " emissiveColor " + c(emissive) +
         " } }";
}

drawing::V3 corner(const Mesh& m, std::size_t c) {
  const double* p = m.positions.data() + std::size_t{3} * m.corners[c];
  return {p[0], p[1], p[2]};
}

const std::string floor_of_4 =
    "IndexedFaceSet { coord Coordinate { point [ -2 0 -2, -2 0 2, 2 0 2, 2 0 -2 ] } coordIndex [ 0 1 2 3 -1 ] }";

}  // namespace

TEST_CASE("bake: the white furnace is as bright everywhere", "[bake]") {
  // Radiance L = emission + albedo L.
  Baked b("DEF Room Shape { " + material(0.5, 0.25) + " geometry " + box(true, 1) + " }", "quality=normal,max-size=64");
  Light room(b, "Room");
  for (std::size_t i = 0; i < room.mesh.corners.size() / 3; ++i)
    for (auto [u, v] : {std::pair{0.02, 0.02}, {0.96, 0.02}, {0.3, 0.3}, {0.02, 0.96}})
      CHECK(room.at(i, u, v) == Approx(0.5).epsilon(0.03));
}

TEST_CASE("bake: a lamp over a floor, by the inverse square", "[bake]") {
  Baked b("DEF Floor Shape { " + material(0.5) + " geometry " + floor_of_4 +
              " } PointLight { location 0 2 0 attenuation 0 0 1 }",
          "quality=draft,max-size=128");
  Light floor(b, "Floor");
  for (double r : {0.0, 0.5, 1.0, 1.5})
    CHECK(floor.on_floor(r, 0.01) == Approx(2 / std::pow(4 + r * r, 1.5)).epsilon(0.02));
}

TEST_CASE("bake: light lies where it does though a scale mirrors the surface", "[bake]") {
  Baked b("Transform { scale -1 1 1 children DEF Floor Shape { " + material(0.5) + " geometry " + floor_of_4 +
              " } } PointLight { location 1 2 0 attenuation 0 0 1 }",
          "quality=draft,max-size=128");
  Light floor(b, "Floor");
  for (double r : {0.0, 0.5, 1.0, 1.5})
    CHECK(floor.on_floor(-1 + r, 0.01) == Approx(2 / std::pow(4 + r * r, 1.5)).epsilon(0.02));
}

TEST_CASE("bake: no light comes into a closed room", "[bake]") {
  Baked b("DEF In Shape { " + material(0.8) + " geometry " + box(true, 1) + " } DEF Out Shape { " + material(0.8) +
              " geometry " + box(false, 1.1) + " }",
          "quality=draft,max-size=128,sky=1:1:1");
  Light in(b, "In"), out(b, "Out");
  for (std::size_t i = 0; i < in.mesh.corners.size() / 3; ++i)
    for (auto [u, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.3, 0.3}}) {
      CHECK(in.at(i, u, v) < 1e-3);
      CHECK(out.at(i, u, v) == Approx(1).epsilon(0.05));
    }
}

TEST_CASE("bake: both sides of a thin plate have light of their own", "[bake]") {
  Baked b("DEF Plate Shape { " + material(0.5) +
              " geometry IndexedFaceSet { solid FALSE coord Coordinate { point [ -2 0 -2, -2 0 2, 2 0 2, 2 0 -2 ] } "
              "coordIndex [ 0 1 2 3 -1 ] } } PointLight { location 0 2 0 attenuation 0 0 1 }",
          "quality=draft,max-size=128");
  Light plate(b, "Plate");
  REQUIRE(plate.mesh.corners.size() == 12);
  CHECK(plate.mesh.solid);
  CHECK(plate.at(std::size_t{0}, 0.3, 0.3) > 0.1);
  CHECK(plate.at(std::size_t{2}, 0.3, 0.3) == 0);
}

TEST_CASE("bake: the light of a smooth surface goes on across a cut", "[bake]") {
  Baked b("DEF Pipe Shape { " + material(0.5) +
              " geometry Cylinder { top FALSE bottom FALSE } } PointLight { location 2 1 2 attenuation 0 0 1 }",
          "quality=normal,max-size=128,sky=0.2:0.2:0.2");
  Light pipe(b, "Pipe");
  std::map<std::array<double, 3>, std::vector<double>> shown;
  for (std::size_t c = 0; c < pipe.mesh.corners.size(); ++c) {
    const double* p = pipe.mesh.positions.data() + 3 * std::size_t{pipe.mesh.corners[c]};
    const float* l = pipe.mesh.lightcoord.at(pipe.mesh.lightcoord.index[c]);
    shown[{p[0], p[1], p[2]}].push_back(pipe.at(l[0], l[1]));
  }
  std::size_t n_cut = 0;
  for (auto& [p, light] : shown) {
    auto [low, high] = std::ranges::minmax(light);
    n_cut += low != high;
    CHECK(high - low < 0.02);
  }
  CHECK(n_cut >= 1);
}

TEST_CASE(
    "bake: shared geometry has light of its own at each place, and the same bytes come from any number of threads",
    "[bake]") {
  const std::string world =
      "DEF A Shape { " + material(0.5) + " geometry DEF G " + floor_of_4 +
      " } Transform { translation 0 0 50 children USE A } PointLight { location 0 2 0 attenuation 0 0 1 }";
  std::vector<std::string> pictures;
  for (int threads : {1, 2}) {
    ThreadLimit limit(threads);
    Baked b(world, "quality=draft,max-size=128");
    const Scene& scene = b.world->scene;
    CHECK(scene.get(b.shape("A"), nodes::shape::geometry) == scene.get(b.shape("A_2"), nodes::shape::geometry));
    REQUIRE(b.resources.made().size() == 1);
    pictures.push_back(*b.resources.made()[0].bytes);
    // One place is bright and the other dark.
    auto place = [&](const char* name) {
      const NodeId a = scene.get(b.shape(name), nodes::shape::appearance);
      return scene.get(scene.get(a, nodes::appearance::lightmapTransform), nodes::texture_transform::translation);
    };
    CHECK(place("A") != place("A_2"));
  }
  CHECK(pictures[0] == pictures[1]);
}

TEST_CASE("bake: directions are the same bytes on any number of threads, in the dark, too", "[bake]") {
  // Behind the wall next to nothing arrives, and numbers near the smallest there are decide where from.
  const std::string world =
      "PointLight { location 0 3 5 } Transform { translation 4 -2 0 children Shape { appearance Appearance { material "
      "Material { transparency 0.5 "
      "diffuseColor 1 0.5 0 emissiveColor 0 0 0.3 } } geometry Sphere { radius 1.5 } } } Transform { translation 0 0 "
      "-3 children Shape { " +
      material(0.6) + " geometry Box { size 14 10 0.1 } } }";
  std::vector<std::vector<std::string>> pictures;
  for (int threads : {1, 2}) {
    ThreadLimit limit(threads);
    Baked b(world, "quality=draft,max-size=128,directional=true");
    REQUIRE(b.resources.made().size() == 4);
    auto& all = pictures.emplace_back();
    for (const auto& m : b.resources.made()) all.push_back(*m.bytes);
  }
  CHECK(pictures[0] == pictures[1]);
}

TEST_CASE("bake: under what is closed the floor takes the light around, though both sides of it were to be seen",
          "[bake]") {
  const std::string block = "Transform { translation 0 1 0 children DEF Block Shape { " + material(0.5) +
                            " geometry IndexedFaceSet { solid FALSE " + box(false, 1).substr(17) + " } }";
  Baked b("DEF Floor Shape { " + material(0.5) + " geometry " + floor_of_4 + " } " + block,
          "quality=draft,max-size=128,sky=1:1:1");
  Light floor(b, "Floor"), top(b, "Block");
  CHECK(top.mesh.corners.size() == 36);  // the inner side is not lit
  CHECK(floor.on_floor(0.01, 0.02) > 0.2);
  CHECK(b.stats["lightmap.inside"] > 500);
  CHECK(b.stats["lightmap.black"] == 0);
  CHECK(b.stats["lightmap.leaks"] == 0);
  CHECK(b.stats["lightmap.jumps"] == 0);
}

TEST_CASE("bake: the dark below a hood of single sheets makes no seam along its foot", "[bake]") {
  // Its walls meet the texels of the floor at a slant. Outside half of the sky is seen there.
  const std::string hood =
      "IndexedFaceSet { solid FALSE coord Coordinate { point [ -1 -1 -1, 1 -1 -1, 1 -1 1, -1 -1 1, 0 1 0 ] } "
      "coordIndex [ 0 1 4 -1 1 2 4 -1 2 3 4 -1 3 0 4 -1 ] }";
  const std::string world = "DEF Floor Shape { " + material(0.5) + " geometry " + floor_of_4 +
                            " } Transform { translation 0 1 0 rotation 0 1 0 0.4 children Shape { " + material(0.5) +
                            " geometry " + hood + " } }";
  for (const std::string quality : {"draft", "normal"}) {
    Baked b(world, "sky=1:1:1,max-size=128,denoise=false,quality=" + quality);
    Light floor(b, "Floor");
    double least = 1, most_within = 0;
    for (int k = 1; k < 100; ++k) {
      const double along = -1 + k / 50.0, c = std::cos(0.4), s = std::sin(0.4);
      auto at = [&](double x, double z) { return floor.on_floor(c * x + s * z, c * z - s * x); };
      for (double side : {-1.001, 1.001}) least = std::min({least, at(side, along), at(along, side)});
      for (double side : {-0.8, 0.8})
        most_within = std::max({most_within, at(side, 0.8 * along), at(0.8 * along, side)});
    }
    INFO(quality);
    CHECK(least > 0.25);
    CHECK(most_within < 0.01);
  }
}

TEST_CASE("bake: a closed room of which both sides are to be seen has light on both when somebody stands in it",
          "[bake]") {
  const std::string room = "DEF Room Shape { " + material(0.5, 0.1) + " geometry IndexedFaceSet { solid FALSE " +
                           box(true, 1).substr(17) + " } ";
  Baked nobody(room, "quality=draft,max-size=128"),
      viewer(room + "Viewpoint { position 0 0 0.5 }", "quality=draft,max-size=128"),
      lamp(room + "PointLight { location 0 0.5 0 }", "quality=draft,max-size=128");
  CHECK(Light(nobody, "Room").mesh.corners.size() == 36);
  CHECK(Light(viewer, "Room").mesh.corners.size() == 72);
  CHECK(Light(lamp, "Room").mesh.corners.size() == 72);
}

TEST_CASE(
    "bake: an error that is asked for costs rays, where they are needed, and the same bytes come from any number of "
    "threads") {
  const std::string body =
      "DEF Room Shape { " + material(0.5) + " geometry " + box(true, 1) + " } DEF Block Shape { " + material(0.5) +
      " geometry " + box(false, 0.3) +
      " } Transform { translation 0 0.95 0 rotation 1 0 0 3.14159265 scale 0.2 0.2 0.2 children Shape { " +
      material(0, 1) + " geometry " + floor_of_4 + " } }";
  auto rays = [&](const std::string& error) {
    return Baked(body, "quality=draft,max-size=64" + error).stats["lightmap.rays"];
  };
  const auto coarse = rays(",error=0.5"), fine = rays(",error=0.005");
  CHECK(coarse < 2 * rays(""));
  CHECK(fine > 3 * coarse);
  std::vector<std::string> pictures;
  for (int threads : {1, 2}) {
    ThreadLimit limit(threads);
    Baked b(body, "quality=draft,max-size=64,error=0.02");
    pictures.push_back(*b.resources.made()[0].bytes);
  }
  CHECK(pictures[0] == pictures[1]);
}

TEST_CASE("bake: a solid thing that is wound inside out has the light of its outside where viewers see it") {
  const std::string thing = "DEF Thing Shape { " + material(0.5) + " geometry " + box(true, 1) + " } ",
                    white = "quality=draft,max-size=128,sky=1:1:1";
  Baked b(thing, white);
  Light light(b, "Thing");
  REQUIRE(light.mesh.corners.size() == 36);
  for (std::size_t i = 0; i < 12; ++i) CHECK(light.at(i, 0.3, 0.4) == Approx(1).epsilon(0.02));
  CHECK(b.diag.count(Diag::inside_out) == 1);
  // It looks inward as before.
  CHECK(light.mesh.solid);
  double volume = 0;
  for (std::size_t c = 0; c < 36; c += 3)
    volume += dot(corner(light.mesh, c), cross(corner(light.mesh, c + 1), corner(light.mesh, c + 2)));
  CHECK(volume * (light.mesh.ccw ? 1 : -1) == Approx(-48));
  // One to stand in is a room, and dark.
  for (const char* within :
       {"Viewpoint { position 0 0 0.5 }",
        "Shape { appearance Appearance { material Material { } } geometry Sphere { radius 0.1 } }"}) {
    Baked room(thing + within, white);
    CHECK(Light(room, "Thing").at(0, 0.3, 0.4) == 0);
    CHECK(room.diag.count(Diag::inside_out) == 0);
  }
}

TEST_CASE("bake: of closed things in one geometry that are wound against one another each has light on its outside") {
  const std::string cube = "-1 -1 -1, 1 -1 -1, -1 1 -1, 1 1 -1, -1 -1 1, 1 -1 1, -1 1 1, 1 1 1, ",
                    other = "4 4 4, 5 4 4, 4 5 4, 5 5 4, 4 4 5, 5 4 5, 4 5 5, 5 5 5";
  const std::string outward = "0 2 3 1 -1 4 5 7 6 -1 0 1 5 4 -1 2 6 7 3 -1 0 4 6 2 -1 1 3 7 5 -1 ",
                    inward = "9 11 10 8 -1 14 15 13 12 -1 12 13 9 8 -1 11 15 14 10 -1 10 14 12 8 -1 13 15 11 9 -1";
  Baked b("DEF Two Shape { " + material(0.5) + " geometry IndexedFaceSet { solid FALSE coord Coordinate { point [ " +
              cube + other + " ] } coordIndex [ " + outward + inward + " ] } }",
          "quality=draft,max-size=128,sky=1:1:1");
  Light light(b, "Two");
  REQUIRE(light.mesh.corners.size() == 2 * 72);
  const auto& m = light.mesh;
  for (std::size_t i = 0; i < 48; ++i) {
    const auto a = corner(m, 3 * i), from = a - drawing::V3(a.x > 3 ? 4.5 : 0),
               across = cross(corner(m, 3 * i + 1) - a, corner(m, 3 * i + 2) - a);
    CHECK(light.at(i, 0.3, 0.4) == Approx(dot(from, across) * (m.ccw ? 1 : -1) > 0 ? 1 : 0).margin(0.05));
  }
}

TEST_CASE("bake: dim ground under water makes no fringe along the shore") {
  const std::string water =
      "Shape { appearance Appearance { material Material { diffuseColor 0 0 0 transparency 0.2 } } geometry "
      "IndexedFaceSet { solid FALSE coord Coordinate { point [ -9 0 -9, -9 0 9, 9 0 9, 9 0 -9 ] } coordIndex [ 0 1 2 3 "
      "-1 ] } } ";
  Baked b(water +
              "Transform { rotation 0 1 0 0.3 children Transform { rotation 0 0 1 0.4 children DEF Ground Shape { " +
              material(0) + " geometry " + floor_of_4 + " } } }",
          "quality=draft,max-size=128,sky=1:1:1,denoise=false");
  Light ground(b, "Ground");
  double dry = 0, shore = 10;
  for (int k = 0; k < 100; ++k) {
    const double z = -1.5 + 0.03 * k;
    dry += ground.on_floor(1, z) / 100;
    shore = std::min(shore, ground.on_floor(0.005, z));
  }
  CHECK(ground.on_floor(-1, 0) < 0.4 * dry);
  CHECK(shore > 0.6 * dry);
}

TEST_CASE("bake: what stands in a glass has light of its own, and the glass has it on both sides") {
  const std::string glass =
      "appearance Appearance { material Material { transparency 0.5 } } geometry IndexedFaceSet { solid FALSE " +
      box(false, 2).substr(17);
  Baked b("DEF In Shape { " + material(0.5) + " geometry " + box(false, 1) + " } DEF Glass Shape { " + glass +
              " } PointLight { location 0 5 0 attenuation 0 0 1 }",
          "quality=draft,max-size=128,sky=0:0:0");
  CHECK(b.stats["lightmap.inside"] == 0);
  CHECK(Light(b, "Glass").mesh.corners.size() == 72);
}

TEST_CASE("bake: what shines into a closed thing that it touches is no leak, and shines outwards only") {
  // The lower end of the cap lies in the upper end of the post.
  auto block = [](const char* name, double y, double half, const std::string& surface, const char* solid) {
    return "Transform { translation 0 " + std::to_string(y) + " 0 children DEF " + name + " Shape { " + surface +
           " geometry IndexedFaceSet { " + solid + " " + box(false, half).substr(17) + " } } ";
  };
  const std::string plate = "DEF Plate Transform { translation 0 -0.9 0 children Shape { " + material(0.5) +
                            " geometry Box { size 3 0.1 3 } } } ";
  Baked b(block("Post", 0, 1, material(0.5), "") + block("Cap", 2, 1, material(0, 1), "") + plate,
          "quality=draft,max-size=64");
  CHECK(b.stats["lightmap.inside"] > 0);
  CHECK(b.stats["lightmap.leaks"] == 0);
  // A closed lamp of which nobody sees the inner side, and something in it.
  Baked lamp(block("Lamp", 0, 1, material(0, 1), "solid FALSE") +
                 "DEF In Transform { scale 0.3 0.3 0.3 children DEF Core Shape { " + material(0.5) + " geometry " +
                 box(false, 1) + " } }",
             "quality=draft,max-size=64");
  Light core(lamp, "Core");
  for (std::size_t i = 0; i < core.mesh.corners.size() / 3; ++i) CHECK(core.at(i, 0.3, 0.3) == 0);
}

TEST_CASE("bake: a large face hides nothing from itself where it goes through the middle of the world", "[bake]") {
  Baked b("DEF Plate Shape { " + material(0.5) +
              " geometry IndexedFaceSet { coord Coordinate { point [ -1.1 -0.6 0.53, 1.1 -0.6 -0.53, 1.1 0.67 -0.53, "
              "-1.1 0.67 0.53 ] } "
              "coordIndex [ 0 1 2 3 -1 ] } } DirectionalLight { direction 0 0 -1 }",
          "quality=draft,max-size=128");
  Light plate(b, "Plate");
  for (double a = 0.01; a < 1; a += 0.02)
    for (double c = 0.01; a + c < 1; c += 0.02) CHECK(plate.at(std::size_t{0}, a, c) == Approx(0.901).epsilon(0.02));
}

TEST_CASE("bake: a polygon in one chart is a polygon again, and all levels of a LOD have light", "[bake]") {
  auto level = [&](const char* name, const std::string& geometry) {
    return "DEF " + std::string(name) + " Shape { appearance DEF A Appearance { material Material { } } geometry " +
           geometry + " } ";
  };
  Baked b("LOD { range 10 level [ " + level("Near", "DEF G " + floor_of_4) + "Group { children [ " +
              level("Far", "USE G") + " ] } ] } " +
              "DEF Else Transform { translation 9 0 0 children Shape { appearance USE A geometry Box { } } } "
              "PointLight { location 0 2 0 attenuation 0 0 1 }",
          "quality=draft,max-size=128");
  const Scene& scene = b.world->scene;
  auto geometry = [&](const char* name) { return scene.get(b.shape(name), nodes::shape::geometry); };
  CHECK(geometry("Near") != geometry("Far"));
  for (const char* name : {"Near", "Far"}) {
    CHECK(scene.get(geometry(name), nodes::indexed_face_set::coordIndex).size() == 5);
    CHECK(Light(b, name).on_floor(0.01, 0.01) == Approx(0.25).epsilon(0.05));
  }
  const auto lods = all_nodes(scene);
  const auto lod = std::ranges::find_if(lods, [&](NodeId n) { return scene.is(n, nodes::LOD); });
  REQUIRE(lod != lods.end());
  CHECK(scene.get(*lod, nodes::lod::children)[0] == b.shape("Near"));
}

namespace {

/// The floor at y = 0, as a Shape of a name.
std::string floor_named(const std::string& name) {
  return "DEF " + name + " Shape { " + material(0.5) + " geometry " + floor_of_4 + " } ";
}

std::size_t n_lit(Baked& b) {
  const auto all = all_nodes(b.world->scene);
  return static_cast<std::size_t>(std::ranges::count_if(all, [&](NodeId n) {
    if (!b.world->scene.is(n, nodes::Shape)) return false;
    const NodeId look = b.world->scene.get(n, nodes::shape::appearance);
    return look && b.world->scene.get(look, nodes::appearance::lightmap);
  }));
}

}  // namespace

TEST_CASE("bake: LODs within levels have light at all of theirs, whichever level they stand in", "[bake]") {
  const std::string inner = "Group { children LOD { range 1 level [ " + floor_named("C") + floor_named("D") +
                            "Group { children LOD { range 1 level [ " + floor_named("E") + floor_named("F") +
                            " ] } } ] } }";
  Baked b("LOD { range [ 10 20 ] level [ " + floor_named("A") + inner + floor_named("B") +
              " ] } PointLight { location 0 2 0 attenuation 0 0 1 }",
          "quality=draft,max-size=128");
  for (const char* name : {"A", "B", "C", "D", "E", "F"}) {
    INFO(name);
    CHECK(Light(b, name).on_floor(0.01, 0.01) == Approx(0.25).epsilon(0.05));
  }
  CHECK(n_lit(b) == 6);
  CHECK(b.stats["lightmap.shapes"] == 6);
}

TEST_CASE(
    "bake: a LOD that is shown twice has light of its own in each place, at each level, and its levels in their order",
    "[bake]") {
  // The second place is 4 m below the lamp instead of 2 m.
  Baked b(
      "DEF L LOD { range 10 level [ " + floor_named("Near") + floor_named("Far") +
          " Group { children DEF M LOD { range 10 level [ " + floor_named("X") + floor_named("Y") +
          " ] } } ] } Transform { translation 9 -2 0 children USE L } Transform { translation 99 0 0 children USE M } "
          "PointLight { location 0 2 0 attenuation 0 0 1 radius 6 } PointLight { location 9 2 0 attenuation 0 0 1 "
          "radius 6 } PointLight { location 99 1 0 attenuation 0 0 1 radius 6 } ",
      "quality=draft,max-size=256");
  CHECK(b.stats["lightmap.shapes"] == 10);
  CHECK(n_lit(b) == 10);
  for (const char* name : {"Near", "Far"}) {
    INFO(name);
    CHECK(Light(b, name).on_floor(0.01, 0.01) == Approx(0.25).epsilon(0.05));
    CHECK(Light(b, name + std::string("_2")).on_floor(0.01, 0.01) == Approx(1. / 16).epsilon(0.05));
  }
  const Scene& scene = b.world->scene;
  const auto all = all_nodes(scene);
  for (NodeId n : all) {
    if (!scene.is(n, nodes::LOD)) continue;
    const auto levels = scene.get(n, nodes::lod::children);
    CHECK(scene.name(levels[0]).substr(0, 1) == (scene.name(n).substr(0, 1) == "L" ? "N" : "X"));
  }
}

TEST_CASE("bake: a shade that lets out more light at a further level does not change the light of the world",
          "[bake]") {
  // The lamp stands in a closed box, and just below the plate that is its second level.
  const std::string box = "Shape { " + material(0.5) + " geometry Box { size 0.4 0.4 0.4 } } ",
                    plate = "DEF Plate Shape { " + material(0.5) + " geometry Box { size 0.4 0.01 0.4 } } ";
  Baked b("LOD { range 10 level [ " + floor_named("Near") + floor_named("Far") +
              " ] } LOD { range 10 level [ Transform { translation 0 2 0 children " + box +
              "} Transform { translation 0 2.1 0 children " + plate +
              " } ] } PointLight { location 0 2 0 attenuation 0 0 1 } DirectionalLight { direction 0 -1 0 intensity "
              "0.5 } DEF Far_away Transform { translation 0 -50 0 children " +
              box + "}",
          "quality=draft,max-size=256");
  const double sun = srgb_to_linear(0.5);
  for (const char* name : {"Near", "Far"}) {
    INFO(name);
    CHECK(Light(b, name).on_floor(1.5, 1.5) == Approx(sun).epsilon(0.06));
  }
  CHECK(n_lit(b) == 5);
  CHECK(b.stats["lightmap.pages"] == 3);
}

TEST_CASE("bake: levels that come to no end are lit as far as there is a view of them, which is said", "[bake]") {
  std::string levels;
  for (int i = 0; i < 66; ++i)
    levels += "DEF S" + std::to_string(i) + " Shape { " + material(0.5) + " geometry " + floor_of_4 + " } ";
  Baked b("LOD { level [ " + levels + " ] } PointLight { location 0 2 0 }", "quality=draft,max-size=64");
  CHECK(n_lit(b) == 64);
  CHECK(b.diag.count(Severity::error) == 1);
}

TEST_CASE("bake: letters have light, in one chart for each side, and text that events write stays text", "[bake]") {
  auto text = [](const std::string& name, const std::string& place, const std::string& style = "") {
    return "Transform { " + place + " children DEF " + name + " Shape { " + material(0.5) + " geometry DEF " + name +
           "_text Text { string [ \"II II\" \"II II\" ] fontStyle " + style +
           " FontStyle { size 2 justify [ \"MIDDLE\" \"MIDDLE\" ] } } } } ";
  };
  Baked b(text("Plain", "") + text("Mirrored", "translation 20 0 0 scale -1 1 1") +
              text("Routed", "translation 40 0 0") + text("Styled", "translation 60 0 0", "DEF Style") +
              text("Written", "translation 80 0 0") +
              "DEF S Script { field SFNode sign USE Written_text eventOut MFString s eventOut MFString t } ROUTE S.s "
              "TO Routed_text.set_string ROUTE S.t TO Style.set_justify "
              "DirectionalLight { direction 0 0 -1 } DirectionalLight { direction 0 0 1 color 0 0 1 }",
          "quality=draft,max-size=256");
  const Scene& scene = b.world->scene;
  for (const char* name : {"Routed", "Styled", "Written"}) {
    INFO(name);
    const NodeId shape = b.shape(name);
    CHECK(scene.is(scene.get(shape, nodes::shape::geometry), nodes::Text));
    CHECK(!scene.get(scene.get(shape, nodes::shape::appearance), nodes::appearance::lightmap));
  }
  for (const char* name : {"Plain", "Mirrored"}) {
    INFO(name);
    Light light(b, name);
    const std::size_t n = light.mesh.corners.size() / 3, in_front = n / 2;
    REQUIRE(n > 0);
    CHECK(!scene.is(scene.get(b.shape(name), nodes::shape::geometry), nodes::Text));
    for (std::size_t i = 0; i < n; ++i)
      CHECK(light.at(i, 0.3, 0.3) == Approx(i < in_front ? 1 : 0).margin(0.03));  // the light from behind has no green
  }
  CHECK(b.stats["lightmap.charts"] == 4);
}

TEST_CASE("bake: materials of X3D 4.0 take light, and those that are unlit give it", "[bake]") {
  const std::string lamp =
      "Transform { translation 0 1 0 rotation 1 0 0 3.14159265 children Shape { appearance Appearance { material "
      "UnlitMaterial { emissiveColor 1 0.5 1 } } geometry " +
      floor_of_4 + " } } ";
  Baked b(
      "DEF Floor Shape { appearance Appearance { material PhysicalMaterial { baseColor 0.5 0.5 0.5 metallic 1 } } "
      "geometry " +
          floor_of_4 + " } " + lamp,
      "quality=draft,max-size=128,sky=none", "#X3D V4.0 utf8\nPROFILE Full\n");
  // The form factor of a square of 4 m from a point 1 m below its middle.
  CHECK(Light(b, "Floor").on_floor(0.01, 0.01) == Approx(0.831 * srgb_to_linear(0.5)).epsilon(0.03));
  CHECK(b.stats["lightmap.shapes"] == 1);
}

TEST_CASE("bake: shared geometry has as many texels a metre in each of its sizes, and is shared where they are alike",
          "[bake]") {
  auto at = [](const std::string& name, const std::string& transform) {
    return "Transform { " + transform + " children DEF " + name + " Shape { appearance USE Paint geometry USE G } } ";
  };
  Baked b("DEF One Shape { appearance DEF Paint Appearance { material Material {} } geometry DEF G " + floor_of_4 +
              " } " + at("Large", "translation 0 20 0 scale 4 4 4") + at("Long", "translation 0 40 0 scale 1 1 9") +
              at("Flat", "translation 0 60 0 scale 1 0 1") +
              at("Turned", "translation 9 0 0 rotation 1 2 3 1 scale 1.01 1 1") +
              at("Mirrored", "translation 18 0 0 scale -1 1 1"),
          "density=4,quality=draft");
  auto density = [&](const char* name, double x, double z) {
    const Light l(b, name);
    for (std::size_t c = 0; c < l.mesh.corners.size(); c += 3)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t from = c + k, to = c + (k + 1) % 3;
        const double *p = &l.mesh.positions[3 * l.mesh.corners[from]], *q = &l.mesh.positions[3 * l.mesh.corners[to]];
        CHECK(l.texels(from, to) == Approx(4 * std::hypot(x * (p[0] - q[0]), z * (p[2] - q[2]))).epsilon(0.02));
      }
    return b.world->scene.get(b.shape(name), nodes::shape::geometry);
  };
  const NodeId one = density("One", 1, 1), large = density("Large", 4, 4), length = density("Long", 1, 9);
  CHECK((one != large && one != length && large != length));
  for (const char* alike : {"Turned", "Mirrored"}) CHECK(density(alike, 1, 1) == one);
  density("Flat", 1, 1);
}

TEST_CASE("bake: each of very many leaves has a texel, also of a tree that is shown twice", "[bake]") {
  std::string points, faces;
  for (int i = 0; i < 300; ++i) {
    const std::string x = std::to_string(i % 20), z = std::to_string(i / 20);
    points += x + " 0 " + z + ", " + x + ".1 0 " + z + ", " + x + " 0.1 " + z + ", ";
    for (int k = 0; k < 3; ++k) faces += std::to_string(3 * i + k) + " ";
    faces += "-1 ";
  }
  Baked b("DEF Tree Shape { " + material(0.5) + " geometry IndexedFaceSet { coord Coordinate { point [ " + points +
              " ] } coordIndex [ " + faces + " ] } } Transform { translation 50 0 0 children USE Tree }",
          "quality=draft,max-size=32,sky=1:1:1");
  const Light tree(b, "Tree");
  std::set<std::pair<float, float>> places;
  for (std::size_t c = 0; c < tree.mesh.corners.size(); c += 3) {
    const float* p = tree.mesh.lightcoord.at(tree.mesh.lightcoord.index[c]);
    places.emplace(p[0], p[1]);
  }
  CHECK(places.size() == 300);
}

TEST_CASE("bake: what has a name gets as many texels as it is said to", "[bake]") {
  const std::string two = "DEF Floor Shape { " + material(0.5) + " geometry " + floor_of_4 +
                          " } DEF Signs Group { children Transform { translation 0 1 0 children DEF Board Shape { " +
                          material(0.5) + " geometry " + floor_of_4 + " } } }";
  auto sides = [&](const std::string& options) {
    Baked b(two, "quality=draft,max-size=128" + options);
    auto side = [&](std::string_view name) {
      const Light l(b, name);
      double low = 1, high = 0;
      for (std::size_t i = 0; i < l.mesh.lightcoord.values.size(); i += 2) {
        low = std::min(low, double{l.mesh.lightcoord.values[i]});
        high = std::max(high, double{l.mesh.lightcoord.values[i]});
      }
      return high - low;
    };
    return side("Board") / side("Floor");
  };
  CHECK(sides("") == Approx(1).epsilon(0.05));
  CHECK(sides(",densities=Board=0.25") == Approx(0.25).epsilon(0.05));
  CHECK(sides(",densities=Wall*=3:Sig*=0.5:Floor=1") == Approx(0.5).epsilon(0.05));
  // The boards share their geometry.
  Baked b(
      "DEF A Shape { appearance DEF Paint Appearance { material Material {} } geometry DEF G Box {} } Transform { "
      "translation 3 0 0 children DEF B Shape { appearance USE Paint geometry USE G } }",
      "quality=draft,max-size=128,densities=B=3");
  CHECK(Light(b, "B").texels(0, 1) == Approx(3 * Light(b, "A").texels(0, 1)).epsilon(0.05));
  NamedDensities d;
  for (const char* wrong : {"Floor", "=2", "Floor=x", "Floor=0", "Floor=1:Wall"}) CHECK(!d.read(wrong));
  REQUIRE(d.read("A*=2:B=0.5"));
  CHECK(d.print() == "A*=2:B=0.5");
}
