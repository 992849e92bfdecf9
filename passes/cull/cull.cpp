#include "passes/cull/cull.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "base/hashing.h"
#include "base/silent_task.h"
#include "geometry/geometry.h"
#include "light/render/gather.h"
#include "passes/analysis/figures.h"
#include "passes/analysis/text_list.h"
#include "passes/analysis/usage.h"
#include "passes/cull/facing_caps.h"
#include "passes/cull/visibility.h"
#include "scenegraph/looks/material_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

using namespace drawing;

class Culling {
 public:
  Culling(Scene& scene, const CullOptions& options, PassContext& ctx)
      : scene_(scene),
        options_(options),
        ctx_(ctx),
        silent_(ctx),
        usage_(scene),
        stage_(set_stage(scene, silent_.diag)) {}

  Outcome run() {
    const Outcome out = cull();
    hand_in_list();
    return out;
  }

 private:
  Outcome cull() {
    if (silent_.diag.count(Diag::expansion_limit) > 0) {  // what is hidden in all places seen may be visible in others
      ctx_.diag.report(Diag::not_simplified, {}, "by cull: more places than can be looked at");
      return Outcome::unchanged;
    }
    const auto before = figures_of(scene_);
    mesh_of_ = Gatherer(
                   scene_, [this](NodeId n) -> const Mesh& { return triangles(n); }, pool_)
                   .meshes_of(stage_, silent_.diag);
    find_fixed();
    gone_.resize(stage_.uses.size());
    if (options_.smaller.metres > 0) {
      find_small();
      leave_out("cull.small", "smaller than " + options_.smaller.print() + " m");
    }
    if (options_.hidden) {
      find_hidden();
      leave_out("cull.hidden", "hidden");
      open_ends();
    }
    if (left_out_.empty() && n_caps_ == 0) return Outcome::unchanged;
    remove_shapes();
    const auto after = figures_of(scene_);
    if (after.draws == 0 && before.draws > 0)
      ctx_.diag.report(Diag::nothing_shown, {}, "cull has removed all that there was");
    count_figures(ctx_, "cull", before, after);
    return Outcome::changed;
  }

  const Mesh& triangles(NodeId geometry);
  void find_fixed();
  void find_small();
  void join_parts();
  std::uint32_t root(std::uint32_t use);
  double extent(std::uint32_t use, const Box& box) const;
  void find_hidden();
  bool may_be_clear(const Use& use) const;
  void leave_out(const char* counter, const std::string& why);
  void open_ends();
  void remove_shapes();
  void hand_in_list() const;

  Scene& scene_;
  const CullOptions& options_;
  PassContext& ctx_;
  SilentTask silent_;
  Usage usage_;
  Stage stage_;
  MeshPool pool_;
  std::vector<std::uint32_t> mesh_of_;
  Mesh mesh_;
  MeshScratch scratch_;
  std::vector<char> fixed_, moving_;   // by node: stays; may be elsewhere at another time
  std::vector<char> gone_;             // by use
  std::vector<std::uint32_t> part_;    // by use: another one of the same part
  std::vector<char> shape_gone_;       // by node
  std::vector<std::string> left_out_;  // names
  std::size_t n_caps_ = 0;             // that went
};

const Mesh& Culling::triangles(NodeId geometry) {
  mesh_.clear();
  MeshJob job{scene_, geometry, mesh_, scratch_, silent_};
  make_mesh(job, options_.faces);
  return mesh_;
}

void Culling::find_fixed() {
  fixed_.resize(scene_.node_count());
  moving_.resize(scene_.node_count());
  std::vector<std::uint32_t> held(scene_.node_count());
  for (NodeId n : scene_.main.roots)
    if (n) ++held[n.value];
  auto below = [&](NodeId top, std::vector<char>& mark) {
    std::vector<NodeId> open{top};
    while (!open.empty()) {
      const NodeId n = open.back();
      open.pop_back();
      for_each_child(scene_, n, [&](NodeId c) {
        if (!std::exchange(mark[c.value], 1)) open.push_back(c);
      });
    }
  };
  for (NodeId n : all_nodes(scene_)) {
    const NodeType& t = scene_.type(n);
    const bool bound = usage_.touched(n) || std::ranges::any_of(scene_.fields(n), [](const Value& v) { return v.is; });
    if (bound) {
      fixed_[n.value] = 1;
      below(n, moving_);
    }
    if (scene_.is(n, nodes::Billboard)) below(n, moving_);
    if (t.kind != NodeKind::builtin || scene_.is(n, nodes::LOD) || scene_.is(n, nodes::Switch)) below(n, fixed_);
    if (!scene_.is(n, nodes::X3DGroupingNode)) continue;
    for (const Value& v : scene_.fields(n))
      if (!v.is && !scene_.is_extra(v) && v.type == FieldType::MFNode)
        for (NodeId c : v.node_span()) ++held[c.value];
  }
  for (const Use& u : stage_.uses)
    if (held[u.shape.value] != usage_.uses(u.shape) || usage_.touched(u.geometry)) fixed_[u.shape.value] = 1;
}

/// The longest diagonal of a box in a frame.
double Culling::extent(std::uint32_t use, const Box& box) const {
  if (box.empty()) return 0;
  const Affine& frame = stage_.frames[stage_.uses[use].frame];
  double longest = 0;
  for (int k = 0; k < 4; ++k) longest = std::max(longest, length(frame.vector(box.corner(k) - box.corner(7 - k))));
  return longest;
}

std::uint32_t Culling::root(std::uint32_t use) {
  while (part_[use] != use) use = part_[use] = part_[part_[use]];
  return use;
}

/// Shapes without a name of one frame that have a point in common.
void Culling::join_parts() {
  struct Key {
    std::uint32_t frame;
    std::array<double, 3> at;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& k) const {
      std::uint64_t h = k.frame;
      for (double v : k.at) h = mixed(h, std::hash<double>()(v));
      return h;
    }
  };
  std::vector<std::uint32_t> in_frame(stage_.frames.size());
  for (const Use& u : stage_.uses)
    if (scene_.name(u.shape).empty()) ++in_frame[u.frame];
  std::unordered_map<Key, std::uint32_t, Hash> owner;
  for (std::uint32_t u = 0; u < stage_.uses.size(); ++u) {
    const Use& use = stage_.uses[u];
    if (!scene_.name(use.shape).empty() || in_frame[use.frame] < 2) continue;
    const Mesh& m = triangles(use.geometry);
    for (auto c : m.corners) {
      const double* p = m.positions.data() + std::size_t{c} * 3;
      auto [at, fresh] = owner.try_emplace({use.frame, {p[0], p[1], p[2]}}, u);
      if (!fresh) part_[root(u)] = root(at->second);
    }
  }
}

void Culling::find_small() {
  part_.resize(stage_.uses.size());
  for (std::uint32_t u = 0; u < part_.size(); ++u) part_[u] = u;
  auto is_small = [&](std::uint32_t u, const Box& box) { return extent(u, box) < options_.smaller.metres; };
  bool any = false;
  for (std::uint32_t u = 0; u < part_.size(); ++u) any |= is_small(u, pool_[mesh_of_[u]].box);
  if (!any) return;
  join_parts();
  std::vector<Box> boxes(part_.size());
  for (std::uint32_t u = 0; u < part_.size(); ++u) {
    const Box& b = pool_[mesh_of_[u]].box;
    if (!b.empty()) {
      boxes[root(u)].add(b.low);
      boxes[root(u)].add(b.high);
    }
  }
  for (std::uint32_t u = 0; u < part_.size(); ++u)
    gone_[u] = pool_[mesh_of_[u]].n_elements > 0 && is_small(u, boxes[root(u)]);
}

/// Something may be seen through it. Pictures are not looked at.
bool Culling::may_be_clear(const Use& use) const {
  if (!use.appearance) return false;
  if (!scene_.is(use.appearance, nodes::Appearance) || scene_.get(use.appearance, nodes::appearance::texture))
    return true;
  const NodeId n = scene_.get(use.appearance, nodes::appearance::material);
  const auto material = read_material(scene_, n);
  return n && (!material || material->color_picture || material->transparency > 0);
}

void Culling::find_hidden() {
  std::vector<char> clear, wanted;
  for (std::size_t u = 0; u < stage_.uses.size(); ++u) {
    const Use& use = stage_.uses[u];
    clear.push_back(may_be_clear(use) || moving_[use.shape.value] || pool_[mesh_of_[u]].color_width == 4);
    wanted.push_back(!gone_[u] && !fixed_[use.shape.value] && !moving_[use.shape.value]);
  }
  std::vector<V3> eyes;
  for (const Placed& p : stage_.viewpoints)
    eyes.push_back(stage_.frames[p.frame].point(scene_.get(p.node, nodes::viewpoint::position)));
  gone_ = hidden_uses(stage_, pool_, mesh_of_, eyes,
                      {options_.walkways, options_.rays, static_cast<std::uint64_t>(options_.seed), clear, wanted},
                      ctx_.diag);
}

/// Shapes of which every place is gone.
void Culling::leave_out(const char* counter, const std::string& why) {
  shape_gone_.resize(scene_.node_count());
  TextList names;
  std::vector<char> stays(scene_.node_count());
  for (std::size_t u = 0; u < gone_.size(); ++u)
    if (!gone_[u]) stays[stage_.uses[u].shape.value] = 1;
  for (std::size_t u = 0; u < gone_.size(); ++u) {
    const Use& use = stage_.uses[u];
    if (!gone_[u] || stays[use.shape.value] || fixed_[use.shape.value] || moving_[use.shape.value]) continue;
    ctx_.stats["cull.triangles"] += pool_[mesh_of_[u]].n_elements;
    if (std::exchange(shape_gone_[use.shape.value], 1)) continue;
    ++ctx_.stats[counter];
    left_out_.push_back(full_name(scene_, stage_, use));
    names.add(left_out_.back().empty() ? "(no name)" : left_out_.back());
  }
  if (!names.empty()) ctx_.diag.report(Diag::culled, {}, names.count(), why, names.text());
}

/// Pipes that end at one another need no caps there.
void Culling::open_ends() {
  std::vector<char> clear(scene_.node_count());
  for (const Use& use : stage_.uses) clear[use.shape.value] |= may_be_clear(use);
  const auto dropped = drop_facing_caps(scene_, [&](NodeId n) {
    return !fixed_[n.value] && !moving_[n.value] && !clear[n.value] && !shape_gone_[n.value];
  });
  n_caps_ = dropped.caps;
  if (n_caps_ == 0) return;
  ctx_.stats["cull.caps"] += n_caps_;
  ctx_.stats["cull.triangles"] += dropped.triangles;
}

void Culling::remove_shapes() {
  auto is_gone = [&](NodeId n) { return n && shape_gone_[n.value]; };
  for (NodeId n : all_nodes(scene_)) {
    if (!scene_.is(n, nodes::X3DGroupingNode)) continue;
    for (const Value& v : scene_.copy_of_fields(n)) {
      if (v.type != FieldType::MFNode || v.is || scene_.is_extra(v)) continue;
      std::vector<NodeId> list(v.node_span().begin(), v.node_span().end());
      if (std::erase_if(list, is_gone) > 0) scene_.set(n, scene_.make(FieldType::MFNode, v.slot, list));
    }
  }
  std::erase_if(scene_.main.roots, is_gone);
}

void Culling::hand_in_list() const {
  if (options_.list.path.empty() || !ctx_.resources) return;
  std::string out;
  for (const auto& name : left_out_) out += name + '\n';
  ctx_.resources->add_named({options_.list.path, std::move(out)});
}

}  // namespace

Outcome cull(Scene& scene, const CullOptions& options, PassContext& ctx) { return Culling(scene, options, ctx).run(); }

}  // namespace wrlkit
