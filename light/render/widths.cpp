#include "light/render/widths.h"

#include <algorithm>

#include "scenegraph/nodes.h"

namespace wrlkit::drawing {
namespace {

constexpr double widest = 256;  // so that a stroke covers no more than a picture

double line_width(const Scene& scene, NodeId appearance) {
  const NodeId n = line_properties(scene, appearance);
  return n ? std::clamp(scene.get(n, nodes::line_properties::linewidthScaleFactor), 1.0, widest) : 1;
}

double point_size(const Scene& scene, NodeId appearance) {
  namespace f = nodes::point_properties;
  const NodeId n = scene.get(appearance, nodes::appearance::pointProperties);
  if (!scene.is(n, nodes::PointProperties)) return 1;
  const double least = std::max(1.0, scene.get(n, f::pointSizeMinValue)),
               most = std::max(least, scene.get(n, f::pointSizeMaxValue));
  return std::min(std::clamp(scene.get(n, f::pointSizeScaleFactor), least, most), widest);
}

}  // namespace

NodeId line_properties(const Scene& scene, NodeId appearance) {
  namespace f = nodes::line_properties;
  if (!scene.is(appearance, nodes::Appearance)) return {};
  const NodeId n = scene.get(appearance, nodes::appearance::lineProperties);
  return scene.is(n, nodes::LineProperties) && scene.get(n, f::applied) ? n : NodeId{};
}

std::vector<float> widths_of(const Scene& scene, const Stage& stage, const MeshPool& meshes,
                             std::span<const std::uint32_t> mesh_of) {
  std::vector<float> out;
  for (std::size_t u = 0; u < mesh_of.size(); ++u) {
    const auto kind = meshes[mesh_of[u]].kind;
    const NodeId appearance = stage.uses[u].appearance;
    if (kind == Mesh::Kind::faces || !scene.is(appearance, nodes::Appearance)) continue;
    const double by = kind == Mesh::Kind::lines ? line_width(scene, appearance) : point_size(scene, appearance);
    if (by == 1) continue;
    out.resize(mesh_of.size(), 1);
    out[u] = static_cast<float>(by);
  }
  return out;
}

}  // namespace wrlkit::drawing
