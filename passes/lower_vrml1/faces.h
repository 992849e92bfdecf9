// The faces of every polygon shape of VRML 1.0 and Inventor in one form, and what a binding gives to each of them.
// Lines are faces that are not closed.
#pragma once
#include <span>
#include <vector>

#include "passes/lower_vrml1/state.h"
#include "scenegraph/scene.h"

namespace wrlkit::vrml1 {

struct Faces {
  struct Face {
    std::uint32_t begin, count;  // in `coord`
    std::int32_t part, number;   // what PER_PART and PER_FACE count
  };
  std::vector<std::int32_t> coord;  // as VRML97 has it: corners, -1 behind each face
  std::vector<std::int32_t>
      sequence;                     // of each entry of coord: which vertex of the shape it is, what PER_VERTEX counts
  std::vector<std::int32_t> place;  // and where it is in the file's coordIndex, what PER_VERTEX_INDEXED looks up
  std::vector<Face> faces;
  bool verbatim = false;  // coord is the file's coordIndex
};

/// The polygons, polylines, strips of triangles or grid of a geometry node; `n_points`: of its coordinates, for nodes
/// that count through them. `segments`: lines are cut into their segments, for bindings by part.
Faces read_faces(const Scene&, NodeId geometry, std::size_t n_points, bool segments);

/// Which values an attribute has: nothing, the one of everything, one for each face, one for each corner.
struct Attribute {
  enum class Of : std::uint8_t { nothing, all, faces, corners } of = Of::nothing;
  std::vector<std::int32_t>
      index;  // of faces: one each; of corners: parallel to Faces::coord. Empty: as VRML97 counts without one
  explicit operator bool() const { return of != Of::nothing; }
};

/// What a binding gives. `index` is the file's list for it; [ -1 ] says nothing. Values begin again behind `n_values`.
Attribute bind(const Faces&, Binding, std::span<const std::int32_t> index, std::size_t n_values);
/// How many values it takes, for attributes that do not begin again.
std::size_t values_needed(const Faces&, const Attribute&);

/// Some of the faces, for a Shape of their own.
Faces choose(const Faces&, std::span<const std::uint32_t> which);
Attribute choose(const Faces&, std::span<const std::uint32_t> which, const Attribute&);

}  // namespace wrlkit::vrml1
