// Pass `flatten`: its documentation is in its options.
#pragma once
#include "geometry/tessellation.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct FlattenOptions {
  static constexpr std::string_view doc = R"(
Applies Transforms that never move to the points, for programs that do not support a hierarchy of transformations.

    before   DEF Pump Transform { translation 5 0 0 children Shape { geometry IndexedFaceSet { ... [ 0 0 0, ...
    after    DEF Pump Group { children Shape { geometry IndexedFaceSet { ... [ 5 0 0, ...

A Transform that contains only Shapes, Groups and other such Transforms becomes a Group, and its Shapes are moved.
Shared geometry is copied for each place, as in `lightmap`; names of copies are numbered. Normals are computed first, so
the scene looks the same. Curved forms become faces as by `tessellate` with the same options.

- A Transform stays if a ROUTE, Script or IS uses it or a node below it, or if it contains lights, Viewpoints, sensors,
  LODs or other nodes with a position. Shapes below it are moved to its coordinate frame.
- A Transform that moves nothing stays, too.
- Names stay where they are, except those of shared geometry and Coordinates.

Files become larger, so the pass runs only when you ask for it. Cost: linear in what is drawn, which is stored once for
each place.)";
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
