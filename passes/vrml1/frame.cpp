#include "passes/vrml1/frame.h"

namespace wrlkit::vrml1 {

NodeId placed(Scene& scene, const Placement& at, const std::vector<NodeId>& nodes, Span where) {
  namespace f = nodes::transform;
  if (at.identity()) {
    NodeId n = scene.add(nodes::Group, where);
    return scene.set(n, nodes::group::children, nodes), n;
  }
  NodeId n = scene.add(nodes::Transform, where);
  const TransformFields fields = at.fields(), none;
  if (fields.translation != none.translation) scene.set(n, f::translation, fields.translation);
  if (fields.rotation != none.rotation) scene.set(n, f::rotation, fields.rotation);
  if (fields.scale != none.scale) scene.set(n, f::scale, fields.scale);
  if (fields.scale_orientation != none.scale_orientation) scene.set(n, f::scaleOrientation, fields.scale_orientation);
  if (fields.center != none.center) scene.set(n, f::center, fields.center);
  return scene.set(n, f::children, nodes), n;
}

std::vector<NodeId> children(Scene& scene, const Frame& frame) {
  std::vector<NodeId> rest;
  for (auto run = frame.runs.rbegin(); run != frame.runs.rend(); ++run) {
    std::vector<NodeId> here = run->at.identity() ? run->nodes : std::vector{placed(scene, run->at, run->nodes, scene.where(run->nodes[0]))};
    here.insert(here.end(), rest.begin(), rest.end());
    rest = run->lights_rest ? std::vector{placed(scene, {}, here, scene.where(run->nodes[0]))} : std::move(here);
  }
  return rest;
}

NodeId group(Scene& scene, const Frame& frame, Span where, std::string_view name) {
  if (frame.runs.empty()) return {};
  NodeId n = frame.runs.size() == 1 ? placed(scene, frame.runs[0].at, frame.runs[0].nodes, where) : placed(scene, {}, children(scene, frame), where);
  if (!name.empty()) scene.set_name(n, name);
  return n;
}

}  // namespace wrlkit::vrml1
