// Pass `sky`: its documentation is in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct SkyOptions {
  static constexpr std::string_view doc = R"(
Turns the Background into Shapes, for glTF, which has no background.

    --sky mesh       runs this pass when glTF is written
    --sky picture    the same with picture=true: also writes NAME.sky.png, an equirectangular picture of 2048 x 1024
                     pixels, with +X in the middle and +Z a quarter of the width to the right of it

The Background that is bound first becomes a sphere of radius 1 around the origin. Its vertices have the colours of
skyColor and groundColor, with a ring of vertices at each angle in the file and at least every six degrees. A cube
inside it carries the Background's pictures. Both are visible from inside only, and unlit. They are stored in the
Background's field `sky`, not in the scene, so other passes do not see them. The glTF writer scales them to the size of
the scene.

groundColor covers the sphere up to the last groundAngle. Cost: O(colours).)";

  bool picture = false;
  void fields(auto&& f) { f("picture", picture, "also a file with all of it in equirectangular projection"); }
};
Outcome sky(Scene&, const SkyOptions&, PassContext&);

}  // namespace wrlkit
