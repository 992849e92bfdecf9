// One connected part of a mesh as half-edges: what the search for rings walks on.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/math/vec.h"

namespace wrlkit::recognising {

constexpr std::uint32_t none = 0xffffffffu;

/// Faces that are joined by edges, all turned the same way. Half-edge h runs from origin[h] to origin[next(h)]; those
/// of a face are neighbours, from begin[face] on. Positions are around a local origin.
struct Piece {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> origin, twin, face_of;  // by half-edge; twin none: a border
  std::vector<std::uint32_t> begin;                  // by face, and the end
  std::vector<std::uint32_t> mesh_face;              // by face: which of the mesh it is
  bool mixed = false;                                // some faces had to be turned over
  double step = 0;                                   // how far points are from where they belong
  double size = 0;                                   // of the bounding box

  // Planar regions: faces next to one another that lie in one plane.
  std::vector<std::uint32_t> region;                   // by face
  std::vector<std::uint32_t> region_border;            // by region: half-edges that lead out of it
  std::vector<std::uint32_t> region_begin, by_region;  // faces of each region
  std::vector<Vec3> normal;                            // by face, as long as twice its area

  std::size_t n_faces() const { return begin.size() - 1; }
  std::uint32_t next(std::uint32_t h) const { return h + 1 == begin[face_of[h] + 1] ? begin[face_of[h]] : h + 1; }
  std::uint32_t end(std::uint32_t h) const { return origin[next(h)]; }
  std::span<const std::uint32_t> faces_of(std::uint32_t r) const {
    return std::span(by_region).subspan(region_begin[r], region_begin[r + 1] - region_begin[r]);
  }
  std::uint32_t corners(std::uint32_t face) const { return begin[face + 1] - begin[face]; }

  /// Fills normals and regions from the rest. O(half-edges).
  void find_regions();
};

}  // namespace wrlkit::recognising
