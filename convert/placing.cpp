#include "convert/placing.h"

#include <numbers>

#include "scenegraph/nodes.h"

namespace wrlkit {

void place_world(Scene& scene, Unit unit, UpAxis up) {
  constexpr double metres[] = {1, 0.01, 0.001, 0.0254, 0.3048};
  constexpr double quarter = std::numbers::pi / 2;
  const double scale = metres[static_cast<std::size_t>(unit)];
  if (scale == 1 && up == UpAxis::y) return;
  const NodeId root = scene.add(nodes::Transform);
  if (scale != 1) scene.set(root, nodes::transform::scale, Vec3{scale, scale, scale});
  if (up == UpAxis::z) scene.set(root, nodes::transform::rotation, Vec4{1, 0, 0, -quarter});
  if (up == UpAxis::x) scene.set(root, nodes::transform::rotation, Vec4{0, 0, 1, quarter});
  scene.set(root, nodes::transform::children, scene.main.roots);
  scene.main.roots = {root};
}

}  // namespace wrlkit
