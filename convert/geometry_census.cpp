#include "convert/geometry_census.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "base/math/saturating.h"
#include "scenegraph/nodes.h"
#include "scenegraph/places/places.h"
#include "scenegraph/places/times_shown.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

constexpr std::uint64_t most_points = 2'000'000'000;  // transformed for the bounds

NodeId geometry_of(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::Shape) ? scene.get(n, nodes::shape::geometry) : NodeId{};
}

/// The corners that a mesh uses, or the corners of their box when there are too many places for that.
void add_bounds(const Mesh& mesh, const std::vector<Matrix>& where, StampedMap& seen, std::uint64_t& budget,
                Box& bounds) {
  std::vector<Vec3> points;
  Box box;
  seen.reset(mesh.n_positions());
  for (auto c : mesh.corners) {
    if (seen.contains(c)) continue;
    seen.set(c, 0);
    points.push_back(vec3(&mesh.positions[c * std::size_t{3}]));
    box.add(points.back());
  }
  if (saturating_multiply(points.size(), where.size()) > budget) {
    points.clear();
    for (int i = 0; i < 8; ++i) points.push_back(box.corner(i));
  } else {
    budget -= points.size() * where.size();
  }
  for (auto& m : where)
    for (auto& p : points) bounds.add(m.point(p));
}

/// Boxes from below upwards: loose where there is rotation, but linear in the nodes however often they are shown.
Box box_of_boxes(const Scene& scene, const std::vector<NodeId>& order,
                 const std::unordered_map<std::uint32_t, Box>& geometry) {
  std::vector<Box> box(scene.node_count());
  Box all;
  auto merge = [](Box& to, const Box& b, const Matrix& m) {
    for (int i = 0; i < 8 && !b.empty(); ++i) to.add(m.point(b.corner(i)));
  };
  for (NodeId n : order) {
    if (NodeId g = geometry_of(scene, n)) box[n.value] = geometry.at(g.value);
    Matrix m = local_matrix(scene, n);
    for (NodeId c : shown_children(scene, n))
      if (c) merge(box[n.value], box[c.value], m);
  }
  for (NodeId n : scene.main.roots)
    if (n) merge(all, box[n.value], {});
  return all;
}

}  // namespace

bool find_places(const Scene& scene, Places& out) {
  return for_each_place(scene, Shown::now, [&](NodeId shape, const Matrix& m) {
    if (const NodeId g = geometry_of(scene, shape)) out[g.value].push_back(m);
  });
}

GeometryCensus count_geometry(const Scene& scene, const MeshSource& polygons, const MeshSource& triangles) {
  GeometryCensus census;
  const auto order = shown_nodes(scene);
  const auto times = times_shown(scene, order);
  std::unordered_map<std::uint32_t, std::uint64_t> uses;  // of each geometry
  std::vector<NodeId> geometries;
  for (NodeId n : order)
    if (NodeId g = geometry_of(scene, n)) {
      if (!uses.count(g.value)) geometries.push_back(g);
      uses[g.value] = saturating_add(uses[g.value], times[n.value]);
      census.shapes = saturating_add(census.shapes, times[n.value]);
    }
  Places where;
  const bool exact = find_places(scene, where);
  std::unordered_map<std::uint32_t, Box> boxes;
  StampedMap seen;
  std::uint64_t budget = most_points;
  for (NodeId g : geometries) {
    auto sum = [&](std::uint64_t& to, std::uint64_t n) {
      to = saturating_add(to, saturating_multiply(n, uses[g.value]));
    };
    // Faces without area are not triangles, but their corners count for the bounds, as other readers have it.
    const Mesh& p = polygons(g);
    if (p.kind == Mesh::Kind::faces) sum(census.polygons, p.n_faces());
    if (exact)
      add_bounds(p, where[g.value], seen, budget, census.bounds);
    else
      add_bounds(p, {Matrix{}}, seen, budget, boxes[g.value]);
    const Mesh& m = triangles(g);
    if (m.kind == Mesh::Kind::faces) {
      sum(census.triangles, m.n_faces());
      census.unique += m.n_faces();
    }
    if (m.kind == Mesh::Kind::points) sum(census.points, m.corners.size());
    if (m.kind == Mesh::Kind::lines) sum(census.lines, m.corners.size() - m.n_faces());
  }
  if (!exact) census.bounds = box_of_boxes(scene, order, boxes);
  return census;
}

}  // namespace wrlkit
