// Connected pieces of surfaces: cut out and put together.
#pragma once
#include <span>
#include <vector>

#include "base/math/matrix.h"
#include "geometry/mesh.h"

namespace wrlkit::simplify {

/// Triangles of each connected piece of a mesh of triangles, in the order of their first ones.
std::vector<std::vector<std::uint32_t>> connected_pieces(const Mesh& mesh);

/// Some triangles of a mesh, with what they use. `original`: the position in `mesh` of each of theirs, ascending.
Mesh piece_of(const Mesh& mesh, std::span<const std::uint32_t> faces, std::vector<std::uint32_t>& original);

/// Appends a mesh of triangles to another one; attributes that one of them lacks are dropped.
void append(Mesh& to, const Mesh& from);

void transform(Mesh& mesh, const Matrix& m);

}  // namespace wrlkit::simplify
