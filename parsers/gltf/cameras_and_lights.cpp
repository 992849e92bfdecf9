// Cameras and lights of glTF as nodes of VRML and X3D.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "parsers/gltf/hierarchy.h"
#include "scenegraph/nodes.h"

namespace wrlkit::gltf_reader {

NodeId Hierarchy::camera(Json node, const TransformFields& place) {
  namespace f = nodes::viewpoint;
  const auto index = c_.file.index(Table::cameras, node["camera"]);
  const Json camera = c_.file.at(Table::cameras, index);
  NodeId n = c_.add(nodes::Viewpoint, node);
  cameras_[index].push_back(n);
  if (place.translation != Vec3{0, 0, 10}) c_.scene.set(n, f::position, place.translation);
  if (place.rotation[3] != 0) c_.scene.set(n, f::orientation, place.rotation);
  const Json seen = camera["perspective"];
  double angle = seen["yfov"].number(std::numbers::pi / 4);
  if (double aspect = seen["aspectRatio"].number(1); !c_.file.is_own() && aspect > 0 && aspect < 1)
    angle = 2 * std::atan(std::tan(angle / 2) * aspect);
  if (angle > 0 && angle < std::numbers::pi && std::abs(angle - 0.785398) > 1e-6)
    c_.scene.set(n, f::fieldOfView, angle);
  if (c_.file.is_own()) return n;
  if (camera["orthographic"]) c_.lost.add("orthographic camera", c_.file.where(camera));
  auto title = camera["name"].text().empty() ? node["name"].text() : camera["name"].text();
  if (!title.empty()) c_.scene.set(n, f::description, title);
  c_.lost.keep(c_.file, camera);
  return n;
}

/// The window of glTF is around the middle: one that is not has its position moved.
void Hierarchy::orthographic_camera(NodeId n, Json node, const TransformFields& place) {
  namespace f = nodes::ortho_viewpoint;
  const Json seen = c_.file.at(Table::cameras, c_.file.index(Table::cameras, node["camera"]))["orthographic"];
  const double x = seen["xmag"].number(1) * place.scale[0], y = seen["ymag"].number(1) * place.scale[1];
  if (place.translation != Vec3{0, 0, 10}) c_.scene.set(n, f::position, place.translation);
  if (place.rotation[3] != 0) c_.scene.set(n, f::orientation, place.rotation);
  if (x != 1 || y != 1) c_.scene.set(n, f::fieldOfView, std::vector<double>{-x, -y, x, y});
}

/// Location and direction, as far as the type has them.
void Hierarchy::light_fields(NodeId n, Json light, const TransformFields& place) {
  Scene& scene = c_.scene;
  auto put = [&](std::string_view name, FieldType type, auto v) {
    if (auto slot = scene.type(n).find(name, Dialect::vrml97)) scene.set(n, scene.make(type, *slot, v));
  };
  Vec3 d = rotate(place.rotation, {0, 0, -1});
  for (double& v : d) v = std::round(v * 1e9) / 1e9 + 0.0;
  if (place.translation != Vec3{0, 0, 0}) put("location", FieldType::SFVec3f, place.translation);
  if (d != Vec3{0, 0, -1}) put("direction", FieldType::SFVec3f, d);
  if (!light) return;
  const double intensity = light["intensity"].number(1);
  if (auto c = light["color"].numbers(); c.size() == 3 && c != std::vector<double>{1, 1, 1})
    put("color", FieldType::SFColor, Vec3{display(c[0]), display(c[1]), display(c[2])});
  if (scene.is(n, nodes::DirectionalLight)) {
    const double i = intensity / std::numbers::pi;
    if (i > 1) c_.lost.add("light brighter than VRML's brightest", c_.file.where(light));
    return put("intensity", FieldType::SFFloat, std::clamp(std::round(i * 1e7) / 1e7, 0.0, 1.0));
  }
  // Intensity 1 that falls off as 1 / (k r^2): candela / (std::numbers::pi r^2) from where that is below 1.
  const double k = intensity > 0 ? std::numbers::pi / intensity : 0;
  put("attenuation", FieldType::SFVec3f, Vec3{0, 0, k});
  if (!(intensity > 0)) put("intensity", FieldType::SFFloat, 0.0);
  constexpr double unseen = 1000;  // where no limit is given: as far as a thousandth of the full light
  const double range = light["range"].number(0);
  put("radius", FieldType::SFFloat, range > 0 ? range : k > 0 ? std::sqrt(unseen / k) : 0.0);
  const Json spot = light["spot"];
  if (light["type"].text() == "spot") {
    put("cutOffAngle", FieldType::SFFloat, spot["outerConeAngle"].number(std::numbers::pi / 4));
    put("beamWidth", FieldType::SFFloat, spot["innerConeAngle"].number(0));
  }
}

/// None for one that goes elsewhere: a sun of another program lights the whole scene, one of VRML its group.
NodeId Hierarchy::light(Json node, const TransformFields& place, const Matrix& world) {
  auto index = c_.file.index(Table::lights, light_of(node));
  if (index == none) return {};
  const Json light = c_.file.at(Table::lights, index);
  const auto type = light["type"].text();
  if (type != "directional" && type != "spot" && type != "point") {
    c_.diag().report(Diag::gltf_bad_value, c_.file.where(light), "light of type '" + std::string(type) + "'");
    return NodeId{};
  }
  NodeId n = c_.add(type == "directional" ? nodes::DirectionalLight
                    : type == "spot"      ? nodes::SpotLight
                                          : nodes::PointLight,
                    node);
  lights_[index].push_back(n);
  if (c_.file.is_own()) {
    light_fields(n, {}, place);
    return n;
  }
  c_.lost.keep(c_.file, light);
  if (type != "directional") {
    light_fields(n, light, place);
    return n;
  }
  light_fields(n, light, place_of(world));
  if (c_.scene.name(n).empty()) c_.set_name(n, light["name"].text().empty() ? node["name"] : light["name"]);
  suns_.push_back(n);
  return {};
}

}  // namespace wrlkit::gltf_reader
