// Pass `lower-vrml1`: its documentation is in its options.
#pragma once
#include "base/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct LowerVrml1Options {
  static constexpr std::string_view doc = R"(
A world of VRML 1.0 or Inventor in the nodes of VRML97.

    before   Separator { Material { diffuseColor 1 0 0 } Cube { } Translation { translation 3 0 0 } Sphere { } }
    after    Group { children [
               Shape { appearance Appearance { material DEF Red Material { ... } } geometry Box { } }
               Transform { translation 3 0 0 children
                 Shape { appearance Appearance { material USE Red } geometry Sphere { } } } ] }

VRML 1.0 is a program for a machine with a state: a node changes the state for all that follows, out of a Group but
not out of a Separator. The pass runs that program and writes down what is drawn. Groups stay groups, a run of nodes
at one place is below one Transform, and what is drawn again in the same state is one node with several uses: a
Separator that comes a thousand times is there once, and a Coordinate3 is one Coordinate however many shapes it is in.
DEF names go along.

What VRML97 cannot say is reported as lost. What it says in another way:
- materials by part or face: a Color node, or one Shape for each kind where they differ in more than diffuse colour;
- transformations that one Transform cannot say as they were written: its fields from their matrix;
- light on what follows: a DirectionalLight begins a Group of its own behind what it does not reach;
- a Switch with the name Cameras, Info with the names Title, Viewer and BackgroundColor: Viewpoints, WorldInfo,
  NavigationInfo and Background, as browsers of the time took them;
- a node that describes itself (`isA`) and is not known: the first of its bases that is;
- a ClipPlane: that of X3D, which `lower-x3d` cuts with.

Nodes of VRML 1.0 in a world of VRML97, as programs write that build on Coin, become nodes of VRML97 in the same
way; groups of VRML97 keep the state in, as Separator does. Other worlds are left alone. Linear in the file and in
what it draws; nodes that are used in ever other states are limited like the copies of expand-protos.)";

  int limit = 500'000;
  void fields(auto&& f) {
    f("limit", limit, "maximum number of nodes that are visited again because the traversal state differs",
      at_least(0));
  }
};
Outcome lower_vrml1(Scene&, const LowerVrml1Options&, PassContext&);

}  // namespace wrlkit
