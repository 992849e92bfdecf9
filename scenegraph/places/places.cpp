#include "scenegraph/places/places.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

std::vector<NodeId> children_of(const Scene& scene, NodeId n, Shown shown) {
  if (shown == Shown::now) return shown_children(scene, n);
  const NodeType& type = scene.type(n);
  if (type.kind != NodeKind::proto) return hierarchy_children(scene, n);
  const auto& roots = scene.proto(type.proto).body.roots;
  return {roots.begin(), roots.begin() + !roots.empty()};  // only the first is drawn (ISO/IEC 14772-1, 4.8.3)
}

}  // namespace

bool for_each_place(const Scene& scene, Shown shown, const std::function<void(NodeId, const Matrix&)>& f) {
  Ways<Matrix> ways(scene);
  ways.push(scene.main.roots, {});
  while (const auto step = ways.next()) {
    if (scene.is(step->node, nodes::Shape))
      f(step->node, step->state);
    else
      ways.push(children_of(scene, step->node, shown), step->state * local_matrix(scene, step->node));
  }
  return !ways.too_many();
}

double scale_of(const Matrix& m) {
  double scale = 0;
  for (int c = 0; c < 3; ++c) scale = std::max(scale, std::hypot(m(0, c), m(1, c), m(2, c)));
  return scale;
}

}  // namespace wrlkit
