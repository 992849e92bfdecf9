// Pass `lower-x3d`: its documentation is in its options.
#pragma once
#include "base/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct LowerX3dOptions {
  static constexpr std::string_view doc = R"(
Nodes that only X3D has become those of VRML97 that mean the same, so that every other pass and writer has one
vocabulary.

    IndexedTriangleSet { index [ 0 1 2 ] ... }   ->   IndexedFaceSet { coordIndex [ 0 1 2 -1 ] ... }
    CADPart { name "bolt" children ... }         ->   DEF bolt Transform { children ... }

Triangle, quad and line sets become IndexedFaceSet and IndexedLineSet, Geometry2D these with 64 sides to a circle;
StaticGroup, CAD nodes, layers, ViewpointGroup and the nodes of humanoids (H-Anim, as they stand) become groups;
X3DOM's shapes of plants (Snout, Dish, Torus, ...) become forms, as `recognise` finds them;
what is not `visible`, and faces that are neither filled nor hatched, stand in a Switch that shows nothing; the
pictures of a MultiTexture become one, or the first stays; faces that look otherwise from behind (TwoSidedMaterial,
backMaterial) become two Shapes, of other geometry the front stays. A ParticleSystem becomes its particles as they
stand in its first second; texture coordinates of three and four numbers become those of flat pictures.
What a ClipPlane hides is cut off. NURBS become triangles and lines within `tolerance`, trimmed along their
contours, NurbsSweptSurface an Extrusion, interpolators along curves those along lines, with more keys; places on
Earth become metres around the scene's GeoOrigin, or around the first place where there is none, with Y up there and
X east. Worlds without such nodes stay as they are. O(scene).

With `materials` the first three of these, with `vrml97` everything else that VRML97 cannot say is turned into what
comes near to it, or dropped, and reported:

    PhysicalMaterial, of base colour b, metallic m and roughness r   ->   Material
      diffuseColor b (1 - m/2)   specularColor (0.04 (1 - m) + b m) (1 - r)   shininess (2/r^4 - 2) / 128, from 0 to 1
    UnlitMaterial      ->   Material of that emissiveColor, black else; none at all where it is opaque and white, or
                           where the geometry has colours
    OrthoViewpoint     ->   Viewpoint that sees the same height at centerOfRotation
    ColorRGBA          ->   Color

Light is computed from the colours of X3D: a picture times a colour, which VRML97 cannot say, a baked picture can. So
`vrml97` with `defer-colors` stops before materials, fields and nodes that VRML97 does not have; a second
lower-x3d{vrml97=true} behind combine-lightmap does the rest.)";

  bool materials = false;
  bool vrml97 = false;
  bool defer_colors = false;
  double tolerance = 0;
  void fields(auto&& f) {
    f("materials", materials, "also convert materials and OrthoViewpoint, which glTF can express");
    f("vrml97", vrml97, "convert everything that VRML97 cannot express");
    f("defer-colors", defer_colors,
      "with vrml97: only geometry and groups; leave the rest to a second lower-x3d after the light");
    f("tolerance", tolerance,
      "maximum distance of triangles and lines from NURBS, in metres; 0: a thousandth of their size", at_least(0));
  }
};
Outcome lower_x3d(Scene&, const LowerX3dOptions&, PassContext&);

}  // namespace wrlkit
