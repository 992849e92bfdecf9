// What stands between the charts of a page: the light of the nearest charts goes on there, so that filters and smaller
// versions of the picture never mix in black.
#pragma once
#include <vector>

#include "passes/lightmap/rgb.h"

namespace wrlkit::bake {

/// Gives every texel with `known[i] == 0` a colour: the mean of the known ones around it, at the finest scale that has any
/// (pull and push over halved pictures; Gortler et al. 1996). Known texels stay. Without any known one all is black.
/// O(texels).
void fill(std::vector<Rgb>& texels, const std::vector<char>& known, int width, int height);

}  // namespace wrlkit::bake
