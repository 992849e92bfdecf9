#include "passes/lower_x3d/two_sides.h"

#include "passes/lower_x3d/geometry.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scopes.h"

namespace wrlkit::x3d {
namespace {

namespace two = nodes::two_sided_material;
namespace one = nodes::material;
namespace faces = nodes::indexed_face_set;

NodeId front_of(Scene& scene, NodeId n) {
  const NodeId out = scene.add(nodes::Material, scene.where(n));
  scene.set_name(out, scene.name(n));
  scene.set_fields(out, fields_for(scene, n, nodes::Material));
  return out;
}

NodeId back_of(Scene& scene, NodeId n) {
  const NodeId out = scene.add(nodes::Material, scene.where(n));
  scene.set(out, one::diffuseColor, scene.get(n, two::backDiffuseColor), one::emissiveColor,
            scene.get(n, two::backEmissiveColor), one::specularColor, scene.get(n, two::backSpecularColor));
  scene.set(out, one::ambientIntensity, scene.get(n, two::backAmbientIntensity), one::shininess,
            scene.get(n, two::backShininess), one::transparency, scene.get(n, two::backTransparency));
  return out;
}

NodeId copy_of(Scene& scene, NodeId n) {
  const NodeId out = scene.add(scene.type_id(n), scene.where(n));
  const auto fields = scene.copy_of_fields(n);
  scene.set_fields(out, fields);
  return out;
}

/// The same faces seen from the other side, with normals that point there.
NodeId turned(Scene& scene, NodeId geometry) {
  const NodeId out = copy_of(scene, geometry);
  scene.set(out, faces::ccw, !scene.get(geometry, faces::ccw));
  const NodeId normal = scene.get(geometry, faces::normal);
  if (!normal) return out;
  std::vector<double> vectors;
  for (const double v : scene.get(normal, nodes::normal::vector)) vectors.push_back(-v);
  const NodeId back = scene.add(nodes::Normal, scene.where(normal));
  scene.set(back, nodes::normal::vector, vectors);
  scene.set(out, faces::normal, back);
  return out;
}

struct Sides {
  NodeId front, back;
};

/// The materials of both sides; none where they are the same.
Sides sides_of(Scene& scene, NodeId appearance) {
  namespace a = nodes::appearance;
  const NodeId material = scene.get(appearance, a::material), back = scene.get(appearance, a::backMaterial);
  if (scene.is(material, nodes::TwoSidedMaterial) && back_differs(scene, material))
    return {front_of(scene, material), back_of(scene, material)};
  if (back && back != material && !scene.is(material, nodes::TwoSidedMaterial)) return {material, back};
  return {};
}

NodeId side(Scene& scene, NodeId shape, NodeId material, NodeId geometry) {
  namespace a = nodes::appearance;
  const NodeId look = copy_of(scene, scene.get(shape, nodes::shape::appearance)), out = copy_of(scene, shape);
  scene.set(look, a::material, material);
  scene.unset(look, a::backMaterial.slot);
  scene.set(geometry, faces::solid, true);
  scene.set(out, nodes::shape::appearance, look, nodes::shape::geometry, geometry);
  return out;
}

}  // namespace

bool back_differs(const Scene& scene, NodeId n) {
  if (!scene.get(n, two::separateBackColor)) return false;
  return scene.get(n, two::diffuseColor) != scene.get(n, two::backDiffuseColor) ||
         scene.get(n, two::emissiveColor) != scene.get(n, two::backEmissiveColor) ||
         scene.get(n, two::specularColor) != scene.get(n, two::backSpecularColor) ||
         scene.get(n, two::shininess) != scene.get(n, two::backShininess) ||
         scene.get(n, two::transparency) != scene.get(n, two::backTransparency) ||
         scene.get(n, two::ambientIntensity) != scene.get(n, two::backAmbientIntensity);
}

bool split_sides(Scene& scene, NodeId n, const std::vector<char>& driven) {
  if (!scene.is(n, nodes::Shape)) return false;
  const NodeId appearance = scene.get(n, nodes::shape::appearance), geometry = scene.get(n, nodes::shape::geometry);
  if (!scene.is(appearance, nodes::Appearance) || !geometry) return false;
  const NodeId material = scene.get(appearance, nodes::appearance::material);
  for (const NodeId part : {n, appearance, geometry, material})
    if (part && part.value < driven.size() && driven[part.value]) return false;
  const bool two_sided = scene.is(material, nodes::TwoSidedMaterial) && back_differs(scene, material);
  if (!two_sided && !scene.get(appearance, nodes::appearance::backMaterial)) return false;
  lower_geometry(scene, geometry);
  if (!scene.is(geometry, nodes::IndexedFaceSet) || scene.get(geometry, faces::solid)) return false;
  const Sides sides = sides_of(scene, appearance);
  if (!sides.back) return false;
  const NodeId front = side(scene, n, sides.front, copy_of(scene, geometry)),
               back = side(scene, n, sides.back, turned(scene, geometry));
  scene.become(
      n, nodes::Group,
      std::vector<Value>{scene.make(FieldType::MFNode, nodes::group::children.slot, std::vector<NodeId>{front, back})});
  return true;
}

std::vector<char> routed_nodes(const Scene& scene) {
  std::vector<char> out(scene.node_count());
  for_each_route(scene, [&](const Route& r) { out[r.from.value] = out[r.to.value] = 1; });
  return out;
}

}  // namespace wrlkit::x3d
