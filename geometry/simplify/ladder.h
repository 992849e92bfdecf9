// What may replace a part of a scene: from the part itself to very few triangles, each with what it costs.
#pragma once
#include <vector>

#include "geometry/simplify/collapse.h"
#include "geometry/simplify/samples.h"

namespace wrlkit::simplify {

/// One of the surfaces that may replace a part.
struct Rung {
  Mesh mesh;  // empty on the first rung, which is the part itself
  std::size_t n_faces = 0;
  Distortion distortion;  // in metres
  bool loose = false;     // backs may show: it was fitted
};

/// A part that is simplified for itself.
struct LadderPart {
  const Mesh& mesh;  // of triangles, in metres, the origin near it
  std::span<const SurfaceSample> samples;
  CollapseOptions collapse;
  double share = 0;  // of the triangles of the world: rungs of what is most of them are nearer to one another
};

/// Rungs by falling numbers of triangles, each as near as can be made; the first is the part. Edges collapse by the
/// criterion to some hundred triangles, then on a FittedSurface, which has no attributes but the colours of faces
/// (geometry/flat_colors.h), of which each level has those of the part; a part with a lightmap goes as far as the
/// criterion goes. A face is as far from the part as from what has its colour there. Those that are no better than
/// another with fewer triangles are left out. O(n log n).
std::vector<Rung> make_ladder(const LadderPart& part);

/// Which rungs are on the lower convex hull of distortion over triangles, where the part is stretched: where each
/// triangle saves more than the next.
std::vector<std::uint32_t> convex_hull(std::span<const Rung> rungs, const Stretch& stretch = {});

}  // namespace wrlkit::simplify
