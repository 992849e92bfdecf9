// Pictures that are multiplied by a colour, and those that take its place.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit::x3d {

/// For VRML97, where a picture in colour takes the place of the colour (ISO/IEC 14772-1, table 4.6): the pixels of a
/// PixelTexture are multiplied by the one colour that they are on; of a file, or on the colours of vertices, the
/// product is reported as lost. Pictures of materials have become those of their Appearance. O(scene and pixels).
bool lower_products(Scene&, PassContext&);

/// For X3D 4.0, where it is multiplied: white Materials for Appearances whose picture in colour takes the place of
/// another colour, which is reported as lost. Nothing where the world multiplies already. O(scene).
bool whiten_replaced(Scene&, PassContext&);

}  // namespace wrlkit::x3d
