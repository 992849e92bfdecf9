// The pictures of a MultiTexture (ISO/IEC 19775-1, 18.4.3) laid over one another, as one picture.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit::x3d {

/// Each MultiTexture whose pictures lie over one another in one period becomes one ImageTexture; what is lost by that
/// is reported. Others stay, as do those that events change: `lower_appearance` takes their first picture. Needs
/// resources. O(pixels).
bool combine_multi_textures(Scene&, PassContext&);

}  // namespace wrlkit::x3d
