// Writes combined pictures into the scene: which texture a Shape shows, and at which places.
#pragma once
#include <array>
#include <map>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "passes/combine_lightmap/combine_lightmap.h"
#include "scenegraph/looks/texture_transform_node.h"

namespace wrlkit::combine {

/// Geometry that gets places; several of one node, where its Shapes have different ones.
struct ShownGeometry {
  NodeId node;
  std::vector<double> places = {};                 // by place of the light; empty: as those are
  std::vector<std::array<double, 3>> colors = {};  // by place of the light: instead of a texture; empty: none
};

struct ShownShape {
  NodeId shape, appearance;
  std::size_t geometry;                       // of those above
  NodeId texture;                             // none: the geometry has colours
  std::optional<TexcoordMap> transform = {};  // of the places
  bool as_light = false;                      // the transform is that of the light
};

class Showing {
 public:
  Showing(Scene& scene, CombineTarget into) : scene_(scene), into_(into) {}

  /// Nodes that such a Shape holds are copied before they change.
  void keep(NodeId shape);
  void show(std::vector<ShownGeometry> geometries, const std::vector<ShownShape>& shapes);

 private:
  NodeId geometry_of(const ShownGeometry& g);
  NodeId appearance_of(const ShownShape& s);
  void give_places(NodeId geometry, const std::vector<double>& places);
  void give_colors(NodeId geometry, const std::vector<std::array<double, 3>>& colors);
  NodeId transform_of(const ShownShape& s);
  void give_texture(NodeId appearance, NodeId texture, NodeId transform);
  bool claim(NodeId n) { return !kept_.contains(n.value) && claimed_.insert(n.value).second; }

  Scene& scene_;
  CombineTarget into_;
  std::unordered_set<std::uint32_t> kept_, claimed_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, NodeId> appearances_;  // by the one that was, and texture
};

}  // namespace wrlkit::combine
