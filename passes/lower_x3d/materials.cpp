#include "passes/lower_x3d/materials.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "passes/lower_x3d/geometry.h"
#include "scenegraph/looks/material_node.h"
#include "scenegraph/looks/shininess.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

class MaterialLowering {
 public:
  MaterialLowering(Scene& scene, bool vrml97, Diagnostics& diag) : scene_(scene), vrml97_(vrml97), diag_(diag) {}

  bool run() {
    for (NodeId n : all_nodes(scene_)) note_colors(n);
    for (NodeId n : all_nodes(scene_)) unlit_is_none(n);
    for (NodeId n : all_nodes(scene_)) {
      material(n);
      viewpoint(n);
    }
    return changed_;
  }

 private:
  /// Appearances of only geometry that has its own colours: without a Material these are unlit.
  void note_colors(NodeId shape) {
    if (!scene_.is(shape, nodes::Shape)) return;
    NodeId appearance = scene_.get(shape, nodes::shape::appearance),
           geometry = scene_.get(shape, nodes::shape::geometry);
    if (!appearance || !geometry) return;
    auto slot = scene_.type(geometry).find("color", Dialect::x3d);
    const Value* v = slot ? scene_.find(geometry, *slot) : nullptr;
    const bool colored = v && !v->is && v->type == FieldType::SFNode && v->node;
    auto [known, fresh] = colored_.emplace(appearance.value, colored);
    if (!fresh) known->second &= colored;
  }

  void material(NodeId n) {
    if (scene_.is(n, nodes::PhysicalMaterial)) physical(n);
    if (scene_.is(n, nodes::UnlitMaterial) && !kept_.contains(n.value)) unlit(n);
  }

  void physical(NodeId n) {
    namespace m = nodes::material;
    const MaterialNode said = *read_material(scene_, n);
    const Vec3& base = said.color;
    const double metal = said.metallic, rough = said.roughness;
    Vec3 diffuse, specular;
    for (std::size_t i = 0; i < 3; ++i) {
      diffuse[i] = base[i] * (1 - metal / 2);
      specular[i] = (0.04 * (1 - metal) + base[i] * metal) * (1 - rough);
    }
    auto fields = fields_for(scene_, n, nodes::Material);
    const double shininess = rough > 0 ? std::clamp(shininess_of_width(std::pow(rough, 4)), 0.0, 1.0) : 1;
    fields.push_back(scene_.make(FieldType::SFColor, m::diffuseColor.slot, diffuse));
    fields.push_back(scene_.make(FieldType::SFColor, m::specularColor.slot, specular));
    fields.push_back(scene_.make(FieldType::SFFloat, m::shininess.slot, shininess));
    if (said.color_picture)
      fields.push_back(scene_.make(FieldType::SFNode, m::diffuseTexture.slot, said.color_picture));
    become(n, nodes::Material, fields);
  }

  void unlit(NodeId n) {
    namespace m = nodes::material;
    auto fields = fields_for(scene_, n, nodes::Material);
    const Vec3 emissive = scene_.get(n, nodes::unlit_material::emissiveColor);
    std::erase_if(fields, [&](const Value& v) { return v.slot == m::emissiveColor.slot; });
    fields.push_back(scene_.make(FieldType::SFColor, m::emissiveColor.slot, emissive));
    fields.push_back(scene_.make(FieldType::SFColor, m::diffuseColor.slot, Vec3{0, 0, 0}));
    fields.push_back(scene_.make(FieldType::SFFloat, m::ambientIntensity.slot, 0.0));
    become(n, nodes::Material, fields);
  }

  /// A white one, and one that a picture takes the place of, is none (14772-1, 4.14.2).
  void unlit_is_none(NodeId appearance) {
    if (!scene_.is(appearance, nodes::Appearance)) return;
    namespace u = nodes::unlit_material;
    NodeId n = scene_.get(appearance, nodes::appearance::material);
    auto known = colored_.find(appearance.value);
    const bool pictured = scene_.is(n, nodes::UnlitMaterial) && scene_.get(appearance, nodes::appearance::texture);
    if (pictured && !vrml97_) kept_.insert(n.value);
    const bool white = (pictured && vrml97_) || (known != colored_.end() && known->second) ||
                       (scene_.is(n, nodes::UnlitMaterial) && scene_.get(n, u::emissiveColor) == Vec3{1, 1, 1});
    if (!scene_.is(n, nodes::UnlitMaterial) || !white || scene_.get(n, u::transparency) != 0) return;
    scene_.unset(appearance, nodes::appearance::material.slot);
    changed_ = true;
  }

  void become(NodeId n, TypeId type, const std::vector<Value>& fields) {
    diag_.report(Diag::no_vrml97_material, scene_.where(n), scene_.type(n).name);
    scene_.become(n, type, fields);
    changed_ = true;
  }

  void viewpoint(NodeId n) {
    if (!scene_.is(n, nodes::OrthoViewpoint)) return;
    namespace o = nodes::ortho_viewpoint;
    const auto p = scene_.get(n, o::position), c = scene_.get(n, o::centerOfRotation);
    const auto window = scene_.get(n, o::fieldOfView);
    const double height = window.size() >= 4 ? window[3] - window[1] : 2,
                 distance = std::hypot(p[0] - c[0], p[1] - c[1], p[2] - c[2]);
    auto fields = fields_for(scene_, n, nodes::Viewpoint);
    const double angle = distance > 0 ? 2 * std::atan(std::abs(height) / 2 / distance) : 0.785398;
    fields.push_back(scene_.make(FieldType::SFFloat, nodes::viewpoint::fieldOfView.slot, angle));
    diag_.report(Diag::no_vrml97_value, scene_.where(n), "OrthoViewpoint", "fieldOfView");
    scene_.become(n, nodes::Viewpoint, fields);
    changed_ = true;
  }

  Scene& scene_;
  bool vrml97_;
  Diagnostics& diag_;
  std::unordered_map<std::uint32_t, bool> colored_;  // by appearance
  std::unordered_set<std::uint32_t> kept_;           // materials
  bool changed_ = false;
};

}  // namespace

bool lower_materials(Scene& scene, bool vrml97, Diagnostics& diag) {
  return MaterialLowering(scene, vrml97, diag).run();
}

}  // namespace wrlkit::x3d
