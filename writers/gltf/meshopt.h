// The one place of the writers that knows meshoptimizer: the order of triangles and vertices, and the streams of
// EXT_meshopt_compression (versions that every decoder of the extension reads: 0 of vertices, 1 of indices).
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "geometry/vertices.h"

namespace wrlkit::gltf {

/// Puts triangles into the order in which a vertex cache is used best, large meshes also into one that paints less over
/// what was painted, and vertices into the order of their first use. What order comes out depends on the index alone,
/// unless the mesh is large: cylinders of any size still share their indices. About linear.
void order_for_drawing(Vertices&);

/// A stream of elements of `stride` bytes, a multiple of 4 up to 256.
std::string pack_elements(std::string_view bytes, std::size_t stride);
/// Indices of `width` bytes. The corners of a triangle may come back turned, in the same sense of rotation.
std::string pack_triangles(std::string_view bytes, std::size_t width);
std::string pack_sequence(std::string_view bytes, std::size_t width);

/// Unit vectors as four bytes each, what the filter OCTAHEDRAL makes vectors of signed bytes again. `bits` from 2 to 8.
std::string octahedral(std::span<const float> xyz, int bits);
/// What the filter makes of them: three numbers in [-1, 1] for each.
std::vector<float> undo_octahedral(std::string bytes);

}  // namespace wrlkit::gltf
