// Names that XML can have and VRML97 can not.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// Gives nodes, prototypes and fields names that VRML97 allows, where they are declared and where they are used, and
/// reports each once: DEF Cube.001, PROTO My Proto, ROUTE S.out.c. Names of VRML97 files, which other readers take,
/// stay. False: there were no others.
bool give_legal_names(Scene&, Diagnostics&);

}  // namespace wrlkit::x3d
