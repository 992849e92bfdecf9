#include "passes/flatten/flatten.h"

#include <algorithm>
#include <utility>

#include "geometry/geometry.h"
#include "geometry/moved.h"
#include "passes/analysis/figures.h"
#include "passes/analysis/tag_watch.h"
#include "passes/analysis/usage.h"
#include "passes/lightmap/own_shapes.h"
#include "passes/normals/normals.h"
#include "scenegraph/features.h"
#include "scenegraph/metadata.h"
#include "scenegraph/nodes.h"
#include "scenegraph/tags.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

class Flattening {
 public:
  Flattening(Scene& scene, const Tessellation& faces, PassContext& ctx)
      : scene_(scene),
        faces_(faces),
        ctx_(ctx),
        usage_(scene),
        textured_(textured_geometry(scene)),
        state_(scene.node_count(), State::unknown) {}

  bool run() {
    std::vector<std::pair<NodeId, Matrix>> open;
    for (NodeId n : scene_.main.roots)
      if (n) open.push_back({n, {}});
    std::vector<char> seen(scene_.node_count());
    while (!open.empty()) {
      const auto [n, frame] = open.back();
      open.pop_back();
      if (std::exchange(seen[n.value], 1)) continue;
      const bool all = is_still(n);
      const Matrix below = all ? frame * local_matrix(scene_, n) : Matrix{};
      if (all && scene_.is(n, nodes::Shape) && frame != Matrix{}) move(n, frame);
      for (NodeId c : hierarchy_children(scene_, n)) open.push_back({c, below});
      if (all && local_matrix(scene_, n) != Matrix{}) become_group(n);
    }
    return n_transforms_ > 0;
  }

 private:
  enum class State : std::uint8_t { unknown, still, not_still };

  bool is_plain(NodeId n) const { return wrlkit::is_plain(scene_, usage_, n); }

  /// True for a node that is in one place: nothing below it has a place of its own but Shapes. Nesting is bounded
  /// (nesting.h).
  bool is_still(NodeId n) {
    auto& s = state_[n.value];
    if (s == State::unknown) s = find_still(n) ? State::still : State::not_still;
    return s == State::still;
  }
  bool find_still(NodeId n) {
    if (!is_plain(n) || !usage_.once(n)) return false;
    if (scene_.is(n, nodes::Shape)) {
      const NodeId g = scene_.get(n, nodes::shape::geometry);
      if (!g) return true;
      bool plain = is_plain(g) && scene_.is(g, nodes::X3DGeometryNode);
      for_each_child(scene_, g,
                     [&](NodeId c) { plain &= is_plain(c) && !scene_.is(c, nodes::TextureCoordinateGenerator); });
      return plain && !(scene_.is(g, nodes::IndexedFaceSet) && scene_.get(g, nodes::indexed_face_set::lightCoord));
    }
    if (!scene_.is(n, nodes::Group) && !scene_.is(n, nodes::Transform)) return false;
    return std::ranges::all_of(hierarchy_children(scene_, n), [&](NodeId c) { return is_still(c); });
  }

  void move(NodeId shape, const Matrix& frame) {
    const NodeId g = scene_.get(shape, nodes::shape::geometry);
    if (!g) return;
    mesh_.clear();
    MeshJob job{scene_, g, mesh_, scratch_, ctx_, textured_[g.value] != 0};
    make_mesh(job, faces_);
    normals(job, {});
    if (mesh_.kind == Mesh::Kind::none || mesh_.corners.empty()) return;
    moved_.clear();
    append_moved(moved_, mesh_, frame, scratch_.map);
    const NodeId to = scene_.add(moved_.kind == Mesh::Kind::lines    ? nodes::IndexedLineSet
                                 : moved_.kind == Mesh::Kind::points ? nodes::PointSet
                                                                     : nodes::IndexedFaceSet,
                                 scene_.where(g));
    store_mesh(scene_, to, moved_);
    keep_parts(g, to);
    scene_.set_name(to, scene_.name(g));
    take_tags_of_geometry(g, to);
    scene_.set(shape, nodes::shape::geometry, to);
    ++ctx_.stats["flatten.shapes"];
  }

  /// Which of its faces are which parts: where all of them stay.
  void keep_parts(NodeId from, NodeId to) {
    const auto parts = features_of(scene_, from);
    if (parts && parts->n_faces() == moved_.n_faces()) set_features(scene_, to, *parts);
  }

  /// And of Coordinates and the like.
  void take_tags_of_geometry(NodeId from, NodeId to) {
    take_tags(scene_, from, to);
    for (const Value& v : scene_.copy_of_fields(from)) {
      if (scene_.is_extra(v) || v.is || v.type != FieldType::SFNode || !has_tags(scene_, v.node)) continue;
      const auto slot = scene_.type(to).find(scene_.type(from).fields[v.slot].name, Dialect::x3d);
      const Value* same = slot ? scene_.find(to, *slot) : nullptr;
      if (same && same->type == FieldType::SFNode) take_tags(scene_, v.node, same->node);
    }
  }

  /// What a Group has, too, stays: children, metadata, what no table knows. The bounding box was in another frame.
  void become_group(NodeId n) {
    const NodeType& group = builtin_nodes()[nodes::Group.value];
    std::vector<Value> fields;
    for (Value v : scene_.copy_of_fields(n)) {
      if (!scene_.is_extra(v)) {
        const auto name = scene_.type(n).fields[v.slot].name;
        const auto slot = name == "bboxCenter" || name == "bboxSize" ? std::nullopt : group.find(name, Dialect::x3d);
        if (!slot) continue;
        v.slot = *slot;
      }
      fields.push_back(v);
    }
    std::ranges::stable_sort(fields, {}, &Value::slot);
    scene_.become(n, nodes::Group, fields);
    ++n_transforms_;
    ++ctx_.stats["flatten.transforms"];
  }

  Scene& scene_;
  const Tessellation& faces_;
  PassContext& ctx_;
  Usage usage_;
  std::vector<char> textured_;
  std::vector<State> state_;
  Mesh mesh_, moved_;
  MeshScratch scratch_;
  std::size_t n_transforms_ = 0;
};

}  // namespace

Outcome flatten(Scene& scene, const FlattenOptions& options, PassContext& ctx) {
  const auto before = figures_of(scene);
  const TagWatch tags(scene);
  const bool copied = bake::own_shapes(scene, ctx.diag) > 0;
  if (!Flattening(scene, options.faces, ctx).run()) return copied ? Outcome::changed : Outcome::unchanged;
  tags.report_lost(scene, "flatten", ctx.diag);
  count_figures(ctx, "flatten", before, figures_of(scene));
  return Outcome::changed;
}

}  // namespace wrlkit
