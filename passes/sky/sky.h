// Pass `sky`: its documentation is in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct SkyOptions {
  static constexpr std::string_view doc = R"(
The Background in force (the first that is shown) as Shapes, for formats that have no background: a sphere of radius 1
around the origin, coloured at its vertices by skyColor and groundColor, with a ring of vertices at every angle that the
file names and at least every six degrees, and within it a cube of its pictures. Both are seen from within only, and not
lit. They stand in the field `sky` of the Background, not in the world: other passes do not see them, and only
the writer of glTF knows how large the world is that they go around.

    --sky mesh       runs it when glTF is written
    --sky picture    with picture=true, which makes the file NAME.sky.png as well: the Background in equirectangular
                     projection, 2048 x 1024 pixels, with +X in the middle and +Z a quarter to the right of it

groundColor covers the sphere up to the last groundAngle. O(colours).)";

  bool picture = false;
  void fields(auto&& f) { f("picture", picture, "also a file with all of it in equirectangular projection"); }
};
Outcome sky(Scene&, const SkyOptions&, PassContext&);

}  // namespace wrlkit
