#include "passes/place/place.h"

#include <numbers>

#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

double metres(Unit unit) {
  constexpr double all[] = {1, 0.01, 0.001, 0.0254, 0.3048};
  return all[static_cast<std::size_t>(unit)];
}

}  // namespace

Outcome place(Scene& scene, const PlaceOptions& options, PassContext&) {
  const double scale = metres(options.unit);
  const UpAxis up = options.up;
  if (scale == 1 && up == UpAxis::y) return Outcome::unchanged;
  constexpr double quarter = std::numbers::pi / 2;
  const NodeId root = scene.add(nodes::Transform);
  if (scale != 1) scene.set(root, nodes::transform::scale, Vec3{scale, scale, scale});
  if (up == UpAxis::z) scene.set(root, nodes::transform::rotation, Vec4{1, 0, 0, -quarter});
  if (up == UpAxis::x) scene.set(root, nodes::transform::rotation, Vec4{0, 0, 1, quarter});
  scene.set(root, nodes::transform::children, scene.main.roots);
  scene.main.roots = {root};
  return Outcome::changed;
}

}  // namespace wrlkit
