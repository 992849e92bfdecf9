#include "scenegraph/looks/material_node.h"

#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

MaterialNode read_phong(const Scene& scene, NodeId n) {
  namespace f = nodes::material;
  MaterialNode to;
  to.color = scene.get(n, f::diffuseColor);
  to.emissive = scene.get(n, f::emissiveColor);
  to.specular = scene.get(n, f::specularColor);
  to.ambient_intensity = scene.get(n, f::ambientIntensity);
  to.shininess = scene.get(n, f::shininess);
  to.transparency = scene.get(n, f::transparency);
  to.normal_scale = scene.get(n, f::normalScale);
  to.occlusion_strength = scene.get(n, f::occlusionStrength);
  to.color_picture = scene.get(n, f::diffuseTexture);
  to.emissive_picture = scene.get(n, f::emissiveTexture);
  to.normal_picture = scene.get(n, f::normalTexture);
  to.occlusion_picture = scene.get(n, f::occlusionTexture);
  to.color_picture_slot = f::diffuseTexture.slot;
  return to;
}

MaterialNode read_physical(const Scene& scene, NodeId n) {
  namespace f = nodes::physical_material;
  MaterialNode to;
  to.kind = MaterialNode::Kind::physical;
  to.color = scene.get(n, f::baseColor);
  to.emissive = scene.get(n, f::emissiveColor);
  to.metallic = scene.get(n, f::metallic);
  to.roughness = scene.get(n, f::roughness);
  to.transparency = scene.get(n, f::transparency);
  to.normal_scale = scene.get(n, f::normalScale);
  to.occlusion_strength = scene.get(n, f::occlusionStrength);
  to.color_picture = scene.get(n, f::baseTexture);
  to.emissive_picture = scene.get(n, f::emissiveTexture);
  to.normal_picture = scene.get(n, f::normalTexture);
  to.occlusion_picture = scene.get(n, f::occlusionTexture);
  to.metallic_roughness_picture = scene.get(n, f::metallicRoughnessTexture);
  to.color_picture_slot = f::baseTexture.slot;
  return to;
}

MaterialNode read_unlit(const Scene& scene, NodeId n) {
  namespace f = nodes::unlit_material;
  MaterialNode to;
  to.kind = MaterialNode::Kind::unlit;
  to.color = scene.get(n, f::emissiveColor);
  to.emissive = to.color;
  to.transparency = scene.get(n, f::transparency);
  to.normal_scale = scene.get(n, f::normalScale);
  to.color_picture = scene.get(n, f::emissiveTexture);
  to.normal_picture = scene.get(n, f::normalTexture);
  to.color_picture_slot = f::emissiveTexture.slot;
  return to;
}

}  // namespace

std::optional<MaterialNode> read_material(const Scene& scene, NodeId n) {
  if (scene.is(n, nodes::Material)) return read_phong(scene, n);
  if (scene.is(n, nodes::PhysicalMaterial)) return read_physical(scene, n);
  if (scene.is(n, nodes::UnlitMaterial)) return read_unlit(scene, n);
  return {};
}

std::optional<MaterialNode> material_of(const Scene& scene, NodeId appearance) {
  if (!scene.is(appearance, nodes::Appearance)) return {};
  return read_material(scene, scene.get(appearance, nodes::appearance::material));
}

}  // namespace wrlkit
