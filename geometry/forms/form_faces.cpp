#include "geometry/forms/form_faces.h"

#include "geometry/forms/form_node.h"
#include "geometry/geometry.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

void become_faces(Scene& scene, NodeId n) {
  Mesh mesh;
  if (const auto form = read_form(scene, n)) {
    tessellate_form(*form, {}, mesh);
    mesh.convex = !std::holds_alternative<PrismForm>(form->shape);
  } else {
    mesh.kind = Mesh::Kind::faces;
  }
  if (auto solid = scene.type(n).find("solid", Dialect::x3d))
    if (const Value* v = scene.find(n, *solid)) mesh.solid = v->integer != 0;
  store_mesh(scene, n, mesh);
}

}  // namespace

std::optional<Scene> with_form_faces(const Scene& scene) {
  std::optional<Scene> out;
  const auto n = static_cast<std::uint32_t>(scene.node_count());
  for (std::uint32_t i = 0; i < n; ++i) {
    if (!scene.type(NodeId{i}).is_own()) continue;
    if (!out) out = scene;
    become_faces(*out, NodeId{i});
  }
  return out;
}

}  // namespace wrlkit
