// Surfaces whose faces look along one axis or square to it: pipes, beams, plates, boxes, gratings. They may be made
// longer and thicker by a scale along their axes, and every normal stays what it was, whichever way a renderer takes
// normals through a scale.
#pragma once
#include <optional>

#include "passes/instance/form.h"
#include "scenegraph/transform.h"

namespace wrlkit::tiles {

struct Prism {
  Matrix frame;         // a rotation: takes y to the axis; of a box, x and z to those of its other faces
  bool is_box = false;  // all faces look along x, y or z
  double tilt = 0;      // the sine by which a face misses that, at most
};

/// What a mesh of triangles around the mean of its corners is a prism by. None where it has normals, colours or texture
/// coordinates of its own, or is smooth around the edges of its caps; faces narrower than 20 times the tolerance do not
/// count. O(faces).
std::optional<Prism> prism_of(const Mesh& mesh, double tolerance);

/// Whether prisms may be one with other sizes: the same corners in the same order.
std::uint64_t shape_of(const Mesh& mesh);

/// The Transform that takes `from`, in the frame of its prism, to `to`, of the same shape: every corner is within the
/// tolerance, scales are along x, y and z, and, but for a box, x and z are scaled alike. O(corners).
std::optional<TransformFields> stretched(const Prism& prism, const instancing::MeshForm& from,
                                         const instancing::MeshForm& to, double tolerance);

}  // namespace wrlkit::tiles
