#include "passes/inline.h"

#include <algorithm>
#include <unordered_map>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

struct Imported {
  std::vector<NodeId> roots;
  std::vector<const Scene*> chain;  // of the files that lead here, this one included
};

class Inliner {
 public:
  Inliner(Scene& scene, const InlineOptions& options, PassContext& ctx) : scene_(scene), options_(options), ctx_(ctx) {}

  Outcome run() {
    auto before = scene_.node_count();
    load_all(all_nodes(scene_), {});
    return scene_.node_count() == before && !changed_ ? Outcome::unchanged : Outcome::changed;
  }

 private:
  // Files already being loaded on the way from the root are cycles; a file met again elsewhere is shared.
  void load_all(const std::vector<NodeId>& nodes, const std::vector<const Scene*>& chain) {
    for (NodeId n : nodes)
      if (scene_.is(n, nodes::Inline)) load(n, chain);
  }

  void load(NodeId n, const std::vector<const Scene*>& chain) {
    auto urls = scene_.get(n, nodes::inline_::url);
    if (urls.empty() || !ctx_.resources) return;
    auto world = ctx_.resources->world(urls, scene_.where(n), ctx_.diag);
    if (!world) return;
    if (world.get() == &scene_ || std::ranges::find(chain, world.get()) != chain.end() || chain.size() >= static_cast<std::size_t>(options_.depth)) {
      ctx_.diag.report(Diag::url_cycle, scene_.where(n), urls[0]);
      return;
    }
    auto known = imported_.find(world.get());
    if (known == imported_.end()) {
      Scope scope = scene_.import(*world);
      scene_.main.protos.insert(scene_.main.protos.end(), scope.protos.begin(), scope.protos.end());
      scene_.main.routes.insert(scene_.main.routes.end(), scope.routes.begin(), scope.routes.end());
      known = imported_.emplace(world.get(), scope.roots).first;
      kept_.push_back(world);
      auto deeper = chain;
      deeper.push_back(world.get());
      load_all(reachable(scene_, scope), deeper);
      known = imported_.find(world.get());
    }
    become_group(n, known->second);
  }

  void become_group(NodeId n, const std::vector<NodeId>& roots) {
    std::vector<Value> fields;
    if (!roots.empty()) fields.push_back(scene_.make(FieldType::MFNode, nodes::group::children.slot, roots));
    for (auto [from, to] : {std::pair{nodes::inline_::bboxCenter.slot, nodes::group::bboxCenter.slot}, {nodes::inline_::bboxSize.slot, nodes::group::bboxSize.slot}})
      if (auto* v = scene_.find(n, from); v && !v->is) {
        fields.push_back(*v);
        fields.back().slot = to;
      }
    scene_.become(n, nodes::Group, fields);
    changed_ = true;
  }

  Scene& scene_;
  const InlineOptions& options_;
  PassContext& ctx_;
  std::unordered_map<const Scene*, std::vector<NodeId>> imported_;
  std::vector<std::shared_ptr<const Scene>> kept_;
  bool changed_ = false;
};

}  // namespace

Outcome inline_worlds(Scene& scene, const InlineOptions& options, PassContext& ctx) { return Inliner(scene, options, ctx).run(); }

}  // namespace wrlkit
