// Transforms that never move, multiplied into the points: for tools that know no hierarchy of transformations.
//
//   before   DEF Pump Transform { translation 5 0 0 children Shape { geometry IndexedFaceSet { coord Coordinate { point
//   [ 0 0 0, ... after    DEF Pump Group { children Shape { geometry IndexedFaceSet { coord Coordinate { point [ 5 0 0,
//   ...
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct FlattenOptions {
  void fields(auto&&) {}
};

/// Makes a Group of each Transform that holds nothing but Shapes, Groups and such Transforms, and moves the Shapes.
/// What is shared is written for each place (as by `lightmap`; names of copies are numbered). Faces get their normals
/// first, so what is drawn stays the same; curved forms become faces as by `tessellate`.
///
/// - A Transform stays if a ROUTE, a Script or an IS touches it or something below it, or if it holds lights,
/// Viewpoints,
///   sensors, LODs or anything else with a place of its own. What is below it is moved to its frame.
/// - A Transform that moves nothing stays, too.
/// - Names stay where they were, but for those of geometry and Coordinates that were shared.
///
/// Files become larger by it: run it on request only. Counted: flatten.transforms, flatten.shapes, and figures.h.
/// Linear in what is drawn, which is there once for each place.
Outcome flatten(Scene&, const FlattenOptions&, PassContext&);

}  // namespace wrlkit
