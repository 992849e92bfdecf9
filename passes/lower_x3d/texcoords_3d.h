// Texture coordinates of three and four numbers, and their transformations, over pictures that are flat.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit::x3d {

/// TextureCoordinate3D and 4D become TextureCoordinate, moved by the TextureTransform3D or TextureTransformMatrix3D of
/// the Appearance (ISO/IEC 19775-1, clause 33): what is flat takes the first two numbers. Geometry that events change
/// stays as it is. Where pictures have three dimensions, nothing changes. O(coordinates).
bool flatten_texcoords(Scene&, PassContext&);

}  // namespace wrlkit::x3d
