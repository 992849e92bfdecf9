#include "geometry/simplify/places.h"

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
  std::vector<std::pair<NodeId, Matrix>> stack;
  std::size_t visits = 0;
  auto push = [&](const std::vector<NodeId>& list, const Matrix& m) {
    for (auto n = list.rbegin(); n != list.rend(); ++n)
      if (*n && ++visits <= most_visits) stack.push_back({*n, m});
  };
  push(scene.main.roots, {});
  while (!stack.empty()) {
    const auto [n, above] = stack.back();
    stack.pop_back();
    if (scene.is(n, nodes::Shape))
      f(n, above);
    else
      push(children_of(scene, n, shown), above * local_matrix(scene, n));
  }
  return visits <= most_visits;
}

double scale_of(const Matrix& m) {
  double scale = 0;
  for (int c = 0; c < 3; ++c) scale = std::max(scale, std::hypot(m(0, c), m(1, c), m(2, c)));
  return scale;
}

std::vector<std::uint32_t> surface_numbers(const Scene& scene, std::span<const ShapeSurface> surfaces) {
  std::vector<std::uint32_t> number(scene.node_count());
  for (std::uint32_t i = 0; i < surfaces.size(); ++i)
    for (NodeId shape : surfaces[i].shapes) number[shape.value] = i + 1;
  return number;
}

std::vector<double> largest_scales(const Scene& scene, std::span<const ShapeSurface> surfaces) {
  const auto number = surface_numbers(scene, surfaces);
  std::vector<double> scale(surfaces.size());
  for_each_place(scene, Shown::all, [&](NodeId shape, const Matrix& m) {
    if (const auto i = number[shape.value]) scale[i - 1] = std::max(scale[i - 1], scale_of(m));
  });
  for (double& s : scale)
    if (!(s > 0) || !std::isfinite(s)) s = 1;
  return scale;
}

}  // namespace wrlkit
