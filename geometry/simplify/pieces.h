// Connected pieces of surfaces: cut out, put together, and found again where they stand elsewhere.
#pragma once
#include <optional>
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

/// Equal for meshes whose corners use their positions in the same order.
std::uint64_t hash_of_corners(const Mesh& mesh);

/// The turn and shift that takes `from` to `to`, which have the same corners, within two thousandths of the extent: as
/// far as files round. Nothing when there is none, or when the points lie on a line.
std::optional<Matrix> congruence(const Mesh& from, const Mesh& to);

}  // namespace wrlkit::simplify
