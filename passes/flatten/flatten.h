// Pass `flatten`: its documentation is in its options.
#pragma once
#include "geometry/tessellation.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct FlattenOptions {
  static constexpr std::string_view doc = R"(
Transforms that never move, multiplied into the points: for tools that know no hierarchy of transformations.

    before   DEF Pump Transform { translation 5 0 0 children Shape { geometry IndexedFaceSet { ... [ 0 0 0, ...
    after    DEF Pump Group { children Shape { geometry IndexedFaceSet { ... [ 5 0 0, ...

Makes a Group of each Transform that holds nothing but Shapes, Groups and such Transforms, and moves the Shapes. What
is shared is written for each place (as by `lightmap`; names of copies are numbered). Faces get their normals first,
so what is drawn stays the same; curved forms become faces as by `tessellate` with the same options.

- A Transform stays if a ROUTE, a Script or an IS touches it or something below it, or if it holds lights, Viewpoints,
  sensors, LODs or anything else with a place of its own. What is below it is moved to its frame.
- A Transform that moves nothing stays, too.
- Names stay where they were, but for those of geometry and Coordinates that were shared.

Files become larger by it: run it on request only. Linear in what is drawn, which is there once for each place.)";
  static constexpr StatisticInfo statistics[] = {
      {"flatten.transforms", "Transforms that became Groups"},
      {"flatten.shapes", "Shapes that were moved"},
      {"flatten.draws-before", "Shapes drawn before the pass"},
      {"flatten.draws-after", "Shapes drawn after the pass"},
      {"flatten.nodes-before", "nodes before the pass"},
      {"flatten.nodes-after", "nodes after the pass"},
      {"flatten.meshes-before", "geometry nodes drawn before the pass"},
      {"flatten.meshes-after", "geometry nodes drawn after the pass"},
  };

  Tessellation faces{.triangles = false, .texcoords = true};

  void fields(auto&& f) { faces.fineness_fields(f); }
};

Outcome flatten(Scene&, const FlattenOptions&, PassContext&);

}  // namespace wrlkit
