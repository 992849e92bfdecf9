// Smoothing, by OpenMesh: each point moves half way to the mean of its neighbours (Jacobi steps of the uniform
// Laplacian). For scans and other noisy surfaces.
//
//   before   a plane with points up to 0.1 off it
//   after    the same faces, points nearer to the plane; its border as it was
#pragma once
#include "base/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct SmoothOptions {
  static constexpr std::string_view doc =
      R"(
Smooths noisy surfaces such as scans. Each point moves half way towards the mean of its neighbours, `iterations` times,
by OpenMesh. Points on borders stay, and faces keep their corners.

    before   a plane with points up to 0.1 off it
    after    the same faces, points nearer to the plane; its border as it was

A surface that is not a manifold is reported and does not change: run `weld` first. Cost: faces * iterations.)";
  static constexpr StatisticInfo statistics[] = {
      {"smooth.dropped-normals", "surfaces whose normals were dropped because they no longer fit"},
  };

  int iterations = 10;

  void fields(auto&& f) {
    f("iterations", iterations, "number of iterations; closed surfaces shrink a little with each", between(1, 1000));
  }
};

/// Moves the points of job.mesh. Needs a build with OpenMesh.
///
/// - Points of borders stay where they are, and the faces stay those that they were. Colours and texture coordinates
///   stay with their corners; normals are dropped (smooth.dropped-normals), since they are wrong then.
/// - A surface that is not a manifold stays as it is and is reported. Faces that only touch do not hang
///   together: run `weld` before.
///
/// Meshes of lines and points stay as they are, and so do primitives. O(faces * iterations).
Outcome smooth(MeshJob& job, const SmoothOptions& options);

}  // namespace wrlkit
