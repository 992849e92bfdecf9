// Subdivision surfaces, by OpenMesh: coarse polygons become a smooth surface of more of them (Loop 1987; Catmull and
// Clark 1978).
//
//   before   coordIndex [ 0 1 2 3 -1 ... ]                  a cube: 6 faces
//   after    coordIndex [ 8 0 11 20 -1 8 20 9 1 -1 ... ]    24 faces, 96 with levels=2, nearly a ball
#pragma once
#include <string>
#include <string_view>

#include "base/choice.h"
#include "base/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

enum class SubdivisionScheme : std::uint8_t { loop, catmull_clark };
template <>
inline constexpr auto choices<SubdivisionScheme> = choice_row({{"loop", "triangles; polygons are triangulated first"},
                                                               {"catmull-clark", "quadrilaterals"}});

struct SubdivideOptions {
  static constexpr std::string_view doc =
      R"(
Turns coarse polygons into a smooth surface with more of them, by the schemes of Loop or of Catmull and Clark, by
OpenMesh.

    before   coordIndex [ 0 1 2 3 -1 ... ]                  a cube: 6 faces
    after    coordIndex [ 8 0 11 20 -1 8 20 9 1 -1 ... ]    24 faces; with levels=2 there are 96, nearly a ball

Colours and texture coordinates are interpolated; normals are dropped. A surface that is not a manifold is reported and
does not change: run `weld` first. Cost: linear in the resulting faces.)";
  static constexpr StatisticInfo statistics[] = {
      {"subdivide.triangles", "triangles of all surfaces that were subdivided"},
      {"subdivide.dropped-normals", "surfaces whose normals were dropped because they belonged to the coarse faces"},
  };

  SubdivisionScheme scheme = SubdivisionScheme::catmull_clark;
  int levels = 1;
  int max_triangles = 4'000'000;

  void fields(auto&& f) {
    f("scheme", scheme, "subdivision scheme");
    f("levels", levels, "number of subdivisions; each makes four times as many faces", between(1, 8));
    f("max-triangles", max_triangles,
      "maximum number of triangles of all surfaces together; surfaces beyond it stay unchanged", at_least(0));
  }
};

/// Subdivides job.mesh. Needs a build with OpenMesh.
///
/// - Colours, texture coordinates and places in lightmaps are interpolated along the edges and over the face that was
///   cut, so seams stay. Normals are dropped, as those of the coarse faces are wrong for the smooth surface, and
///   creaseAngle becomes pi: subdivide.dropped-normals.
/// - The faces that a face becomes are in its place. Borders are curves of their own: they become smooth, too, but
///   hang on only the points of the border.
/// - A surface that is not a manifold stays as it is and is reported. Faces that only touch do not hang
///   together: run `weld` before.
///
/// Meshes of lines and points stay as they are, and so do primitives: `tessellate` makes faces of them. Statistics:
/// subdivide.triangles, of all surfaces that were subdivided. Linear in the faces that come out.
Outcome subdivide(MeshJob& job, const SubdivideOptions& options);

}  // namespace wrlkit
