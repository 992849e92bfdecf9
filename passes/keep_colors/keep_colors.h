// Pass `keep-colors`: its documentation is in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct KeepColorsOptions {
  static constexpr std::string_view doc = R"(
What X3D 4.0 would show in other colours. It multiplies a picture in colour by the colour below it; VRML97 and X3D
before show the picture. Where the writer of X3D needs version 4.0 for a world of theirs, the Materials below such
pictures become white, on copies where they have other uses. What they said is reported (no-x3d-color). Does nothing
to other worlds, so it belongs to every way to X3D. Vertex colours below a picture stay, and are multiplied. O(scene).

    Appearance { material Material { diffuseColor 1 0 0 } texture ImageTexture { url "bricks.jpg" } }
    Appearance { material Material { diffuseColor 1 1 1 } texture ImageTexture { url "bricks.jpg" } })";

  void fields(auto&&) {}
};
Outcome keep_colors(Scene&, const KeepColorsOptions&, PassContext&);

}  // namespace wrlkit
