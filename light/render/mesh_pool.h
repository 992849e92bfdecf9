// The meshes of all geometry nodes in a few large arrays: positions in single precision, relative to a centre of each
// mesh of its own, and for each corner of each triangle, segment or point where its position, normal, colour and
// texture coordinates are. A million meshes of one triangle cost hardly more than one mesh of a million.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/mesh.h"
#include "light/render/linear.h"

namespace wrlkit::drawing {

/// One attribute of all meshes: values, and an entry for each corner of the meshes that have it.
struct Stream {
  std::vector<float> values;
  std::vector<std::uint32_t> index;  // of the first number of the value
};

struct PooledMesh {
  static constexpr std::size_t absent = static_cast<std::size_t>(-1);

  Mesh::Kind kind = Mesh::Kind::none;
  bool solid = true;
  std::uint8_t color_width = 3;
  std::uint32_t n_elements = 0;  // triangles, segments or points
  std::size_t first_corner = 0;  // into MeshPool::corners
  std::size_t first_point = 0, n_points = 0;
  std::size_t normals = absent, colors = absent, texcoords = absent,
              lightcoords = absent;  // into the index of each stream
  V3 origin;                         // positions are relative to this
  Box box;                           // with the origin

  int corners_per_element() const { return kind == Mesh::Kind::faces ? 3 : kind == Mesh::Kind::lines ? 2 : 1; }
};

class MeshPool {
 public:
  /// More elements than this are not drawn: some 200 bytes each, with the tree of the tracer.
  static constexpr std::size_t most_elements = 40'000'000;

  /// Takes a mesh in. Polygons are cut into fans and polylines into segments. The front of a triangle is where its
  /// corners run counter-clockwise, whatever mesh.ccw says. Costs O(its corners). Elements with positions that are not
  /// finite, or beyond single precision, are dropped.
  std::uint32_t add(const Mesh& mesh);

  const PooledMesh& operator[](std::uint32_t i) const { return meshes_[i]; }
  std::size_t size() const { return meshes_.size(); }
  std::size_t n_elements() const { return n_elements_; }
  /// Position of a corner of an element in the frame of the mesh, less its origin.
  V3 position(const PooledMesh& m, std::size_t element, int corner) const {
    const float* p = point(m, corners[m.first_corner + element * m.corners_per_element() + corner]);
    return {p[0], p[1], p[2]};
  }
  const float* point(const PooledMesh& m, std::uint32_t i) const { return points.data() + (m.first_point + i) * 3; }
  /// The value of an attribute at a corner; `first` is the mesh's entry for that attribute.
  const float* value(const Stream& s, const PooledMesh& m, std::size_t first, std::size_t element, int corner) const {
    return s.values.data() + s.index[first + element * m.corners_per_element() + corner];
  }

  std::vector<float> points;           // xyz
  std::vector<std::uint32_t> corners;  // into the points of the mesh
  Stream normals, colors, texcoords, lightcoords;

 private:
  void list_elements(const Mesh& mesh);
  void add_points(const Mesh& mesh, PooledMesh& to);
  std::size_t add_attribute(const Attribute& from, Stream& to);

  std::vector<PooledMesh> meshes_;
  std::size_t n_elements_ = 0;        // of all meshes
  std::vector<std::uint32_t> order_;  // corners of the mesh, as elements; scratch
  StampedMap map_;
};

}  // namespace wrlkit::drawing
