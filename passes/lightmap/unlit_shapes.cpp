#include "passes/lightmap/unlit_shapes.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "passes/lightmap/copy_node.h"
#include "scenegraph/driven.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::bake {
namespace {

namespace ap = nodes::appearance;

/// By node: it hangs before the viewer, wherever he goes.
std::vector<char> nodes_before_viewer(const Scene& scene) {
  std::vector<char> found(scene.node_count());
  std::vector<NodeId> open;
  auto take = [&](NodeId n) {
    if (!n || found[n.value]) return;
    found[n.value] = 1;
    open.push_back(n);
  };
  for (NodeId n : all_nodes(scene))
    if (scene.is(n, nodes::Billboard) && scene.get(n, nodes::billboard::axisOfRotation) == Vec3{0, 0, 0}) take(n);
  for (const Route& r : scene.main.routes)
    if (scene.is(r.from, nodes::ProximitySensor) && scene.is(r.to, nodes::Transform)) take(r.to);
  while (!open.empty()) {
    const NodeId n = open.back();
    open.pop_back();
    for (NodeId c : hierarchy_children(scene, n)) take(c);
  }
  return found;
}

}  // namespace

UnlitShapes::UnlitShapes(const Scene& scene, bool wanted)
    : scene_(scene), wanted_(wanted), before_viewer_(nodes_before_viewer(scene)), driven_(driven_geometry(scene)) {}

bool UnlitShapes::is_one(NodeId shape, NodeId appearance) const {
  auto is_driven = [&](NodeId n) { return n.value < driven_.size() && driven_[n.value]; };
  if (shape.value < before_viewer_.size() && before_viewer_[shape.value]) return false;
  if (!appearance) return true;
  if (!scene_.is(appearance, nodes::Appearance) || scene_.get(appearance, ap::material)) return false;
  const NodeId texture = scene_.get(appearance, ap::texture);
  const bool is_picture =
      !texture || scene_.is(texture, nodes::ImageTexture) || scene_.is(texture, nodes::PixelTexture);
  return is_picture && !is_driven(appearance) && !is_driven(texture);
}

UnlitShapes::Found UnlitShapes::find(const light::LightWorld& world) const {
  std::unordered_set<std::uint32_t> shapes;
  NodeId first;
  const auto& uses = world.stage().uses;
  for (std::size_t u = 0; u < uses.size(); ++u)
    if (world.meshes()[world.mesh_of()[u]].kind == Mesh::Kind::faces && is_one(uses[u].shape, uses[u].appearance)) {
      if (shapes.empty()) first = uses[u].shape;
      shapes.insert(uses[u].shape.value);
    }
  return {shapes.size(), first};
}

void UnlitShapes::look_at(const light::LightWorld& world, Diagnostics& diag) {
  if (decided_) return;
  decided_ = true;
  if (!wanted_) return;
  const bool says_unlit = scene_.format == Format::gltf;
  if (says_unlit || !world.has_lamps())
    return report_kept(world, says_unlit ? "glTF says that they are unlit" : "this world has no lamps", diag);
  const Found found = find(world);
  lit_ = found.n > 0;
  if (lit_) diag.report(Diag::unlit_lit, scene_.where(found.first), found.n);
}

void UnlitShapes::report_kept(const light::LightWorld& world, std::string_view why, Diagnostics& diag) const {
  if (const Found found = find(world); found.n > 0)
    diag.report(Diag::unlit_kept, scene_.where(found.first), found.n, why);
}

void UnlitShapes::give_material(Scene& scene, const std::vector<Part>& parts, const drawing::Stage& stage) {
  std::unordered_set<std::uint32_t> mine;
  for (const Part& p : parts)
    for (const std::uint32_t u : p.uses)
      if (is_one(stage.uses[u].shape, stage.uses[u].appearance)) mine.insert(stage.uses[u].shape.value);
  if (mine.empty()) return;
  std::unordered_set<std::uint32_t> others;  // Appearances of
  for (NodeId n : all_nodes(scene))
    if (scene.is(n, nodes::Shape) && !mine.contains(n.value))
      others.insert(scene.get(n, nodes::shape::appearance).value);
  if (!white_) {
    white_ = scene.add(nodes::Material);
    scene.set(white_, nodes::material::diffuseColor, Vec3{1, 1, 1});
  }
  std::unordered_map<std::uint32_t, NodeId> with_material;
  for (const Part& p : parts)
    for (const std::uint32_t u : p.uses) {
      const NodeId shape = stage.uses[u].shape, there = scene.get(shape, nodes::shape::appearance);
      if (!mine.contains(shape.value)) continue;
      NodeId& look = with_material[there.value];
      if (!look) {
        look = !there ? scene.add(nodes::Appearance) : others.contains(there.value) ? copy_of(scene, there) : there;
        scene.set(look, ap::material, white_);
      }
      scene.set(shape, nodes::shape::appearance, look);
    }
}

}  // namespace wrlkit::bake
