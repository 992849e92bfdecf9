// Pass `lower-vrml1`: its documentation is in its options.
#pragma once
#include "base/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct LowerVrml1Options {
  static constexpr std::string_view doc = R"(
Converts VRML 1.0 and Inventor to the nodes of VRML97.

    before   Separator { Material { diffuseColor 1 0 0 } Cube { } Translation { translation 3 0 0 } Sphere { } }
    after    Group { children [
               Shape { appearance Appearance { material DEF Red Material { ... } } geometry Box { } }
               Transform { translation 3 0 0 children
                 Shape { appearance Appearance { material USE Red } geometry Sphere { } } } ] }

In VRML 1.0 a node changes a traversal state, which applies to everything that follows. The state leaves a Group but not
a Separator. The pass traverses the scene and writes down what is drawn. Groups stay groups, and successive
transformations become one Transform. Whatever is drawn again in the same state becomes one node with several uses: a
Separator that is used a thousand times is stored once, and so is a Coordinate3 that several shapes use. DEF names are
kept.

What VRML97 cannot express is reported as lost. Some things are expressed in another way:
- Materials per part or per face become a Color node, or a Shape for each material if they differ in more than the
  diffuse colour.
- Transformations that one Transform cannot hold as they were written become the fields of a Transform with the same
  matrix.
- A light applies to what follows it. Its DirectionalLight therefore starts a Group of its own.
- A Switch named Cameras, and Info nodes named Title, Viewer and BackgroundColor, become Viewpoints, WorldInfo,
  NavigationInfo and Background, as browsers of the time treated them.
- An unknown node that declares its base types (`isA`) becomes the first base that is known.
- A ClipPlane becomes X3D's ClipPlane, which `lower-x3d` applies.

Nodes of VRML 1.0 in a VRML97 file, which programs based on Coin write, are converted in the same way. There, groups of
VRML97 restore the state, as Separator does. Other scenes do not change. Cost: linear in the file and in what it draws.
A node that is visited again and again in different states counts against `limit`.)";

  int limit = 500'000;
  void fields(auto&& f) {
    f("limit", limit, "maximum number of nodes that are visited again because the traversal state differs",
      at_least(0));
  }
};
Outcome lower_vrml1(Scene&, const LowerVrml1Options&, PassContext&);

}  // namespace wrlkit
