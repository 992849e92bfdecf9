#include "passes/lightmap/own_shapes.h"

#include <algorithm>
#include <string>
#include <unordered_set>

#include "passes/analysis/own_nodes.h"
#include "passes/lightmap/copy_node.h"
#include "passes/lightmap/holders.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::bake {
namespace {

std::vector<NodeId> children_of(const Scene& scene, NodeId n, OfLod of_lod) {
  return of_lod == OfLod::all && scene.is(n, nodes::LOD) ? hierarchy_children(scene, n) : shown_children(scene, n);
}

/// By node: a Shape, or something that holds one.
std::vector<char> holders_of_shapes(const Scene& scene, OfLod of_lod) {
  return holders(
      scene, [&](NodeId n) { return children_of(scene, n, of_lod); },
      [&](NodeId n) { return scene.is(n, nodes::Shape); });
}

class Unsharer {
 public:
  Unsharer(Scene& scene, Diagnostics& diag, OfLod of_lod, std::size_t most)
      : scene_(scene),
        diag_(diag),
        of_lod_(of_lod),
        most_(most),
        holds_(holders_of_shapes(scene, of_lod)),
        met_(scene.node_count()) {
    moving_.mark(scene, scene.main, {}, [](NodeId) { return false; });
    for (NodeId n : all_nodes(scene))
      if (auto name = scene.name(n); !name.empty()) names_.emplace(name);
  }

  std::size_t run() {
    std::vector<NodeId> roots = scene_.main.roots;
    own(roots);
    scene_.main.roots = roots;
    while (!open_.empty() && n_copies_ < most_) {
      NodeId n = open_.back();
      open_.pop_back();
      own_children(n);
    }
    if (n_copies_ >= most_) diag_.report(Diag::expansion_limit, {}, most_, "copies of shared Shapes");
    return n_copies_;
  }

 private:
  /// Puts a copy for each node that was met before. False when nothing changed. The first place in the file keeps the
  /// node.
  bool own(std::vector<NodeId>& ids) {
    bool changed = false;
    const auto mark = static_cast<std::ptrdiff_t>(open_.size());
    for (NodeId& n : ids) {
      if (!n || !is_holder(n)) continue;
      if (!is_met(n)) {
        met_[n.value] = 1;
        open_.push_back(n);
      } else if (!moving_[n]) {
        n = copy(n);
        changed = true;
      }
    }
    std::reverse(open_.begin() + mark, open_.end());
    return changed;
  }

  void own_children(NodeId n) {
    const auto shown = children_of(scene_, n, of_lod_);
    const auto fields = scene_.copy_of_fields(n);
    for (const Value& v : fields) {
      if (scene_.is_extra(v) || v.is || info(v.type).element != Element::node) continue;
      std::vector<NodeId> ids(v.node_span().begin(), v.node_span().end());
      bool is_hierarchy =
          std::ranges::any_of(ids, [&](NodeId c) { return std::ranges::find(shown, c) != shown.end(); });
      if (is_hierarchy && own(ids)) scene_.set(n, scene_.make(v.type, v.slot, ids));
    }
  }

  /// Copies, which have larger numbers than the nodes that were there, hold Shapes as their originals do.
  bool is_met(NodeId n) const { return n.value >= met_.size() || met_[n.value]; }
  bool is_holder(NodeId n) const { return n.value >= holds_.size() || holds_[n.value]; }

  NodeId copy(NodeId n) {
    const NodeId to = copy_of(scene_, n);
    if (auto name = scene_.name(n); !name.empty()) scene_.set_name(to, unique(name));
    ++n_copies_;
    open_.push_back(to);
    return to;
  }

  std::string_view unique(std::string_view name) {
    for (std::size_t i = last_number_[name] ? last_number_[name] : 1;;) {
      auto [at, added] = names_.insert(std::string(name) + "_" + std::to_string(++i));
      if (!added) continue;
      last_number_[name] = i;
      return *at;
    }
  }

  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view s) const { return std::hash<std::string_view>()(s); }
  };

  Scene& scene_;
  Diagnostics& diag_;
  OfLod of_lod_;
  std::size_t most_, n_copies_ = 0;
  std::vector<char> holds_, met_;
  OwnNodes moving_;
  std::vector<NodeId> open_;
  std::unordered_set<std::string, Hash, std::equal_to<>> names_;
  std::unordered_map<std::string_view, std::size_t> last_number_;
};

}  // namespace

std::size_t own_shapes(Scene& scene, Diagnostics& diag, OfLod of_lod, std::size_t most) {
  return Unsharer(scene, diag, of_lod, most).run();
}

}  // namespace wrlkit::bake
