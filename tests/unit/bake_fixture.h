// Worlds that were baked, and the lightmaps of their Shapes.
#pragma once
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

namespace wrlkit::bake_tests {

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
inline std::string box(bool inward, double half) {
  const auto h = std::to_string(half);
  std::string points;
  for (int i = 0; i < 8; ++i)
    points += std::string(i & 1 ? "" : "-") + h + (i & 2 ? " " : " -") + h + (i & 4 ? " " : " -") + h + ", ";
  std::string faces = "0 2 3 1 -1 4 5 7 6 -1 0 1 5 4 -1 2 6 7 3 -1 0 4 6 2 -1 1 3 7 5 -1";
  return "IndexedFaceSet { ccw " + std::string(inward ? "FALSE" : "TRUE") + " coord Coordinate { point [ " + points +
         " ] } coordIndex [ " + faces + " ] }";
}

inline std::string material(double diffuse, double emissive = 0) {
  auto c = [](double linear) {
    auto v = std::to_string(linear_to_srgb(linear));
    return v + " " + v + " " + v;
  };
  return "appearance Appearance { material Material { diffuseColor " + c(diffuse) + " emissiveColor " + c(emissive) +
         " } }";
}

inline drawing::V3 corner(const Mesh& m, std::size_t c) {
  return vec3(m.positions.data() + std::size_t{3} * m.corners[c]);
}

inline const std::string floor_of_4 =
    "IndexedFaceSet { coord Coordinate { point [ -2 0 -2, -2 0 2, 2 0 2, 2 0 -2 ] } coordIndex [ 0 1 2 3 -1 ] }";

}  // namespace wrlkit::bake_tests
