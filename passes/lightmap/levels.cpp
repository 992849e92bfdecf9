#include "passes/lightmap/levels.h"

#include <algorithm>
#include <unordered_map>

#include "passes/render/stage.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::bake {

namespace {

/// The child in front goes to place `to`, or comes back from there.
void turn(Scene& scene, NodeId lod, std::size_t to, bool back) {
  const auto all = scene.get(lod, nodes::lod::children);
  std::vector<NodeId> children(all.begin(), all.end());
  const auto first = children.begin(), end = first + static_cast<std::ptrdiff_t>(std::min(to, children.size() - 1)) + 1;
  std::rotate(first, back ? first + 1 : end - 1, end);
  scene.set(lod, nodes::lod::children, children);
}

}  // namespace

Levels::Levels(Scene& scene) : scene_(scene) {
  for (NodeId n : reachable(scene, scene.main)) {
    if (!scene.is(n, nodes::LOD)) continue;
    const std::size_t size = scene.get(n, nodes::lod::children).size();
    if (size < 2) continue;
    lods_.push_back(n);
    count_ = std::max(count_, std::min(size, most));
  }
}

void Levels::show(std::size_t level) {
  if (level == shown_) return;
  for (NodeId n : lods_) {
    if (shown_) turn(scene_, n, shown_, true);
    if (level) turn(scene_, n, level, false);
  }
  shown_ = level;
}

void Levels::add(NodeId shape) {
  lit_.insert(shape.value);
  for (NodeId n : {scene_.get(shape, nodes::shape::appearance), scene_.get(shape, nodes::shape::geometry)})
    if (n) taken_.insert(n.value);
}

void Levels::own_what_is_lit() {
  Diagnostics unheard;
  std::unordered_map<std::uint32_t, NodeId> copies;
  auto own = [&](NodeId shape, auto field) {
    const NodeId n = scene_.get(shape, field);
    if (!n || !taken_.contains(n.value)) return;
    NodeId& copy = copies[n.value];
    if (!copy) {
      copy = scene_.add(scene_.type_id(n), scene_.where(n));
      const std::vector<Value> fields(scene_.fields(n).begin(), scene_.fields(n).end());
      scene_.set_fields(copy, fields);
    }
    scene_.set(shape, field, copy);
  };
  for (const auto& use : drawing::set_stage(scene_, nullptr, unheard).uses) {
    if (is_lit(use.shape)) continue;
    own(use.shape, nodes::shape::appearance);
    own(use.shape, nodes::shape::geometry);
  }
}

}  // namespace wrlkit::bake
