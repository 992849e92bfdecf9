// What a bake has chosen, as a line of the world's WorldInfo: so that it can be repeated, or undone.
#pragma once
#include <string_view>

#include "scenegraph/scene.h"

namespace wrlkit::bake {

/// "lightmap exposure 3.4" for the name "exposure" becomes a line of the first WorldInfo, instead of one that a bake
/// before has left; a world without a WorldInfo gets one.
void keep_in_info(Scene& scene, std::string_view name, std::string_view value);

}  // namespace wrlkit::bake
