// Pass `triangulate`: its documentation is in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct TriangulateOptions {
  static constexpr std::string_view doc = R"(
Cuts polygons into triangles, for formats that have nothing else.

    before   coordIndex [ 0 1 2 3 -1  4 5 6 -1 ]
    after    coordIndex [ 0 1 2 -1  0 2 3 -1  4 5 6 -1 ]

Each corner keeps its normal, colour and texture coordinate. Concave faces are cut correctly, whatever `convex` says.
Faces without area are dropped. Cost: linear in the corners, except for large concave faces.)";
  static constexpr StatisticInfo statistics[] = {
      {"triangulate.non-planar", "faces that were not planar"},
  };

  void fields(auto&&) {}
};

Outcome triangulate(MeshJob& job, const TriangulateOptions& options);

}  // namespace wrlkit
