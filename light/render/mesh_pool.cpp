#include "light/render/mesh_pool.h"

namespace wrlkit::drawing {
namespace {

/// Beyond this Embree takes a coordinate as invalid.
constexpr double largest = 1e18;

V3 position_of(const Mesh& mesh, std::uint32_t corner) {
  return vec3(mesh.positions.data() + std::size_t{mesh.corners[corner]} * 3);
}

bool usable(const V3& p) { return std::fabs(p.x) < largest && std::fabs(p.y) < largest && std::fabs(p.z) < largest; }

}  // namespace

std::uint32_t MeshPool::add(const Mesh& mesh) {
  PooledMesh m;
  list_elements(mesh);
  m.kind = order_.empty() ? Mesh::Kind::none : mesh.kind;
  m.solid = mesh.solid;
  m.n_elements = static_cast<std::uint32_t>(order_.size() / m.corners_per_element());
  n_elements_ += m.n_elements;
  m.color_width = static_cast<std::uint8_t>(mesh.color.width);
  add_points(mesh, m);
  m.normals = add_attribute(mesh.normal, normals);
  m.colors = add_attribute(mesh.color, colors);
  m.texcoords = add_attribute(mesh.texcoord, texcoords);
  m.lightcoords = add_attribute(mesh.lightcoord, lightcoords);
  meshes_.push_back(m);
  return static_cast<std::uint32_t>(meshes_.size() - 1);
}

/// Fills order_ with the corners of the triangles, segments or points, fronts counter-clockwise.
void MeshPool::list_elements(const Mesh& mesh) {
  order_.clear();
  if (mesh.kind == Mesh::Kind::none) return;
  auto add = [&](std::initializer_list<std::size_t> corners) {
    for (std::size_t c : corners)
      if (!usable(position_of(mesh, static_cast<std::uint32_t>(c)))) return;
    for (std::size_t c : corners) order_.push_back(static_cast<std::uint32_t>(c));
  };
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    std::size_t begin = mesh.begin_of(f), end = mesh.end_of(f);
    if (mesh.kind == Mesh::Kind::points)
      for (std::size_t c = begin; c < end; ++c) add({c});
    else if (mesh.kind == Mesh::Kind::lines)
      for (std::size_t c = begin; c + 1 < end; ++c) add({c, c + 1});
    else
      for (std::size_t c = begin + 1; c + 1 < end; ++c) mesh.ccw ? add({begin, c, c + 1}) : add({begin, c + 1, c});
  }
}

/// Copies the positions in use, and only those: faces of many shapes may share one list of millions.
void MeshPool::add_points(const Mesh& mesh, PooledMesh& to) {
  to.first_corner = corners.size();
  to.first_point = points.size() / 3;
  for (auto c : order_) to.box.add(position_of(mesh, c));
  if (!to.box.empty()) to.origin = to.box.centre();
  map_.reset(mesh.n_positions());
  for (auto c : order_) {
    std::uint32_t p = mesh.corners[c];
    if (!map_.contains(p)) {
      map_.set(p, static_cast<std::uint32_t>(to.n_points++));
      V3 v = position_of(mesh, c) - to.origin;
      points.insert(points.end(), {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
    }
    corners.push_back(map_[p]);
  }
}

std::size_t MeshPool::add_attribute(const Attribute& from, Stream& to) {
  if (!from.present() || order_.empty()) return PooledMesh::absent;
  std::size_t first = to.index.size();
  map_.reset(from.count());
  for (auto c : order_) {
    std::uint32_t i = from.index[c];
    if (!map_.contains(i)) {
      map_.set(i, static_cast<std::uint32_t>(to.values.size()));
      to.values.insert(to.values.end(), from.at(i), from.at(i) + from.width);
    }
    to.index.push_back(map_[i]);
  }
  return first;
}

}  // namespace wrlkit::drawing
