// X3DOM's SphereSegment: a net on a sphere between given degrees of longitude and latitude.
#pragma once
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit::x3d {

struct SphereNet {
  static constexpr std::size_t most_lines = 1000;  // of longitude, and of latitude

  double radius = 1;
  std::vector<double> longitude, latitude;  // degrees; at most most_lines of each are taken
};

/// An IndexedFaceSet with a corner wherever two of the lines meet, normals of the sphere, and a picture from edge to
/// edge. None where there are fewer than two lines of a kind. O(corners).
NodeId faces_of(Scene&, const SphereNet&, Span where);

}  // namespace wrlkit::x3d
