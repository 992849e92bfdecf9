// Pass `lower-x3d`: its documentation is in its options.
#pragma once
#include "base/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct LowerX3dOptions {
  static constexpr std::string_view doc = R"(
Converts nodes that only X3D has to VRML97 nodes with the same meaning, so that other passes and writers need to handle
one vocabulary only.

    IndexedTriangleSet { index [ 0 1 2 ] ... }   ->   IndexedFaceSet { coordIndex [ 0 1 2 -1 ] ... }
    CADPart { name "bolt" children ... }         ->   DEF bolt Transform { children ... }

- Triangle, quad and line sets become IndexedFaceSet and IndexedLineSet. So does Geometry2D, with 64 sides to a circle.
- StaticGroup, CAD nodes, layers, ViewpointGroup and H-Anim nodes, in the pose of the file, become groups.
- X3DOM's plant shapes (Snout, Dish, Torus, ...) become the forms that `recognise` uses.
- Nodes that are not `visible`, and faces that are neither filled nor hatched, move into a Switch that shows nothing.
- The pictures of a MultiTexture are combined into one; otherwise the first one stays.
- Faces with a different back (TwoSidedMaterial, backMaterial) become two Shapes. Other geometry keeps its front only.
- A ParticleSystem becomes its particles as they are in the first second.
- Texture coordinates of three and four numbers become those of flat pictures.
- What a ClipPlane hides is cut off.
- NURBS become triangles and lines within `tolerance`, trimmed along their contours. A NurbsSweptSurface becomes an
  Extrusion. Interpolators along curves become linear ones with more keys.
- Positions on the Earth become metres around the scene's GeoOrigin, or else around the first position, with Y up and X
  east.

Scenes without such nodes do not change. Cost: O(scene).

`materials` also converts the first three nodes below. `vrml97` converts everything else that VRML97 cannot express to
something similar, or drops and reports it:

    PhysicalMaterial, of base colour b as displayed, metallic m and roughness r   ->   Material
      diffuseColor b (1 - m/2)   specularColor (0.04 (1 - m) + b m) (1 - r)   shininess (2/r^4 - 2) / 128, from 0 to 1
    UnlitMaterial      ->   black Material with that emissiveColor; no Material if it is opaque and white, or if the
                           geometry has colours
    OrthoViewpoint     ->   Viewpoint that shows the same height at centerOfRotation
    ColorRGBA          ->   Color

Light must be computed from X3D's colours: a baked picture can contain a picture times a colour, which VRML97 cannot
express otherwise. `vrml97` with `defer-colors` therefore leaves materials, and fields and nodes that VRML97 lacks, to a
second lower-x3d{vrml97=true} after combine-lightmap.)";

  bool materials = false;
  bool vrml97 = false;
  bool defer_colors = false;
  double tolerance = 0;
  void fields(auto&& f) {
    f("materials", materials, "also convert materials and OrthoViewpoint, which glTF can express");
    f("vrml97", vrml97, "convert everything that VRML97 cannot express");
    f("defer-colors", defer_colors,
      "with vrml97: only geometry and groups; leave the rest to a second lower-x3d after the light");
    f("tolerance", tolerance, "maximum distance of triangles and lines from NURBS; 0: a thousandth of their size",
      a_length());
  }
};
Outcome lower_x3d(Scene&, const LowerX3dOptions&, PassContext&);

}  // namespace wrlkit
