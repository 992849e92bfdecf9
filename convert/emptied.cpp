#include "convert/emptied.h"

#include <algorithm>
#include <span>
#include <vector>

#include "convert/drawn_search.h"
#include "geometry/triangulation.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// Whether three corners of a face in a row, or the first one and two others, span an area.
bool spans_area(std::span<const double> points, std::span<const std::int32_t> face) {
  const auto at = [&](std::int32_t i) { return points.data() + 3 * static_cast<std::size_t>(i); };
  const auto n_points = static_cast<std::int32_t>(points.size() / 3);
  if (!std::ranges::all_of(face, [&](std::int32_t i) { return i < n_points; })) return true;  // reported elsewhere
  for (std::size_t k = 2; k < face.size(); ++k)
    if (has_area(at(face[0]), at(face[k - 1]), at(face[k]))) return true;
  return false;
}

bool has_face(const Scene& scene, NodeId n) {
  namespace f = nodes::indexed_face_set;
  const NodeId coord = scene.get(n, f::coord);
  if (!scene.is(coord, nodes::Coordinate)) return true;
  const auto points = scene.get(coord, nodes::coordinate::point);
  const auto index = scene.get(n, f::coordIndex);
  for (std::size_t begin = 0; begin < index.size();) {
    const auto end = static_cast<std::size_t>(
        std::ranges::find_if(index.subspan(begin), [](std::int32_t i) { return i < 0; }) - index.begin());
    if (spans_area(points, index.subspan(begin, end - begin))) return true;
    begin = end + 1;
  }
  return false;
}

IsDrawn draws_certainly(const Scene& scene, NodeId n) {
  if (scene.is(n, nodes::IndexedFaceSet)) return has_face(scene, n) ? IsDrawn::yes : IsDrawn::no;
  if (scene.is(n, nodes::Box) || scene.is(n, nodes::Cone) || scene.is(n, nodes::Cylinder) || scene.is(n, nodes::Sphere))
    return IsDrawn::yes;
  const bool is_shape = scene.is(n, nodes::X3DShapeNode) && !scene.is(n, nodes::Shape);
  const auto kind = scene.type(n).kind;
  const bool may_draw = is_shape || scene.is(n, nodes::X3DGeometryNode) || scene.is(n, nodes::Vrml1ShapeNode) ||
                        scene.is(n, nodes::Inline) || kind == NodeKind::unknown || kind == NodeKind::proto;
  return may_draw ? IsDrawn::perhaps : IsDrawn::no;
}

/// Of what instances of prototypes hold, nobody knows here whether it is drawn.
IsDrawn anything_drawn(const Scene& scene) {
  return DrawnSearch(
      scene, [&](NodeId n) { return draws_certainly(scene, n); },
      [&](NodeId n, std::vector<NodeId>& stack) {
        const auto kind = scene.type(n).kind;
        if (kind != NodeKind::proto && kind != NodeKind::script)
          for_each_child(scene, n, [&](NodeId c) { stack.push_back(c); });
      })(scene.main.roots);
}

}  // namespace

EmptiedScene::EmptiedScene(const Scene& scene) : had_any_(anything_drawn(scene) == IsDrawn::yes) {}

void EmptiedScene::report(const Scene& scene, Diagnostics& diag) const {
  if (had_any_ && anything_drawn(scene) == IsDrawn::no)
    diag.report(Diag::nothing_drawn, scene.file,
                "the passes have left nothing of it; lengths without a unit are metres");
}

}  // namespace wrlkit
