#include "geometry/geometry.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/geometry_attributes.h"
#include "geometry/geometry_lists.h"
#include "scenegraph/any_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

// The values of an attribute or coordinate node; none if the field is NULL or holds something else.
template <FieldType T>
std::span<const double> values_of(const Scene& scene, NodeId n, FieldKey<T> key) {
  return scene.is(n, key.node) ? scene.get(n, key) : std::span<const double>{};
}

// The values of a Color, or of a ColorRGBA, which makes the attribute four wide.
std::span<const double> colors_of(const Scene& scene, NodeId n, Attribute& color) {
  if (!scene.is(n, nodes::ColorRGBA)) return values_of(scene, n, nodes::color::color);
  color.width = 4;
  return scene.get(n, nodes::color_rgba::color);
}

bool all_finite(std::span<const double> v) {
  double sum[4] = {};  // 0 * x is 0 or NaN; four sums, because each add waits for the one before
  std::size_t i = 0;
  for (; i + 4 <= v.size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k) sum[k] += 0 * v[i + k];
  for (; i < v.size(); ++i) sum[0] += 0 * v[i];
  return sum[0] + sum[1] + sum[2] + sum[3] == 0;
}

// Whether all positions in use are finite, at the cost of the smaller of the two arrays.
bool positions_finite(const Mesh& mesh) {
  if (mesh.n_positions() <= mesh.corners.size()) return all_finite(mesh.positions.span());
  for (auto p : mesh.corners)
    if (!all_finite(mesh.positions.span().subspan(std::size_t{p} * 3, 3))) return false;
  return true;
}

// Own positions, those in use only, in the order of the corners: a copy of all would cost a Shape that uses one invalid
// point of a million as much as the million.
void keep_used_positions(MeshJob& job) {
  auto& slot = job.scratch.map;
  auto all = job.mesh.positions.span();
  std::vector<double> used;
  slot.reset(all.size() / 3);
  std::uint32_t n = 0;
  for (auto& p : job.mesh.corners) {
    if (!slot.contains(p)) {
      slot.set(p, n++);
      auto at = all.subspan(std::size_t{p} * 3, 3);
      used.insert(used.end(), at.begin(), at.end());
    }
    p = slot[p];
  }
  job.mesh.positions.clear();
  job.mesh.positions.edit() = std::move(used);
}

void repair_positions(MeshJob& job) {
  Mesh& mesh = job.mesh;
  if (positions_finite(mesh)) return;
  if (mesh.n_positions() > mesh.corners.size()) keep_used_positions(job);
  std::size_t n = 0;
  for (auto& v : mesh.positions.edit())
    if (!std::isfinite(v)) {
      v = 0;
      ++n;
    }
  job.ctx.diag.report(Diag::not_finite, job.scene.where(job.geometry), title(job), n);
}

void report(MeshJob& job, const RunFaults& faults, std::size_t n_indices) {
  if (faults.bad_indices == 0 && faults.short_runs == 0) return;
  auto where = job.scene.where(job.geometry);
  auto& diag = job.ctx.diag;
  if (faults.bad_indices) diag.report(Diag::bad_index, where, title(job), faults.bad_indices, n_indices);
  auto short_run = job.mesh.kind == Mesh::Kind::lines ? Diag::degenerate_line : Diag::degenerate_face;
  if (faults.short_runs) diag.report(short_run, where, title(job), faults.short_runs);
}

// Corners and positions from coord and coordIndex; what the attributes are bound to.
AuthoredRuns read_coord(MeshJob& job, NodeId coord, std::span<const std::int32_t> coordIndex) {
  Mesh& mesh = job.mesh;
  auto& dropped = job.scratch.a;
  dropped.clear();
  auto points = values_of(job.scene, coord, nodes::coordinate::point);
  if (points.empty()) {
    if (!coordIndex.empty())
      job.ctx.diag.report(Diag::degenerate_geometry, job.scene.where(job.geometry), title(job), "it has no points");
    return {};
  }
  mesh.positions = Array<double>::borrow(points);
  const std::size_t shortest = mesh.kind == Mesh::Kind::lines ? 2 : 3;
  report(job, read_runs({coordIndex, mesh.n_positions(), shortest}, mesh, dropped), coordIndex.size());
  return {coordIndex, dropped};
}

void read_face_set(MeshJob& job) {
  namespace ifs = nodes::indexed_face_set;
  const Scene& scene = job.scene;
  const NodeId n = job.geometry;
  Mesh& mesh = job.mesh;
  mesh.kind = Mesh::Kind::faces;
  mesh.ccw = scene.get(n, ifs::ccw);
  mesh.solid = scene.get(n, ifs::solid);
  mesh.convex = scene.get(n, ifs::convex);
  const double crease_angle = scene.get(n, ifs::creaseAngle);
  mesh.crease_angle = std::isfinite(crease_angle) ? crease_angle : 0;

  auto runs = read_coord(job, scene.get(n, ifs::coord), scene.get(n, ifs::coordIndex));
  bind_attribute(job, mesh.color,
                 {"color", colors_of(scene, scene.get(n, ifs::color), mesh.color), scene.get(n, ifs::colorIndex),
                  scene.get(n, ifs::colorPerVertex)},
                 runs);
  bind_attribute(job, mesh.normal,
                 {"normal", values_of(scene, scene.get(n, ifs::normal), nodes::normal::vector),
                  scene.get(n, ifs::normalIndex), scene.get(n, ifs::normalPerVertex)},
                 runs);
  bind_attribute(job, mesh.texcoord,
                 {"texCoord", values_of(scene, scene.get(n, ifs::texCoord), nodes::texture_coordinate::point),
                  scene.get(n, ifs::texCoordIndex), true},
                 runs);
  bind_attribute(job, mesh.lightcoord,
                 {"lightCoord", values_of(scene, scene.get(n, ifs::lightCoord), nodes::texture_coordinate::point),
                  scene.get(n, ifs::lightCoordIndex), true},
                 runs);
  repair_positions(job);
}

void read_line_set(MeshJob& job) {
  namespace ils = nodes::indexed_line_set;
  const Scene& scene = job.scene;
  const NodeId n = job.geometry;
  job.mesh.kind = Mesh::Kind::lines;
  auto runs = read_coord(job, scene.get(n, ils::coord), scene.get(n, ils::coordIndex));
  bind_attribute(job, job.mesh.color,
                 {"color", colors_of(scene, scene.get(n, ils::color), job.mesh.color), scene.get(n, ils::colorIndex),
                  scene.get(n, ils::colorPerVertex)},
                 runs);
  repair_positions(job);
}

void read_point_set(MeshJob& job) {
  const Scene& scene = job.scene;
  Mesh& mesh = job.mesh;
  mesh.kind = Mesh::Kind::points;
  mesh.positions = Array<double>::borrow(
      values_of(scene, scene.get(job.geometry, nodes::point_set::coord), nodes::coordinate::point));
  mesh.corners.resize(mesh.n_positions());
  std::iota(mesh.corners.begin(), mesh.corners.end(), 0u);
  auto colors = colors_of(scene, scene.get(job.geometry, nodes::point_set::color), mesh.color);
  bind_attribute(job, mesh.color, {"color", colors, {}, true}, {});
  repair_positions(job);
}

}  // namespace

void read_mesh(MeshJob& job) {
  job.mesh.clear();
  auto type = job.scene.type_id(job.geometry);
  if (type == nodes::IndexedFaceSet)
    read_face_set(job);
  else if (type == nodes::IndexedLineSet)
    read_line_set(job);
  else if (type == nodes::PointSet)
    read_point_set(job);
}

namespace {

bool has_picture(const Scene& scene, NodeId appearance) {
  if (scene.get(appearance, nodes::appearance::texture)) return true;
  NodeId material = scene.get(appearance, nodes::appearance::material);
  if (!material) return false;
  return std::ranges::any_of(scene.fields(material), [&](const Value& v) {
    return !scene.is_extra(v) && v.type == FieldType::SFNode && !v.is && v.node &&
           scene.is(v.node, nodes::X3DTextureNode);
  });
}

}  // namespace

std::vector<char> textured_geometry(const Scene& scene) {
  std::vector<char> textured(scene.node_count());
  const auto shows_picture = [&](NodeId n) { return scene.is(n, nodes::Appearance) && has_picture(scene, n); };
  if (!any_node(scene, shows_picture)) return textured;
  for (NodeId n : all_nodes(scene)) {
    if (!scene.is(n, nodes::Shape)) continue;
    NodeId geometry = scene.get(n, nodes::shape::geometry), appearance = scene.get(n, nodes::shape::appearance);
    if (geometry && shows_picture(appearance)) textured[geometry.value] = 1;
  }
  return textured;
}

}  // namespace wrlkit
