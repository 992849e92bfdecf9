// Pass `keep-colors`: its documentation is in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct KeepColorsOptions {
  static constexpr std::string_view doc = R"(
Keeps pictures from being tinted when a scene is written as X3D 4.0.

    before   Appearance { material Material { diffuseColor 1 0 0 } texture ImageTexture { url "bricks.jpg" } }
    after    Appearance { material Material { diffuseColor 1 1 1 } texture ImageTexture { url "bricks.jpg" } }

X3D 4.0 multiplies a colour picture by the material's colour. In VRML97 and earlier X3D the picture replaces the colour.
If such a scene has to be written as version 4.0, Materials below colour pictures become white. A Material with other
uses is copied first. The old colour is reported (no-x3d-color). Vertex colours below a picture stay and are multiplied.
Other scenes do not change, so the pass runs for all X3D output. Cost: O(scene).)";

  void fields(auto&&) {}
};
Outcome keep_colors(Scene&, const KeepColorsOptions&, PassContext&);

}  // namespace wrlkit
