// Texture coordinates that a rule makes.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit::x3d {

/// Where a TextureCoordinateGenerator has a rule that the viewer has no part in (ISO/IEC 19775-1, 18.4.8), its values
/// take its place: COORD, the x and y of each corner, and SPHERE-LOCAL, half of the x and y of its normal plus one
/// half. The other rules stay. O(the geometry that has one).
bool make_generated_texcoords(Scene&, PassContext&);

}  // namespace wrlkit::x3d
