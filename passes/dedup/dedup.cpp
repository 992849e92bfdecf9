#include "passes/dedup/dedup.h"

#include "passes/analysis/figures.h"
#include "passes/analysis/representatives.h"
#include "passes/analysis/text_list.h"
#include "scenegraph/declared_protos.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

const char* kind_of(const NodeType& t) {
  if (t.is_a(nodes::X3DAppearanceNode)) return "dedup.appearances";
  if (t.is_a(nodes::X3DMaterialNode)) return "dedup.materials";
  if (t.is_a(nodes::X3DTextureNode)) return "dedup.textures";
  if (t.is_a(nodes::X3DGeometryNode)) return "dedup.geometries";
  return t.is_a(nodes::X3DGeometricPropertyNode) ? "dedup.arrays" : "dedup.others";
}

class Sharing {
 public:
  Sharing(Scene& scene, const DedupOptions& options, PassContext& ctx)
      : scene_(scene), options_(options), ctx_(ctx), usage_(scene) {}

  Outcome run() {
    const auto before = figures_of(scene_);
    std::vector<char> seen;
    share(scene_.main, seen);
    for (ProtoId p : declared_protos(scene_)) share(scene_.proto(p).body, seen);
    if (!any_) return Outcome::unchanged;
    if (!lost_.empty()) ctx_.diag.report(Diag::names_lost, {}, "dedup", lost_.count(), lost_.text());
    count_figures(ctx_, "dedup", before, figures_of(scene_));
    return Outcome::changed;
  }

 private:
  void share(const Scope& scope, std::vector<char>& seen) {
    std::vector<NodeId> nodes;
    reach(scene_, scope.roots, seen, nodes);
    const Representatives same(scene_, usage_, nodes, options_.named);
    for (NodeId n : nodes) replace_children(n, same);
    for (NodeId n : nodes) {
      if (n.value >= replaced_.size() || !replaced_[n.value]) continue;
      any_ = true;
      ++ctx_.stats[kind_of(scene_.type(n))];
      if (const auto name = scene_.name(n); !name.empty() && name != scene_.name(same.of(n))) lost_.add(name);
    }
  }

  void replace_children(NodeId n, const Representatives& same) {
    for (const Value v : scene_.copy_of_fields(n)) {
      if (scene_.is_extra(v) || v.is || info(v.type).element != Element::node) continue;
      std::vector<NodeId> list(v.node_span().begin(), v.node_span().end());
      bool changed = false;
      for (NodeId& c : list) {
        const NodeId one = same.of(c);
        if (one == c) continue;
        if (replaced_.size() <= c.value) replaced_.resize(scene_.node_count());
        replaced_[c.value] = 1;
        changed = true;
        c = one;
      }
      if (changed)
        scene_.set(n, info(v.type).multiple ? scene_.make(v.type, v.slot, list) : scene_.make(v.type, v.slot, list[0]));
    }
  }

  Scene& scene_;
  const DedupOptions& options_;
  PassContext& ctx_;
  Usage usage_;
  TextList lost_;
  std::vector<char> replaced_;  // by node: another one stands where it stood
  bool any_ = false;
};

}  // namespace

Outcome dedup(Scene& scene, const DedupOptions& options, PassContext& ctx) {
  return Sharing(scene, options, ctx).run();
}

}  // namespace wrlkit
