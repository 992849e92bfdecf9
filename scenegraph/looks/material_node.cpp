#include "scenegraph/looks/material_node.h"

#include "base/image/srgb.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

using Float = FieldKey<FieldType::SFFloat>;
using Color = FieldKey<FieldType::SFColor>;
using Picture = FieldKey<FieldType::SFNode>;

/// What all three have.
MaterialNode read_common(const Scene& scene, NodeId n, Color color, Picture color_picture, Color emissive,
                         Float transparency, Float normal_scale, Picture normal_picture) {
  MaterialNode to;
  to.color = scene.get(n, color);
  to.color_picture = scene.get(n, color_picture);
  to.color_picture_slot = color_picture.slot;
  to.emissive = scene.get(n, emissive);
  to.transparency = scene.get(n, transparency);
  to.normal_scale = scene.get(n, normal_scale);
  to.normal_picture = scene.get(n, normal_picture);
  return to;
}

/// What Material and PhysicalMaterial have in addition.
void read_lit(const Scene& scene, NodeId n, MaterialNode& to, Picture emissive, Float occlusion_strength,
              Picture occlusion) {
  to.emissive_picture = scene.get(n, emissive);
  to.occlusion_strength = scene.get(n, occlusion_strength);
  to.occlusion_picture = scene.get(n, occlusion);
}

MaterialNode read_phong(const Scene& scene, NodeId n) {
  namespace f = nodes::material;
  MaterialNode to = read_common(scene, n, f::diffuseColor, f::diffuseTexture, f::emissiveColor, f::transparency,
                                f::normalScale, f::normalTexture);
  read_lit(scene, n, to, f::emissiveTexture, f::occlusionStrength, f::occlusionTexture);
  to.specular = scene.get(n, f::specularColor);
  to.ambient_intensity = scene.get(n, f::ambientIntensity);
  to.shininess = scene.get(n, f::shininess);
  return to;
}

/// As displayed: X3D takes the numbers of a PhysicalMaterial from glTF, where they are linear.
Vec3 displayed(Vec3 linear) {
  for (double& v : linear)
    if (v > 0) v = linear_to_srgb(v);
  return linear;
}

MaterialNode read_physical(const Scene& scene, NodeId n) {
  namespace f = nodes::physical_material;
  MaterialNode to = read_common(scene, n, f::baseColor, f::baseTexture, f::emissiveColor, f::transparency,
                                f::normalScale, f::normalTexture);
  read_lit(scene, n, to, f::emissiveTexture, f::occlusionStrength, f::occlusionTexture);
  to.color = displayed(to.color);
  to.emissive = displayed(to.emissive);
  to.kind = MaterialNode::Kind::physical;
  to.metallic = scene.get(n, f::metallic);
  to.roughness = scene.get(n, f::roughness);
  to.metallic_roughness_picture = scene.get(n, f::metallicRoughnessTexture);
  return to;
}

MaterialNode read_unlit(const Scene& scene, NodeId n) {
  namespace f = nodes::unlit_material;
  MaterialNode to = read_common(scene, n, f::emissiveColor, f::emissiveTexture, f::emissiveColor, f::transparency,
                                f::normalScale, f::normalTexture);
  to.kind = MaterialNode::Kind::unlit;
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
