#include "passes/simplify/surfaces.h"

#include <algorithm>

#include "passes/geometry.h"
#include "passes/simplify/collapse.h"
#include "passes/tessellate.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

class Choice {
 public:
  explicit Choice(const Scene& scene) : scene_(scene), order_(all_nodes(scene)), kept_(scene.node_count()) {}

  std::vector<ShapeSurface> run() {
    keep_routed();
    keep_below_levels();
    std::vector<ShapeSurface> out;
    constexpr std::uint32_t none = 0xffffffff;
    std::vector<std::uint32_t> number(scene_.node_count(), none);
    for (NodeId n : order_) {
      if (!scene_.is(n, nodes::Shape) || kept_[n.value]) continue;
      const Value* v = scene_.find(n, nodes::shape::geometry.slot);
      if (!v || v->is || !is_fixed(v->node)) continue;
      auto& i = number[v->node.value];
      if (i == none) {
        i = static_cast<std::uint32_t>(out.size());
        out.push_back({v->node, {}});
      }
      out[i].shapes.push_back(n);
    }
    return out;
  }

 private:
  void keep_routed() {
    auto keep = [&](const Scope& s) { for (const auto& r : s.routes) kept_[r.from.value] = kept_[r.to.value] = 1; };
    keep(scene_.main);
    for (std::uint32_t i = 0; i < scene_.proto_count(); ++i) keep(scene_.proto(ProtoId{i}).body);
  }

  void keep_below_levels() {
    std::vector<NodeId> todo;
    std::ranges::copy_if(order_, std::back_inserter(todo), [&](NodeId n) { return scene_.is(n, nodes::LOD); });
    std::vector<char> seen(scene_.node_count());
    while (!todo.empty()) {
      NodeId n = todo.back();
      todo.pop_back();
      for_each_child(scene_, n, [&](NodeId c) {
        if (!c || seen[c.value]) return;
        seen[c.value] = kept_[c.value] = 1;
        todo.push_back(c);
      });
    }
  }

  bool has_is(NodeId n) const {
    return std::ranges::any_of(scene_.fields(n), [&](const Value& v) { return scene_.content(v).is; });
  }
  bool is_known(NodeId n) const { return n && !kept_[n.value] && scene_.type(n).kind == NodeKind::builtin && !has_is(n); }

  /// Whether the surface of a geometry is known now and stays as it is.
  bool is_fixed(NodeId g) const {
    if (!is_known(g) || scene_.is(g, nodes::Text) || !scene_.type(g).is_a("X3DGeometryNode")) return false;
    bool fixed = true;
    for_each_child(scene_, g, [&](NodeId c) { fixed = fixed && (!c || is_known(c)); });
    return fixed;
  }

  const Scene& scene_;
  std::vector<NodeId> order_;
  std::vector<char> kept_;  // by node: must not change
};

}  // namespace

std::vector<ShapeSurface> surfaces_of(const Scene& scene) { return Choice(scene).run(); }

SurfaceReader::SurfaceReader(const Scene& scene, PassContext& ctx) : scene_(scene), ctx_(ctx), textured_(textured_geometry(scene)) {}

void SurfaceReader::read(const ShapeSurface& surface, Mesh& mesh) {
  mesh.clear();
  MeshJob job{scene_, surface.geometry, mesh, scratch_, ctx_, textured_[surface.geometry.value] != 0};
  tessellate(job, {.texcoords = true});
  if (!mesh.is_triangles()) return mesh.clear();
  if (!job.textured) mesh.texcoord.clear();
  if (mesh.primitive) mesh.normal.clear(), mesh.crease_angle = CollapseOptions{}.crease_angle;
}

}  // namespace wrlkit
