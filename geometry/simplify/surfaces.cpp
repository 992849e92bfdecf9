#include "geometry/simplify/surfaces.h"

#include <algorithm>
#include <span>

#include "geometry/geometry.h"
#include "geometry/simplify/collapse.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scopes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

class SurfaceSearch {
 public:
  SurfaceSearch(const Scene& scene, const ShapeLeft& left, BelowLod below, OfText text)
      : scene_(scene), left_(left), below_(below), text_(text), order_(all_nodes(scene)), kept_(scene.node_count()) {}

  std::vector<ShapeSurface> run() {
    keep_routed();
    if (below_ != BelowLod::take) keep_below_levels();
    std::vector<ShapeSurface> out;
    constexpr std::uint32_t none = 0xffffffff;
    std::vector<std::uint32_t> number(scene_.node_count(), none);
    for (NodeId n : order_) {
      if (!scene_.is(n, nodes::Shape)) continue;
      const Value* v = scene_.find(n, nodes::shape::geometry.slot);
      if (!v || (!v->is && !is_surface(v->node))) continue;
      if (const char* why = reason_to_leave(n, *v)) {
        if (left_) left_(n, why);
        continue;
      }
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
    for_each_route(scene_, [&](const Route& r) { kept_[r.from.value] = kept_[r.to.value] = Kept::routed; });
  }

  void keep_below_levels() {
    std::vector<NodeId> levels;
    for (NodeId n : order_)
      if (scene_.is(n, nodes::LOD) && (below_ == BelowLod::leave || has_coarser_level(scene_, n)))
        for_each_child(scene_, n, [&](NodeId c) { levels.push_back(c); });
    for (NodeId n : reachable(scene_, levels)) kept_[n.value] = Kept::has_levels;
  }

  bool has_is(NodeId n) const {
    return std::ranges::any_of(scene_.fields(n), [&](const Value& v) { return scene_.content(v).is; });
  }
  bool is_surface(NodeId g) const {
    return g && scene_.is(g, nodes::X3DGeometryNode) && !scene_.is(g, nodes::IndexedLineSet) &&
           !scene_.is(g, nodes::PointSet);
  }

  /// Null for a Shape whose surface is known now and stays as it is.
  const char* reason_to_leave(NodeId shape, const Value& geometry) const {
    constexpr const char* by_is = "the Shape of a prototype that gets its values by IS";
    if (const char* why = reason(kept_[shape.value])) return why;
    if (geometry.is) return by_is;
    if (text_ == OfText::leave && scene_.is(geometry.node, nodes::Text)) return "text";
    const char* why = has_is(geometry.node) ? by_is : reason(kept_[geometry.node.value]);
    for_each_child(scene_, geometry.node, [&](NodeId c) {
      if (c && !why)
        why = has_is(c)                                  ? by_is
              : scene_.type(c).kind != NodeKind::builtin ? "a Shape that contains unknown nodes"
                                                         : reason(kept_[c.value]);
    });
    return why;
  }

  enum class Kept : std::uint8_t { no, routed, has_levels };
  static const char* reason(Kept kept) {
    return kept == Kept::routed       ? "a Shape that a ROUTE changes"
           : kept == Kept::has_levels ? "a Shape below a LOD, which has its levels"
                                      : nullptr;
  }

  const Scene& scene_;
  const ShapeLeft& left_;
  BelowLod below_;
  OfText text_;
  std::vector<NodeId> order_;
  std::vector<Kept> kept_;  // by node: whether it must not change
};

}  // namespace

bool has_coarser_level(const Scene& scene, NodeId lod) {
  const auto levels = scene.get(lod, nodes::lod::children);
  const auto draws = [&](NodeId n) { return scene.is(n, nodes::Shape) || scene.type(n).kind != NodeKind::builtin; };
  return levels.size() > 1 && std::ranges::any_of(reachable(scene, std::span(levels).subspan(1)), draws);
}

ShapeLeft report_not_simplified(const Scene& scene, Diagnostics& diag) {
  return [&](NodeId shape, const char* why) { diag.report(Diag::not_simplified, scene.where(shape), why); };
}

std::vector<ShapeSurface> surfaces_of(const Scene& scene, const ShapeLeft& left, BelowLod below, OfText text) {
  return SurfaceSearch(scene, left, below, text).run();
}

SurfaceReader::SurfaceReader(const Scene& scene, Task& ctx, const Tessellation& faces)
    : scene_(scene), ctx_(ctx), faces_(faces), textured_(textured_geometry(scene)) {}

void SurfaceReader::read(const ShapeSurface& surface, Mesh& mesh) {
  mesh.clear();
  MeshJob job{scene_, surface.geometry, mesh, scratch_, ctx_, textured_[surface.geometry.value] != 0};
  make_mesh(job, faces_);
  if (!mesh.is_triangles()) return mesh.clear();
  if (!job.textured) mesh.texcoord.clear();
  if (mesh.primitive) {
    mesh.normal.clear();
    mesh.crease_angle = CollapseOptions{}.crease_angle;
  }
}

}  // namespace wrlkit
