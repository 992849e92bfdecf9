#include "passes/lightmap/unlit_nodes.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::bake {
namespace {

bool is_proto(const Scene& scene, NodeId n) { return scene.type(n).kind == NodeKind::proto; }

bool makes_surface(const Scene& scene, NodeId n) {
  if (scene.is(n, nodes::Inline)) return !scene.get(n, nodes::inline_::url).empty();
  return scene.is(n, nodes::Shape) || scene.is(n, nodes::Appearance) ||
         scene.is(n, nodes::X3DMaterialNode | nodes::X3DGeometryNode);
}

/// By prototype. Those that hold instances of others have surfaces when these have.
std::vector<char> with_surfaces(const Scene& scene) {
  std::vector<char> has(scene.proto_count());
  std::vector<std::vector<std::uint32_t>> holders(has.size());
  std::vector<std::uint32_t> open;
  auto found = [&](std::uint32_t p) {
    if (!has[p]) {
      has[p] = 1;
      open.push_back(p);
    }
  };
  for (std::uint32_t p = 0; p < has.size(); ++p) {
    const Proto& proto = scene.proto(ProtoId{p});
    if (proto.external) found(p);
    for (NodeId n : reachable(scene, proto.body)) {
      if (is_proto(scene, n))
        holders[scene.type(n).proto.value].push_back(p);
      else if (makes_surface(scene, n))
        found(p);
    }
  }
  while (!open.empty()) {
    const std::uint32_t p = open.back();
    open.pop_back();
    for (std::uint32_t h : holders[p]) found(h);
  }
  return has;
}

bool is_foreign_surface(const NodeType& type) {
  constexpr std::string_view without_area[] = {"IndexedLineSet", "LineSet",    "PointSet",   "IndexedMarkerSet",
                                               "MarkerSet",      "NurbsCurve", "Polyline2D", "Polypoint2D",
                                               "Arc2D",          "Circle2D"};
  if (type.dialects & static_cast<DialectSet>(Dialect::vrml97)) return false;
  return type.is_a(nodes::Vrml1ShapeNode | nodes::X3DGeometryNode) &&
         std::ranges::find(without_area, type.name) == std::end(without_area);
}

}  // namespace

std::size_t closed_nodes(const Scene& scene) {
  const auto has = with_surfaces(scene);
  return static_cast<std::size_t>(std::ranges::count_if(reachable(scene, scene.main), [&](NodeId n) {
    return is_proto(scene, n) ? has[scene.type(n).proto.value] != 0
                              : scene.is(n, nodes::Inline) && makes_surface(scene, n);
  }));
}

std::size_t foreign_surfaces(const Scene& scene) {
  return static_cast<std::size_t>(
      std::ranges::count_if(reachable(scene, scene.main), [&](NodeId n) { return is_foreign_surface(scene.type(n)); }));
}

}  // namespace wrlkit::bake
