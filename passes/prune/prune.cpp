#include "passes/prune/prune.h"

#include <algorithm>

#include "scenegraph/dangling_links.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scopes.h"
#include "scenegraph/tags.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

class Pruning {
 public:
  explicit Pruning(Scene& scene) : scene_(scene), order_(all_nodes(scene)), kept_(scene.node_count(), 0) {}

  Outcome run() {
    for_each_scope(scene_, [&](const Scope& s) {
      for (auto& r : s.routes) kept_[r.from.value] = kept_[r.to.value] = 1;
      for (auto& e : s.exports) kept_[e.node.value] = 1;
    });
    keep_libraries();
    // Children first, so that a group of empty groups goes as a whole.
    for (auto n = order_.rbegin(); n != order_.rend(); ++n) prune_children(*n);
    auto before = scene_.main.roots.size();
    std::erase_if(scene_.main.roots, [&](NodeId n) { return useless(n); });
    changed_ |= before != scene_.main.roots.size();
    changed_ |= drop_dangling_links(scene_).any;
    return changed_ ? Outcome::changed : Outcome::unchanged;
  }

 private:
  bool shows_nothing(NodeId n) const { return scene_.is(n, nodes::Shape) && !scene_.get(n, nodes::shape::geometry); }

  /// Exporters define their materials in Shapes without geometry: those with names or tags that nothing else holds.
  void keep_libraries() {
    std::vector<NodeId> empty;
    std::ranges::copy_if(order_, std::back_inserter(empty), [&](NodeId n) { return shows_nothing(n); });
    if (empty.empty()) return;
    std::vector<char> seen(scene_.node_count());
    for (NodeId n : empty) seen[n.value] = 1;
    std::vector<NodeId> elsewhere;
    for_each_scope(scene_, [&](const Scope& s) { reach(scene_, s.roots, seen, elsewhere); });
    for (NodeId n : empty) {
      std::vector<NodeId> held, below;
      for_each_child(scene_, n, [&](NodeId c) { held.push_back(c); });
      reach(scene_, held, seen, below);
      const auto says = [&](NodeId c) { return !scene_.name(c).empty() || has_tags(scene_, c); };
      if (std::ranges::any_of(below, says)) kept_[n.value] = 1;
    }
  }

  bool useless(NodeId n) const {
    if (!n || kept_[n.value] || !scene_.name(n).empty()) return false;
    for (auto& v : scene_.fields(n))
      if (scene_.content(v).is || is_tag(scene_, n, v)) return false;
    if (scene_.is(n, nodes::Shape)) return shows_nothing(n);
    if (scene_.is(n, nodes::Collision) && scene_.get(n, nodes::collision::proxy))
      return false;  // not seen, but in the way
    return is_group(n) && hierarchy_children(scene_, n).empty();
  }

  bool is_group(NodeId n) const {
    constexpr TypeId groups[] = {nodes::Anchor, nodes::Billboard, nodes::Collision, nodes::Group,
                                 nodes::LOD,    nodes::Switch,    nodes::Transform};
    return std::ranges::find(groups, scene_.type_id(n)) != std::end(groups);
  }

  bool is_list(const Value& v) const { return !scene_.is_extra(v) && !v.is && v.type == FieldType::MFNode; }

  void prune_children(NodeId n) {
    const auto& t = scene_.type(n);
    if (t.kind != NodeKind::builtin || scene_.is(n, nodes::Switch) || scene_.is(n, nodes::LOD)) return;
    const auto has_useless = [&](const Value& v) {
      return is_list(v) && std::ranges::any_of(v.node_span(), [&](NodeId c) { return useless(c); });
    };
    if (std::ranges::none_of(scene_.fields(n), has_useless)) return;
    auto fields = scene_.copy_of_fields(n);
    bool any = false;
    for (auto& v : fields) {
      if (!is_list(v)) continue;
      std::vector<NodeId> left;
      std::ranges::copy_if(v.node_span(), std::back_inserter(left), [&](NodeId c) { return !useless(c); });
      if (left.size() == v.count) continue;
      v = scene_.make(FieldType::MFNode, v.slot, left);
      any = true;
    }
    if (any) {
      scene_.set_fields(n, fields);
      changed_ = true;
    }
  }

  Scene& scene_;
  std::vector<NodeId> order_;
  std::vector<char> kept_;
  bool changed_ = false;
};

}  // namespace

Outcome prune(Scene& scene, const PruneOptions&, PassContext&) { return Pruning(scene).run(); }

}  // namespace wrlkit
