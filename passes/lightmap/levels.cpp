#include "passes/lightmap/levels.h"

#include <algorithm>
#include <unordered_map>

#include "passes/lightmap/copy_node.h"
#include "passes/lightmap/holders.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::bake {

namespace {

/// What some view can show: all levels of a LOD, else what is shown.
std::vector<NodeId> children_of_all_views(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::LOD) ? hierarchy_children(scene, n) : shown_children(scene, n);
}

}  // namespace

bool Levels::next() {
  if (n_views_ > 0 && !choose_unseen()) return false;
  ++n_views_;
  return true;
}

std::size_t Levels::count(Scene& scene) {
  std::size_t n = 0;
  for (Levels levels(scene); levels.next(); ++n) levels.own_what_is_lit();  // nothing is lit: nothing is copied
  return n;
}

/// By node: it holds a Shape that no view has shown and whose turn may come.
std::vector<char> Levels::holders_of_unseen() {
  n_unseen_ = 0;
  return holders(
      scene_,
      [&](NodeId n) {
        return is_shade(n) && !in_shades_ ? shown_children(scene_, n) : children_of_all_views(scene_, n);
      },
      [&](NodeId n) {
        const bool unseen =
            scene_.is(n, nodes::Shape) && scene_.get(n, nodes::shape::geometry) && !seen_.contains(n.value);
        n_unseen_ += unseen;
        return unseen;
      });
}

bool Levels::choose_unseen() {
  auto holds = holders_of_unseen();
  if (!n_unseen_ && !in_shades_) {
    in_shades_ = true;
    depth_ = 0;
    holds = holders_of_unseen();
  }
  if (!n_unseen_ || !saw_more_ || n_views_ == most) return false;
  ++depth_;
  for (std::uint32_t n = 0; n < shown_.size(); ++n)
    if (scene_.is(NodeId{n}, nodes::LOD)) shown_[n] = choose(NodeId{n}, holds);
  return true;
}

std::uint32_t Levels::choose(NodeId lod, const std::vector<char>& holds) const {
  if (is_shade(lod) && !in_shades_) return 0;
  const auto levels = hierarchy_children(scene_, lod);
  const auto at = std::ranges::find_if(levels, [&](NodeId c) { return c && holds[c.value]; });
  if (at != levels.end()) return static_cast<std::uint32_t>(at - levels.begin());
  return in_shades_ || levels.empty() ? 0 : static_cast<std::uint32_t>(levels.size() - 1);
}

void Levels::find_shades(const light::LightWorld& world) {
  constexpr double margin = 0.05, small = 0.2;  // of its box, and of the world's radius
  std::vector<char> around(scene_.node_count());
  const auto& stage = world.stage();
  for (std::size_t u = 0; u < stage.uses.size() && !world.lamps().empty(); ++u) {
    const Box box = world.box_of(static_cast<std::uint32_t>(u));
    if (!(drawing::length(box.size()) < small * world.radius())) continue;
    around[stage.uses[u].shape.value] |= world.holds_lamp(box, margin);
  }
  shades_ = holders(
      scene_, [&](NodeId n) { return shown_children(scene_, n); }, [&](NodeId n) { return around[n.value]; });
}

drawing::LevelOf Levels::level_of() const {
  return [this](NodeId lod, const drawing::Affine&) -> std::size_t {
    return lod.value < shown_.size() ? shown_[lod.value] : 0;
  };
}

void Levels::add(NodeId shape) {
  lit_.insert(shape.value);
  for (NodeId n : {scene_.get(shape, nodes::shape::appearance), scene_.get(shape, nodes::shape::geometry)})
    if (n) taken_.insert(n.value);
}

void Levels::own_what_is_lit() {
  Diagnostics silent;
  std::unordered_map<std::uint32_t, NodeId> copies;
  auto own = [&](NodeId shape, auto field) {
    const NodeId n = scene_.get(shape, field);
    if (!n || !taken_.contains(n.value)) return;
    NodeId& copy = copies[n.value];
    if (!copy) copy = copy_of(scene_, n);
    scene_.set(shape, field, copy);
  };
  const std::size_t before = seen_.size();
  for (const auto& use : drawing::set_stage(scene_, silent, {.level_of = level_of()}).uses) {
    seen_.insert(use.shape.value);
    if (is_lit(use.shape)) continue;
    own(use.shape, nodes::shape::appearance);
    own(use.shape, nodes::shape::geometry);
  }
  saw_more_ = seen_.size() > before;
}

}  // namespace wrlkit::bake
