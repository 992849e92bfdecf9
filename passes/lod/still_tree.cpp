#include "passes/lod/still_tree.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "scenegraph/nodes.h"
#include "scenegraph/places/ways.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

struct Handed {  // down to children
  std::uint32_t above = 0;
  bool is_inside = false;                // of an atom, or of what is fixed
  std::uint32_t atom = StillTree::none;  // where it is inside of one
};

}  // namespace

StillTree::StillTree(const Scene& scene, const Usage& usage)
    : scene_(scene), usage_(usage), known_(scene.node_count()) {
  nodes_.push_back({});
  Ways<Handed> ways(scene);
  ways.push(scene.main.roots, {});
  while (const auto step = ways.next()) {
    Handed below = step->state;
    const NodeId n = step->node;
    if (!below.is_inside) {
      const auto at = static_cast<std::uint32_t>(nodes_.size());
      const auto kind = kind_of(n);
      nodes_.push_back({n, below.above, 0, kind});
      below = {at, kind != StillNode::Kind::group, kind == StillNode::Kind::atom ? at : none};
    }
    if (!scene.is(n, nodes::Shape))
      ways.push(shown_children(scene, n), below);
    else if (scene.get(n, nodes::shape::geometry))
      atom_of_place_.push_back(below.atom);
  }
  for (auto i = static_cast<std::uint32_t>(nodes_.size()); i-- > 0;) {
    nodes_[i].end = std::max(nodes_[i].end, i + 1);
    auto& above = nodes_[nodes_[i].above];
    above.end = std::max(above.end, nodes_[i].end);
  }
}

StillNode::Kind StillTree::kind_of(NodeId n) {
  using enum StillNode::Kind;
  if (scene_.is(n, nodes::Shape)) return scene_.get(n, nodes::shape::geometry) && is_still(n) ? atom : fixed;
  if (!holds_together(scene_, usage_, n)) return shown_children(scene_, n).empty() ? fixed : group;
  return scene_.is(n, nodes::X3DGroupingNode) && is_still(n) ? atom : fixed;
}

/// Whether it does something for what is in it that a mesh in its place could not.
bool StillTree::has_effect(NodeId n) const {
  if (scene_.is(n, nodes::Collision))
    return !scene_.get(n, nodes::collision::enabled) || scene_.get(n, nodes::collision::proxy);
  return scene_.is(n, nodes::Anchor) || scene_.is(n, nodes::Billboard);
}

/// Whether all that is in it is known, and no event can reach it.
bool StillTree::is_still(NodeId n) {
  constexpr char yes = 1, no = 2;
  auto& known = known_[n.value];
  if (!known) {
    const auto below = reachable(scene_, {&n, 1});
    const auto is_known = [&](NodeId c) {
      return is_plain(scene_, usage_, c) && !scene_.is(c, nodes::Inline) && !scene_.is(c, nodes::X3DBindableNode) &&
             !scene_.is(c, nodes::X3DLightNode) && !has_effect(c);
    };
    known = std::ranges::all_of(below, is_known) ? yes : no;
  }
  return known == yes;
}

namespace {

class PartOfTree {
 public:
  PartOfTree(Scene& scene, const std::vector<StillNode>& nodes, std::span<const std::uint32_t> leaves)
      : scene_(scene), nodes_(nodes), leaves_(leaves) {}

  std::vector<NodeId> run() {
    for (std::size_t i = 0; i < leaves_.size();) {
      const auto top = whole(i);
      put(top, nodes_[top].node);
      i = static_cast<std::size_t>(std::ranges::lower_bound(leaves_, nodes_[top].end) - leaves_.begin());
    }
    // Groups come after those that they are in.
    while (!children_.empty() && children_.rbegin()->first != 0) {
      const auto last = std::prev(children_.end());
      const auto group = last->first;
      const NodeId copy = copy_of(nodes_[group].node, sorted(last->second));
      children_.erase(last);
      put(group, copy);
    }
    return children_.empty() ? std::vector<NodeId>() : sorted(children_.begin()->second);
  }

 private:
  using Children = std::vector<std::pair<std::uint32_t, NodeId>>;  // by where they are in the tree

  void put(std::uint32_t at, NodeId node) { children_[nodes_[at].above].emplace_back(at, node); }

  static std::vector<NodeId> sorted(Children& children) {
    std::ranges::sort(children, {}, &Children::value_type::first);
    std::vector<NodeId> out;
    for (const auto& [at, node] : children) out.push_back(node);
    return out;
  }

  /// The largest that begins with a leaf and is taken whole.
  std::uint32_t whole(std::size_t first) const {
    auto top = leaves_[first];
    for (auto above = nodes_[top].above; above != 0 && is_whole(above, first); above = nodes_[above].above) top = above;
    return top;
  }

  bool is_whole(std::uint32_t group, std::size_t first) const {
    for (auto i = group; i < nodes_[group].end; ++i) {
      if (nodes_[i].kind == StillNode::Kind::group) continue;
      if (first >= leaves_.size() || leaves_[first++] != i) return false;
    }
    return true;
  }

  NodeId copy_of(NodeId group, const std::vector<NodeId>& children) {
    const auto fields = scene_.copy_of_fields(group);
    const NodeId copy = scene_.add(scene_.type_id(group), scene_.where(group));
    scene_.set_fields(copy, fields);
    if (!scene_.name(group).empty()) scene_.set_name(copy, std::string(scene_.name(group)));
    const auto slot = scene_.type(copy).find("children", Dialect::x3d);
    scene_.set(copy, scene_.make(FieldType::MFNode, *slot, children));
    return copy;
  }

  Scene& scene_;
  const std::vector<StillNode>& nodes_;
  std::span<const std::uint32_t> leaves_;
  std::map<std::uint32_t, Children> children_;  // by group
};

}  // namespace

std::vector<NodeId> part_of_tree(Scene& scene, const StillTree& tree, std::span<const std::uint32_t> leaves) {
  return PartOfTree(scene, tree.nodes(), leaves).run();
}

}  // namespace wrlkit
