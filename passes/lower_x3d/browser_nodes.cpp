#include "passes/lower_x3d/browser_nodes.h"

#include <algorithm>

#include "passes/lower_x3d/foreign_fields.h"
#include "scenegraph/decompose.h"
#include "scenegraph/nodes.h"

namespace wrlkit::x3d {
namespace {

bool is_called(const Scene& scene, NodeId n, std::string_view name) {
  return n && scene.type(n).kind == NodeKind::unknown && scene.type(n).name == name;
}

bool lower_matrix_transform(Scene& scene, NodeId n) {
  namespace t = nodes::transform;
  if (!is_called(scene, n, "MatrixTransform")) return false;
  std::vector<NodeId> children;
  if (const Value* v = ForeignFields(scene, n).value("children")) {
    const auto held = v->node_span();
    children.assign(held.begin(), held.end());
  }
  const auto m = ForeignFields(scene, n).numbers("matrix");
  scene.become(n, nodes::Transform, {});
  if (!children.empty()) scene.set(n, t::children, children);
  if (m.size() < 16) return true;
  const TransformFields fields = decompose(matrix_of_columns(m.data())), none;  // rows of vectors that are rows
  if (fields.translation != none.translation) scene.set(n, t::translation, fields.translation);
  if (fields.rotation != none.rotation) scene.set(n, t::rotation, fields.rotation);
  if (fields.scale != none.scale) scene.set(n, t::scale, fields.scale);
  if (fields.scale_orientation != none.scale_orientation) scene.set(n, t::scaleOrientation, fields.scale_orientation);
  return true;
}

/// The picture in a field of a shader: X3DOM may put a SurfaceShaderTexture around it.
NodeId picture(const Scene& scene, NodeId shader, std::string_view field) {
  const Value* v = ForeignFields(scene, shader).value(field);
  const auto held = v ? v->node_span() : std::span<const NodeId>{};
  NodeId n = held.empty() ? NodeId{} : held[0];
  if (is_called(scene, n, "SurfaceShaderTexture")) {
    const Value* inner = ForeignFields(scene, n).value("texture");
    const auto inside = inner ? inner->node_span() : std::span<const NodeId>{};
    n = inside.empty() ? NodeId{} : inside[0];
  }
  return scene.is(n, nodes::X3DTextureNode) ? n : NodeId{};
}

NodeId material_of_shader(Scene& scene, NodeId shader) {
  namespace m = nodes::material;
  const NodeId out = scene.add(nodes::Material, scene.where(shader));
  scene.set_name(out, scene.name(shader));
  const auto color = [&](std::string_view name, auto key) {
    const auto c = ForeignFields(scene, shader).numbers(name);
    if (c.size() >= 3) scene.set(out, key, Vec3{c[0], c[1], c[2]});
  };
  color("diffuseFactor", m::diffuseColor);
  color("emissiveFactor", m::emissiveColor);
  color("specularFactor", m::specularColor);
  if (const auto s = ForeignFields(scene, shader).numbers("shininessFactor"); !s.empty())
    scene.set(out, m::shininess, s[0]);
  if (const auto a = ForeignFields(scene, shader).numbers("alphaFactor"); !a.empty())
    scene.set(out, m::transparency, std::clamp(1 - a[0], 0.0, 1.0));
  const auto take = [&](std::string_view name, auto key) {
    if (const NodeId p = picture(scene, shader, name)) scene.set(out, key, p);
  };
  take("multiDiffuseAlphaTexture", m::diffuseTexture);
  take("diffuseTexture", m::diffuseTexture);
  take("emissiveTexture", m::emissiveTexture);
  take("specularTexture", m::specularTexture);
  take("normalTexture", m::normalTexture);
  return out;
}

bool lower_shader(Scene& scene, NodeId n) {
  namespace a = nodes::appearance;
  if (!scene.is(n, nodes::Appearance)) return false;
  const auto held = scene.get(n, a::shaders);
  std::vector<NodeId> others(held.begin(), held.end());
  const auto is_common = [&](NodeId s) { return is_called(scene, s, "CommonSurfaceShader"); };
  const auto common = std::ranges::find_if(others, is_common);
  if (common == others.end()) return false;
  const NodeId material = material_of_shader(scene, *common);
  std::erase_if(others, is_common);
  if (others.empty())
    scene.unset(n, a::shaders.slot);
  else
    scene.set(n, a::shaders, others);
  scene.set(n, a::material, material);
  return true;
}

}  // namespace

bool lower_browser_node(Scene& scene, NodeId n) { return lower_matrix_transform(scene, n) || lower_shader(scene, n); }

}  // namespace wrlkit::x3d
