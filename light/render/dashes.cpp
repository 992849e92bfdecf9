#include "light/render/dashes.h"

#include <cmath>
#include <numeric>

#include "light/render/widths.h"
#include "scenegraph/nodes.h"

namespace wrlkit::drawing {
namespace {

/// Lengths of strokes and of the gaps behind them, in sixtieths of the height of the picture.
std::span<const double> pattern_of(int type) {
  static constexpr double dashed[] = {3, 2}, dotted[] = {0.6, 1.2}, dot[] = {3, 1.2, 0.6, 1.2},
                          two_dots[] = {3, 1.2, 0.6, 1.2, 0.6, 1.2};
  switch (type) {
    case 2:
      return dashed;
    case 3:
      return dotted;
    case 4:
      return dot;
    case 5:
      return two_dots;
    default:
      return {};
  }
}

int line_type(const Scene& scene, NodeId appearance) {
  const NodeId n = line_properties(scene, appearance);
  return n ? scene.get(n, nodes::line_properties::linetype) : 1;
}

}  // namespace

Dashes::Dashes(const Scene& scene, const Stage& stage, const MeshPool& meshes, std::span<const std::uint32_t> mesh_of,
               const Camera& camera)
    : stage_(stage), meshes_(meshes), mesh_of_(mesh_of), camera_(camera) {
  for (std::uint32_t use = 0; use < mesh_of.size(); ++use) {
    if (meshes[mesh_of[use]].kind != Mesh::Kind::lines) continue;
    const int type = line_type(scene, stage.uses[use].appearance);
    if (pattern_of(type).empty()) continue;
    lines_.resize(mesh_of.size());
    lines_[use] = {type, starts(use)};
  }
}

V3 Dashes::end_of(std::uint32_t use, std::size_t segment, int end) const {
  const PooledMesh& m = meshes_[mesh_of_[use]];
  return stage_.frames[stage_.uses[use].frame].point(m.origin + meshes_.position(m, segment, end));
}

/// 0 where an end is behind the camera.
double Dashes::pixels_between(const V3& a, const V3& b) const {
  const V3 p = camera_.project(a), q = camera_.project(b);
  if (!(p.z > 0) || !(q.z > 0)) return 0;
  return std::hypot(p.x / p.z - q.x / q.z, p.y / p.z - q.y / q.z);
}

std::vector<float> Dashes::starts(std::uint32_t use) const {
  std::vector<float> out(meshes_[mesh_of_[use]].n_elements, 0);
  for (std::size_t i = 1; i < out.size(); ++i) {
    const V3 from = end_of(use, i - 1, 0), to = end_of(use, i - 1, 1), apart = end_of(use, i, 0) - to;
    if (dot(apart, apart) == 0) out[i] = out[i - 1] + static_cast<float>(pixels_between(from, to));
  }
  return out;
}

bool Dashes::is_gap(const Hit& hit, const V3& position) const {
  if (lines_.empty() || lines_[hit.use].start.empty()) return false;
  const Line& line = lines_[hit.use];
  const auto pattern = pattern_of(line.type);
  const double period = std::accumulate(pattern.begin(), pattern.end(), 0.0);
  const double along = line.start[hit.element] + pixels_between(end_of(hit.use, hit.element, 0), position);
  double left = std::fmod(along / (camera_.height / 60.0), period);
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    if (left < pattern[i]) return i % 2 == 1;
    left -= pattern[i];
  }
  return false;
}

}  // namespace wrlkit::drawing
