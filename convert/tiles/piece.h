// What tiles are made of: what one Shape shows in one place, in the coordinates of the world. Pieces with one name are
// one part.
#pragma once
#include <cstdint>
#include <string>

#include "base/math/box.h"
#include "geometry/mesh.h"

namespace wrlkit::tiles {

struct Piece {
  std::string name;               // the file, and the DEF names from its root: "unit_1.wrl/Plant/Pump"
  std::uint32_t look = 0;         // into Looks
  std::uint32_t source_size = 0;  // of the name: the file
  Mesh mesh;                      // of triangles, polylines or points; fronts counter-clockwise
};

/// What draws: triangles, segments, points.
inline std::size_t n_drawn(const Mesh& mesh) {
  return mesh.kind == Mesh::Kind::lines ? mesh.corners.size() - mesh.n_faces() : mesh.n_faces();
}

}  // namespace wrlkit::tiles
