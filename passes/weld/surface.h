// The mesh while it is repaired: its corners index points that are numbered without gaps, and face_begin is there even
// if all faces are triangles. What several repairs do with faces is here.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/math/vec.h"
#include "geometry/mesh.h"

namespace wrlkit {

struct Surface {
  Mesh& mesh;
  const std::vector<double>& points;    // xyz
  std::vector<std::uint32_t>& face_of;  // of each corner; see number_faces

  std::size_t n_points() const { return points.size() / 3; }
  std::uint32_t n_faces() const { return static_cast<std::uint32_t>(mesh.face_begin.size() - 1); }
  std::uint32_t begin(std::uint32_t face) const { return mesh.face_begin[face]; }
  std::uint32_t end(std::uint32_t face) const { return mesh.face_begin[face + 1]; }
  std::span<const std::uint32_t> face(std::uint32_t f) const {
    return {mesh.corners.data() + begin(f), end(f) - begin(f)};
  }
  std::uint32_t after(std::uint32_t corner) const {
    return corner + 1 == end(face_of[corner]) ? begin(face_of[corner]) : corner + 1;
  }
  Vec3 point(std::uint32_t p) const {
    return {points[3 * std::size_t{p}], points[3 * std::size_t{p} + 1], points[3 * std::size_t{p} + 2]};
  }

  /// Fills face_of.
  void number_faces() const;
  /// Newell's normal, twice the area of the face long; the front is on its side if mesh.ccw.
  Vec3 area_vector(std::uint32_t face) const;
};

/// Calls f(stream) for each of the index streams of a mesh: corners, and those of the attributes that are there.
template <class F>
void for_each_stream(Mesh& mesh, F f) {
  f(mesh.corners);
  for (Attribute* a : mesh.attributes())
    if (a->present()) f(a->index);
}

/// Leaves only some corners, in this order; face_begin is the caller's. `room` is working memory.
void take_corners(Mesh& mesh, std::span<const std::uint32_t> corners, std::vector<std::uint32_t>& room);

}  // namespace wrlkit
