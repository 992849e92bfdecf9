#include "passes/lower_x3d/appearance.h"

#include <algorithm>

#include "passes/lower_x3d/geometry.h"
#include "passes/lower_x3d/two_sides.h"
#include "scenegraph/equal.h"
#include "scenegraph/looks/material_node.h"
#include "scenegraph/nodes.h"

namespace wrlkit::x3d {
namespace {

bool one_side(Scene& scene, NodeId n, Diagnostics& diag) {
  if (!scene.is(n, nodes::TwoSidedMaterial)) return false;
  if (back_differs(scene, n)) diag.report(Diag::no_back_material, scene.where(n), "the back of TwoSidedMaterial");
  scene.become(n, nodes::Material, fields_for(scene, n, nodes::Material));
  return true;
}

struct Multiple {
  TypeId type;
  std::uint16_t list;
};
constexpr Multiple multiples[] = {
    {nodes::MultiTexture, nodes::multi_texture::texture.slot},
    {nodes::MultiTextureCoordinate, nodes::multi_texture_coordinate::texCoord.slot},
    {nodes::MultiTextureTransform, nodes::multi_texture_transform::textureTransform.slot},
};

/// What stands for the child of a field: the first of several.
NodeId first_of(const Scene& scene, NodeId n, Diagnostics& diag) {
  for (int depth = 0; n && depth < 8; ++depth) {
    const Multiple* m = nullptr;
    for (const auto& row : multiples)
      if (scene.is(n, row.type)) m = &row;
    if (!m) return n;
    const auto all = scene.value(n, m->list).node_span();
    if (scene.is(n, nodes::MultiTexture) && all.size() > 1) diag.report(Diag::only_first_texture, scene.where(n));
    n = all.empty() ? NodeId{} : all[0];
  }
  return n;
}

bool holds_multiple(const Scene& scene, NodeId n) {
  const auto is_multiple = [&](NodeId held) {
    return std::ranges::any_of(multiples, [&](const Multiple& row) { return scene.is(held, row.type); });
  };
  return std::ranges::any_of(scene.fields(n), [&](const Value& v) {
    return v.type == FieldType::SFNode && !v.is && !scene.is_extra(v) && is_multiple(v.node);
  });
}

bool first_only(Scene& scene, NodeId n, Diagnostics& diag) {
  if (!holds_multiple(scene, n)) return false;
  bool changed = false;
  const auto& rows = scene.type(n).fields;
  for (const Value& v : scene.copy_of_fields(n)) {
    if (scene.is_extra(v) || v.is || v.type != FieldType::SFNode || !v.node || !rows[v.slot].has_value()) continue;
    NodeId first = first_of(scene, v.node, diag);
    if (first == v.node) continue;
    scene.set(n, scene.make(FieldType::SFNode, v.slot, first));
    changed = true;
  }
  return changed;
}

bool take_picture(Scene& scene, NodeId n, Diagnostics& diag) {
  namespace a = nodes::appearance;
  if (!scene.is(n, nodes::Appearance)) return false;
  bool changed = false;
  if (scene.get(n, a::backMaterial)) {
    if (scene.get(n, a::backMaterial) != scene.get(n, a::material))
      diag.report(Diag::no_back_material, scene.where(n), "Appearance.backMaterial");
    scene.unset(n, a::backMaterial.slot);
    changed = true;
  }
  const auto material = material_of(scene, n);
  const NodeId picture = material ? first_of(scene, material->color_picture, diag) : NodeId{};
  if (!picture || scene.get(n, a::texture)) return changed;
  scene.set(n, a::texture, picture);
  return true;
}

}  // namespace

bool lower_appearance(Scene& scene, NodeId n, Diagnostics& diag) {
  const bool side = one_side(scene, n, diag), first = first_only(scene, n, diag);
  return take_picture(scene, n, diag) || side || first;
}

}  // namespace wrlkit::x3d
