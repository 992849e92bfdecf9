// A mesh as graphics hardware and glTF want it: vertices that carry all their attributes, in single precision, with one
// index. Corners that agree in position, normal, color and places in pictures are one vertex. This is the last step
// that happens to a mesh: what is split here is found together by no later pass.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/mesh.h"

namespace wrlkit {

struct SplitOptions {
  std::array<double, 3> origin{};  // subtracted from the positions before they are rounded
  bool normals = true;             // false: do without, even if the mesh has them; corners are split by them no more
  bool colors = true;
  bool texcoords = true;
  bool lightcoords = true;
  bool mirror = false;         // reverse the corners of each face once more, for use below a mirroring transform
  bool linear_colors = false;  // colors are display-referred (IEC 61966-2-1) and wanted linear; alpha is left alone
  bool flip_v = false;         // texture origin at the top, as in glTF: v becomes 1 - v
};

/// All numbers are finite. Made to be used again and again: a million shapes allocate as little as the largest of them.
struct Vertices {
  std::vector<float> position;       // xyz, relative to `origin`
  std::vector<float> normal;         // xyz of unit length; empty: none. So are the next three
  std::vector<float> color;          // rgb or rgba as `color_width` says, in [0, 1]
  std::vector<float> texcoord;       // uv
  std::vector<float> lightcoord;     // uv
  std::vector<float> feature;        // the part that a vertex is of; split_vertices leaves it empty
  std::vector<std::uint32_t> index;  // three for each triangle, two for each segment, one for each point
  int color_width = 3;
  std::array<double, 3> origin{};
  std::array<float, 3> min{}, max{};  // of `position`; zero when there is none
  std::size_t n_dropped = 0;          // triangles with an index that occurs twice
  std::size_t n_not_finite = 0;       // coordinates that were not finite in single precision: 0 or the largest is taken

  std::size_t count() const { return position.size() / 3; }
  void clear();
};

/// Arrays of split_vertices.
struct SplitScratch {
  struct Vertex {
    std::uint32_t position, normal, color, texcoord, lightcoord, next;
  };
  struct Shade {
    std::uint32_t from;
    float to;
  };

  StampedMap first;  // vertex of a position
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> of_corner;
  std::vector<std::uint32_t> in_table, table;  // vertices of positions that have very many
  std::vector<Shade> shades;                   // conversions of color that were made lately
};

/// Fills `out`, cleared first. Vertices are in the order of the first corner that uses them.
///
/// - Faces become triangles; those of more than three corners are fans, which is right for convex ones (tessellate does
///   better). Polylines become segments. Faces of `ccw FALSE` are reversed, so that they show their front
///   counter-clockwise.
/// - Normals get unit length. One without a direction is replaced by that of a face that uses it, or (0, 0, 1).
/// - Only triangles with two equal indices are dropped. Slivers stay: neighbours would gape without them.
///
/// Linear in the corners, whatever the number of positions that the mesh does not use, and however many vertices share
/// a position. Indices must be those of existing values.
void split_vertices(const Mesh& mesh, const SplitOptions& options, SplitScratch& scratch, Vertices& out);

}  // namespace wrlkit
