#include "passes/lower_vrml1/frame.h"

#include <algorithm>

namespace wrlkit::vrml1 {

NodeId placed(Scene& scene, const Placement& at, const std::vector<NodeId>& nodes, Span where) {
  namespace f = nodes::transform;
  if (at.identity()) {
    NodeId n = scene.add(nodes::Group, where);
    scene.set(n, nodes::group::children, nodes);
    return n;
  }
  NodeId n = scene.add(nodes::Transform, where);
  const TransformFields fields = at.fields(), none;
  if (fields.translation != none.translation) scene.set(n, f::translation, fields.translation);
  if (fields.rotation != none.rotation) scene.set(n, f::rotation, fields.rotation);
  if (fields.scale != none.scale) scene.set(n, f::scale, fields.scale);
  if (fields.scale_orientation != none.scale_orientation) scene.set(n, f::scaleOrientation, fields.scale_orientation);
  if (fields.center != none.center) scene.set(n, f::center, fields.center);
  scene.set(n, f::children, nodes);
  return n;
}

std::vector<NodeId> children(Scene& scene, const Frame& frame) {
  std::vector<NodeId> backwards;
  for (auto run = frame.runs.rbegin(); run != frame.runs.rend(); ++run) {
    const Span where = scene.where(run->nodes[0]);
    if (run->at.identity())
      backwards.insert(backwards.end(), run->nodes.rbegin(), run->nodes.rend());
    else
      backwards.push_back(placed(scene, run->at, run->nodes, where));
    if (!run->lights_rest) continue;
    std::ranges::reverse(backwards);
    backwards = {placed(scene, {}, backwards, where)};
  }
  std::ranges::reverse(backwards);
  return backwards;
}

NodeId group(Scene& scene, const Frame& frame, Span where, std::string_view name) {
  if (frame.runs.empty()) return {};
  NodeId n = frame.runs.size() == 1 ? placed(scene, frame.runs[0].at, frame.runs[0].nodes, where)
                                    : placed(scene, {}, children(scene, frame), where);
  if (!name.empty()) scene.set_name(n, name);
  return n;
}

}  // namespace wrlkit::vrml1
