#include "writers/gltf/document/fold.h"

#include "scenegraph/nodes.h"
#include "scenegraph/tags.h"
#include "writers/gltf/document/group.h"

namespace wrlkit::gltf {
namespace {

bool is_plain_group(const Scene& scene, NodeId n) { return scene.is(n, nodes::Transform) || scene.is(n, nodes::Group); }

bool has_unseen_facts(const Makers& m, NodeId n) {
  return m.extras && m.scene.is(n, nodes::Shape) && m.extras->has_unseen_facts(n);
}

/// It needs a node of its own to be found again.
bool says_something(const Makers& m, NodeId n) {
  return !m.scene.name(n).empty() || (m.extras && has_tags(m.scene, n));
}

bool can_be_one(const Makers& m, NodeId group, const Node& child) {
  if (!child.source || child.lod || child.hidden) return false;
  if (child.attachment != Attachment::mesh && child.attachment != Attachment::nothing) return false;
  if (child.attachment == Attachment::nothing && has_unseen_facts(m, child.source)) return false;
  if (m.animations.moves(child.source) || m.animations.moves(group)) return false;
  if (says_something(m, child.source) && says_something(m, group)) return false;
  return is_plain_group(m.scene, child.source) || m.scene.is(child.source, nodes::Shape);
}

bool fold_into(Document& d, const Makers& m, NodeId group, const Trs& outer, Node& child) {
  if (!can_be_one(m, group, child)) return false;
  const Trs inner = d.place(child);
  const bool even = outer.scale[0] == outer.scale[1] && outer.scale[1] == outer.scale[2];
  if (!even && !inner.rotation.identity()) return false;
  Trs both{matrix(outer).point(inner.translation), outer.rotation * inner.rotation, inner.scale};
  for (std::size_t i = 0; i < 3; ++i) both.scale[i] *= outer.scale[i];
  child.transform = d.add_transform(both);
  if (!says_something(m, child.source)) child.source = group;
  return true;
}

}  // namespace

bool does_something(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::Anchor) || scene.is(n, nodes::Billboard);
}

bool fold(Document& d, const Makers& m, NodeId group, const NodeTransform& local, std::uint32_t id) {
  if (!is_plain_group(m.scene, group) || local.inner || turns_about_a_center(m, group)) return false;
  Node& child = d.nodes[id];
  if (m.options.facts_only) return fold_into(d, m, group, local.outer, child);
  const bool bare =
      child.attachment == Attachment::mesh && child.transform == none && m.scene.name(child.source).empty();
  if (!bare || (m.extras && m.extras->says_more(child.source, nodes::Shape))) return false;
  child.source = group;
  child.plain = local.plain;
  child.transform = d.add_transform(local.outer, m.animations.moves(group));
  add_targets(m, group, id, id, id);
  return true;
}

bool says_nothing(const Makers& m, const Node& n) {
  if (!m.options.facts_only || !n.source || n.n_children > 0 || n.attachment != Attachment::nothing) return false;
  const bool group = m.scene.is(n.source, nodes::X3DGroupingNode) || m.scene.is(n.source, nodes::Shape);
  return group && !says_something(m, n.source) && !has_unseen_facts(m, n.source) && !does_something(m.scene, n.source);
}

}  // namespace wrlkit::gltf
