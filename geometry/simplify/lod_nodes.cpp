#include "geometry/simplify/lod_nodes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/math/digits.h"
#include "geometry/geometry.h"
#include "scenegraph/child_lists.h"
#include "scenegraph/declared_protos.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

struct Sphere {
  Vec3 center{};
  double radius = 0;
};

/// The next number above `v` of four digits, for texts that people read.
double round_up(double v) {
  if (!(v > 0)) return 0;
  const double exponent = std::floor(std::log10(v)) - 3, step = std::pow(10.0, std::abs(exponent));
  return exponent < 0 ? std::ceil(v * step) / step : std::ceil(v / step) * step;
}

/// Around the middle of the bounds of the positions that the corners use.
Sphere bounding_sphere(const Mesh& mesh) {
  Sphere s;
  if (mesh.corners.empty()) return s;
  s.center = box_of_corners(mesh).centre();
  for (double& x : s.center) x = decimal(static_cast<float>(x));
  for (auto c : mesh.corners) s.radius = std::max(s.radius, fast_length(mesh.position(c) - s.center));
  return s;
}

}  // namespace

double ScreenBudget::per_pixel() const { return screen_height / (2 * std::tan(field_of_view / 2)); }

std::vector<double> lod_ranges(double radius, std::span<const double> errors, const ScreenBudget& budget) {
  std::vector<double> out;
  for (const double error : errors) out.push_back(radius + error / budget.pixels * budget.per_pixel());
  if (budget.vanish > 0) out.push_back(radius + 2 * radius / budget.vanish * budget.per_pixel());
  constexpr double farthest = 1e30;
  double least = 0;
  for (auto& r : out) least = r = round_up(std::max(std::min(r, farthest), least * 1.001));
  return out;
}

NodeId make_lod(Scene& scene, const Box& bounds, std::span<const LodLevel> levels, const LodLimits& limits,
                LodCounts& made) {
  std::vector<NodeId> children;
  std::vector<double> errors;
  const bool is_large = !levels.empty() && levels[0].n_faces >= limits.min_faces;
  const LodLevel* last = nullptr;
  const auto empty = [&] { return scene.add(nodes::Group, scene.where(levels[0].node)); };
  for (const LodLevel& level : levels.first(is_large ? levels.size() : 0)) {
    const double most = last ? (1 - limits.min_saving) * static_cast<double>(last->n_faces) : 0;
    if (last && (level.node == last->node || static_cast<double>(level.n_faces) > most)) continue;
    children.push_back(level.node ? level.node : empty());
    if (last) errors.push_back(level.error);
    last = &level;
  }
  const auto range = is_large ? lod_ranges(diagonal(bounds) / 2, errors, limits.screen) : std::vector<double>();
  if (range.empty()) {
    ++made.n_too_small;
    return {};
  }
  if (limits.screen.vanish > 0) children.push_back(empty());
  const NodeId lod = scene.add(nodes::LOD, scene.where(levels[0].node));
  Vec3 center = bounds.centre();
  for (double& x : center) x = decimal(static_cast<float>(x));
  scene.set(lod, nodes::lod::children, children, nodes::lod::center, center, nodes::lod::range, range);
  ++made.n_lods;
  made.n_levels += errors.size();
  return lod;
}

std::size_t LodNodes::add(const ShapeSurface& surface, const Mesh& mesh, std::span<const MeshLevel> levels,
                          const ScreenBudget& budget) {
  const auto sphere = bounding_sphere(mesh);
  std::vector<double> errors;
  for (const auto& level : levels) errors.push_back(level.error);
  const auto range = lod_ranges(sphere.radius, errors, budget);
  std::vector<NodeId> shapes;
  std::ranges::copy_if(surface.shapes, std::back_inserter(shapes), [&](NodeId n) { return listed_[n.value] != 0; });
  if (range.empty() || shapes.empty()) return 0;
  std::vector<NodeId> geometries;
  for (const auto& level : levels) {
    geometries.push_back(scene_.add(nodes::IndexedFaceSet, scene_.where(surface.geometry)));
    store_mesh(scene_, geometries.back(), level.mesh);
  }
  for (NodeId shape : shapes) {
    std::vector<NodeId> children{shape};
    for (NodeId g : geometries) children.push_back(shape_like(shape, g));
    if (budget.vanish > 0) children.push_back(scene_.add(nodes::Group, scene_.where(shape)));
    NodeId n = scene_.add(nodes::LOD, scene_.where(shape));
    scene_.set(n, nodes::lod::children, children, nodes::lod::center, sphere.center, nodes::lod::range, range);
    if (lod_of_.size() <= shape.value) lod_of_.resize(shape.value + std::size_t{1});
    lod_of_[shape.value] = n;
  }
  return shapes.size();
}

/// The same Shape with another geometry.
NodeId LodNodes::shape_like(NodeId shape, NodeId geometry) {
  const auto fields = scene_.copy_of_fields(shape);
  NodeId n = scene_.add(nodes::Shape, scene_.where(shape));
  scene_.set_fields(n, fields);
  scene_.set(n, nodes::shape::geometry, geometry);
  return n;
}

void LodNodes::replace(std::vector<NodeId>& list) const {
  for (auto& n : list)
    if (n && n.value < lod_of_.size() && lod_of_[n.value]) n = lod_of_[n.value];
}

template <class F>
void LodNodes::for_lists(F f) {
  edit_child_lists(scene_, all_nodes(scene_), f);
  f(scene_.main.roots);
  for (ProtoId p : declared_protos(scene_)) f(scene_.proto(p).body.roots);
}

LodNodes::LodNodes(Scene& scene) : scene_(scene), listed_(scene.node_count()) {
  for_lists([&](const std::vector<NodeId>& list) {
    for (NodeId n : list)
      if (n) listed_[n.value] = 1;
  });
}

void LodNodes::replace_shapes() {
  for_lists([&](std::vector<NodeId>& list) { replace(list); });
}

}  // namespace wrlkit
