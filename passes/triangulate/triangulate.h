// Pass `triangulate`: its documentation is in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct TriangulateOptions {
  static constexpr std::string_view doc = R"(
Polygons to triangles, before a mesh goes where there is nothing else.

    before   coordIndex [ 0 1 2 3 -1  4 5 6 -1 ]
    after    coordIndex [ 0 1 2 -1  0 2 3 -1  4 5 6 -1 ]

Cuts the faces of job.mesh into triangles: geometry/triangulation.h.)";
  static constexpr StatisticInfo statistics[] = {
      {"triangulate.non-planar", "faces that were not planar"},
  };

  void fields(auto&&) {}
};

Outcome triangulate(MeshJob& job, const TriangulateOptions& options);

}  // namespace wrlkit
