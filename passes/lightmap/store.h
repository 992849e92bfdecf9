// Writes baked light into the scene: pictures, places in them, and which Shape has which.
//
//   after    Shape { appearance Appearance { ... lightmap DEF L ImageTexture { url "wrlkit:lightmap_0.png" }
//                                            lightmapTransform TextureTransform { ... } lightmapScale 2.5 }
//                    geometry IndexedFaceSet { ... lightCoord TextureCoordinate { ... } lightCoordIndex [ ... ] } }
#pragma once
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/image/image.h"
#include "passes/lightmap/bake.h"

namespace wrlkit::bake {

struct StoreOptions {
  std::string extension = "png";  // of the pictures
  bool exr = false;               // the light as it is next to them, linear, not scaled and not exposed
  double exposure = 1;            // factor on the light
};

/// Takes the pictures of all pages, which go to ctx.resources, and then part by part and Shape by Shape what lies on
/// them. Light is `exposure` times as bright in them. lightmapScale is the same everywhere: as much as keeps all but
/// the brightest thousandth of the texels below white.
class Storing {
 public:
  Storing(Scene& scene, const std::vector<BakedPage>& pages, const StoreOptions& options, PassContext& ctx);

  /// `geometry` becomes an IndexedFaceSet of the triangles of the part, with lightCoord: two numbers for each corner.
  /// Polygons that lie in one chart are polygons again.
  void place(Part& part, const std::vector<float>& coords, NodeId geometry);
  /// The Appearance of the Shape gets the lightmap of a page; one that Shapes with different lightmaps share is copied.
  void light(NodeId shape, const ShapePlace& place, const PageLayout& page);

 private:
  void add_page(std::size_t i, const BakedPage& page);
  NodeId texture(const std::string& name, const Image& image);
  NodeId transform(const ShapePlace& p, const PageLayout& page);
  NodeId own_appearance(NodeId shape, const ShapePlace& place);

  Scene& scene_;
  StoreOptions options_;
  PassContext& ctx_;
  double scale_;
  std::vector<NodeId> lightmaps_;  // of each page
  std::vector<std::vector<NodeId>> directions_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, NodeId> of_;  // Appearances by the one that was, and page
  std::set<std::uint32_t> taken_;                                 // Appearances that have a lightmap
};

/// All of a layout.
void store(Scene& scene, std::vector<Part>& parts, const Layout& layout, const drawing::Stage& stage,
           const std::vector<BakedPage>& pages, const StoreOptions& options, PassContext& ctx);

}  // namespace wrlkit::bake
