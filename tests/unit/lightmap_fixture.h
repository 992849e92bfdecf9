// A world in memory with light on its surfaces, and the pictures that passes make of it.
#pragma once
#include <catch2/catch.hpp>

#include "base/image/srgb_table.h"
#include "geometry/geometry.h"
#include "parsers/parsers.h"
#include "parsers/resources.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {

struct Lit {
  Diagnostics diag;
  Statistics stats;
  FileResources resources{{.input = "test.wrl"}, [](const std::string&, Diagnostics&) { return nullptr; }};
  PassContext ctx{diag, stats, &resources};
  std::unique_ptr<World> world;

  explicit Lit(const std::string& body, const std::string& header = "#VRML V2.0 utf8\n")
      : world(parse_world(header + body, "test.wrl", {}, diag)) {
    REQUIRE(world);
  }
  Scene& scene() { return world->scene; }
  void run(const std::string& pipeline) {
    std::string why;
    auto p = Pipeline::parse(pipeline, why);
    INFO(why);
    REQUIRE(p);
    REQUIRE(p->run(scene(), ctx));
  }
  std::vector<NodeId> of(TypeId type) {
    std::vector<NodeId> out;
    for (NodeId n : all_nodes(scene()))
      if (scene().is(n, type)) out.push_back(n);
    return out;
  }
  Mesh mesh(NodeId geometry) {
    Mesh m;
    MeshScratch scratch;
    MeshJob job{scene(), geometry, m, scratch, ctx};
    read_mesh(job);
    return m;
  }
  std::shared_ptr<const Image> picture(NodeId texture) {
    return resources.image(scene().get(texture, nodes::image_texture::url), scene().where(texture), diag);
  }
};

using Rgb = std::array<int, 3>;
inline Rgb pixel(const Image& i, int x, int y) {
  const auto* p = i.pixels.data() + (std::size_t(y) * i.width + x) * i.channels;
  return {p[0], p[1], p[2]};
}

/// sRGB of a linear number, in 255ths.
inline int shown(double linear) { return static_cast<int>(linear_to_srgb(linear) * 255 + 0.5); }

/// A square of 2 m whose light is the middle half of its page, four texels of a page of four by four.
inline const std::string square =
    "IndexedFaceSet { coord Coordinate { point [ -1 -1 0, 1 -1 0, 1 1 0, -1 1 0 ] } coordIndex [ 0 1 2 3 -1 ]"
    " lightCoord TextureCoordinate { point [ 0.25 0.25, 0.75 0.25, 0.75 0.75, 0.25 0.75 ] } }";
inline const std::string half_lit =
    "PixelTexture { image 4 4 1 128 128 128 128 128 128 128 128 128 128 128 128 128 128 128 128 }";
inline const std::string with_light = " lightmap DEF Light " + half_lit;

inline std::string shape(const std::string& appearance, const std::string& geometry = square) {
  return "Shape { appearance Appearance { " + appearance + " } geometry " + geometry + " } ";
}

}  // namespace wrlkit
