// UNIT statements of X3D (ISO/IEC 19775-1, 7.2.5.10): a file may count in inches and degrees. A scene is always in
// metres and radians.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

struct Units {
  double length = 1, angle = 1;  // in metres and radians

  /// False: a category that no field of the node table has (mass, force) or that does not exist.
  bool set(std::string_view category, double factor);
};

/// Multiplies the written values of all fields that have such a unit in the node table. The key values of an
/// interpolator count in the unit of what its ROUTEs lead to, fields of prototypes and their defaults in that of the
/// fields that they refer to (IS), also through several of them. What leads to different units stays as it is, and is
/// reported; what leads nowhere stays. O(scene) when there is a unit.
void apply(const Units&, Scene&, Diagnostics&);

}  // namespace wrlkit::x3d
