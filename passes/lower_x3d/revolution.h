// A profile turned around X, as faces.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

struct Revolution {
  static constexpr std::size_t most_points = 10'000;

  std::vector<double> profile;  // pairs of x and the distance from X; closed where its first point comes last again; at
                                // most most_points are taken
  double angle, crease_angle;   // radians
  bool caps;                    // of what is turned by less than a whole turn
};

/// An IndexedFaceSet with 64 sides to a turn whose outside is outside. A profile that is not closed goes on to the
/// axis at both ends. None for a profile of fewer than two points. O(points).
NodeId faces_of(Scene&, const Revolution&, Span where);

}  // namespace wrlkit::x3d
