#include "passes/lower_x3d/clip_planes.h"

#include <algorithm>
#include <map>
#include <utility>

#include "geometry/geometry.h"
#include "geometry/half_space.h"
#include "geometry/tessellation.h"
#include "passes/normals/normals.h"
#include "scenegraph/any_node.h"
#include "scenegraph/driven.h"
#include "scenegraph/nodes.h"
#include "scenegraph/transform.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

using Planes = std::vector<Vec4>;  // in the coordinates of the node; seen where all are not negative

class ClipPlanes {
 public:
  ClipPlanes(Scene& scene, PassContext& ctx)
      : scene_(scene), ctx_(ctx), textured_(textured_geometry(scene)), driven_(driven_geometry(scene)) {
    for (const Route& r : scene.main.routes)
      if (scene.is(r.to, nodes::ClipPlane) || scene.is(r.from, nodes::ClipPlane)) moved_.push_back(r.to);
  }

  void run() {
    const auto roots = children(scene_.main.roots, {}, false);
    scene_.main.roots = roots;
    for (NodeId n : moved_)
      if (scene_.is(n, nodes::ClipPlane)) scene_.set(n, nodes::clip_plane::enabled, false);
  }

 private:
  static constexpr std::size_t deepest = 2000, most = 100'000;

  /// `each`: an empty Group stands for what nothing is left of, because the number of children counts.
  std::vector<NodeId> children(std::span<const NodeId> list, Planes planes, bool each) {
    for (NodeId n : list) {
      if (!scene_.is(n, nodes::ClipPlane) || !scene_.get(n, nodes::clip_plane::enabled)) continue;
      const Vec4 plane = scene_.get(n, nodes::clip_plane::plane);
      if (plane[0] != 0 || plane[1] != 0 || plane[2] != 0) planes.push_back(plane);
    }
    std::vector<NodeId> out;
    for (NodeId n : list) {
      NodeId left = node(n, planes);
      if (!left && each) left = scene_.add(nodes::Group, scene_.where(n));
      if (left) out.push_back(left);
    }
    return out;
  }

  /// What is left of a node: itself, or a copy where it was something else already.
  NodeId node(NodeId n, const Planes& planes) {
    if (scene_.is(n, nodes::ClipPlane)) {
      const bool done = scene_.get(n, nodes::clip_plane::enabled) && std::ranges::find(moved_, n) == moved_.end();
      return done ? NodeId{} : n;
    }
    const bool shape = scene_.is(n, nodes::Shape);
    if (!shape && !scene_.is(n, nodes::X3DGroupingNode)) return n;
    if (depth_ >= deepest) return n;
    if (const auto known = made_.find({n, planes}); known != made_.end()) return known->second;
    if (made_.size() > most) {
      if (!std::exchange(full_, true))
        ctx_.diag.report(Diag::expansion_limit, scene_.where(n), most, "nodes below ClipPlanes");
      return n;
    }
    ++depth_;
    const NodeId out = shape ? of_shape(n, planes) : of_group(n, planes);
    --depth_;
    return made_[{n, planes}] = out;
  }

  /// The node itself where it is met first, a copy of what it was in the beginning elsewhere.
  NodeId own(NodeId n) {
    const auto [i, first] = originals_.emplace(n, scene_.copy_of_fields(n));
    if (first) return n;
    const NodeId copy = scene_.add(scene_.type_id(n), scene_.where(n));
    scene_.set_name(copy, scene_.name(n));
    scene_.set_fields(copy, i->second);
    return copy;
  }

  std::uint16_t children_slot(NodeId n) const {
    const auto fields = scene_.type(n).fields;
    return static_cast<std::uint16_t>(std::ranges::find(fields, "children", &FieldDef::name) - fields.begin());
  }

  NodeId of_group(NodeId n, const Planes& planes) {
    const std::uint16_t slot = children_slot(n);
    if (slot == scene_.type(n).fields.size()) return n;
    std::vector<NodeId> list;
    if (const auto i = originals_.find(n); i != originals_.end()) {
      for (const Value& v : i->second)
        if (v.slot == slot) list.assign(v.node_span().begin(), v.node_span().end());
    } else {
      const auto now = scene_.value(n, slot).node_span();
      list.assign(now.begin(), now.end());
    }
    Planes inner;
    for (const Vec4& p : planes) inner.push_back(plane_below(p, local_matrix(scene_, n)));
    const bool each = scene_.is(n, nodes::Switch) || scene_.is(n, nodes::LOD);
    const auto left = children(list, inner, each);
    const NodeId to = own(n);
    if (left != list) scene_.set(to, scene_.make(FieldType::MFNode, slot, left));
    return left.empty() && !list.empty() && scene_.name(n).empty() ? NodeId{} : to;
  }

  NodeId of_shape(NodeId n, const Planes& planes) {
    const NodeId g = scene_.get(n, nodes::shape::geometry);
    if (!g || planes.empty() || !is_geometry(scene_, g) || (g.value < driven_.size() && driven_[g.value])) return n;
    const NodeId left = geometry(g, planes);
    if (left == g) return n;
    if (!left) return {};
    const NodeId to = scene_.add(nodes::Shape, scene_.where(n));
    scene_.set_name(to, scene_.name(n));
    const auto fields = scene_.copy_of_fields(n);
    scene_.set_fields(to, fields);
    scene_.set(to, nodes::shape::geometry, left);
    return to;
  }

  NodeId geometry(NodeId g, const Planes& planes) {
    const auto known = made_.find({g, planes});
    if (known != made_.end()) return known->second;
    mesh_.clear();
    MeshJob job{scene_, g, mesh_, scratch_, ctx_, g.value < textured_.size() && textured_[g.value] != 0};
    make_mesh(job, {.texcoords = true});
    normals(job, {});
    bool cut = false;
    for (const Vec4& p : planes) cut |= cut_by_plane(mesh_, p);
    NodeId& out = made_[{g, planes}];
    if (!cut) return out = g;
    if (mesh_.corners.empty()) return out = NodeId{};
    out = scene_.add(mesh_.kind == Mesh::Kind::lines    ? nodes::IndexedLineSet
                     : mesh_.kind == Mesh::Kind::points ? nodes::PointSet
                                                        : nodes::IndexedFaceSet,
                     scene_.where(g));
    store_mesh(scene_, out, mesh_);
    scene_.set_name(out, scene_.name(g));
    return out;
  }

  Scene& scene_;
  PassContext& ctx_;
  std::vector<char> textured_, driven_;
  std::vector<NodeId> moved_;  // ClipPlanes that events come to
  std::map<std::pair<NodeId, Planes>, NodeId> made_;
  std::map<NodeId, std::vector<Value>> originals_;  // fields of nodes that were met
  std::size_t depth_ = 0;
  bool full_ = false;
  Mesh mesh_;
  MeshScratch scratch_;
};

}  // namespace

bool cut_by_clip_planes(Scene& scene, PassContext& ctx) {
  if (!any_node(scene, [&](NodeId n) { return scene.is(n, nodes::ClipPlane); })) return false;
  ClipPlanes(scene, ctx).run();
  return true;
}

}  // namespace wrlkit::x3d
