// LOD nodes around Shapes: how simplified meshes come into a scene (ISO/IEC 14772-1, 6.26).
#pragma once
#include <span>
#include <vector>

#include "base/math/box.h"
#include "geometry/simplify/levels.h"
#include "geometry/simplify/surfaces.h"

namespace wrlkit {

/// From which distance on an error is not seen.
struct ScreenBudget {
  double pixels = 1, screen_height = 1080, field_of_view = 0.785398;  // the last in radians, of the height
  double vanish = 0;  // pixels below which a part may be left out altogether; 0: never

  /// Distance at which a length covers one pixel, by that length.
  double per_pixel() const;
};

/// Each the distance from which on the error of the next level is not seen on the near side of a sphere; and from which
/// on the sphere itself is not, if it is to vanish. Ascending, of four digits.
std::vector<double> lod_ranges(double radius, std::span<const double> errors, const ScreenBudget& budget);

/// What is shown from some distance on.
struct LodLevel {
  NodeId node;       // none: nothing is
  double error = 0;  // in the coordinates of the LOD
  std::uint64_t n_faces = 0;
};

struct LodLimits {
  ScreenBudget screen{};
  double min_saving = 0;        // share of the triangles of the level before that a level has to save
  std::uint64_t min_faces = 0;  // triangles of the first level below which there is no LOD
};

struct LodCounts {
  std::size_t n_lods = 0, n_levels = 0, n_too_small = 0;
};

/// A LOD with those of the levels that save enough, counted in `made`; none when no level does. The first is what is
/// there from nearby.
NodeId make_lod(Scene& scene, const Box& bounds, std::span<const LodLevel> levels, const LodLimits& limits,
                LodCounts& made);

class LodNodes {
 public:
  explicit LodNodes(Scene& scene);

  /// Makes a LOD of each Shape that holds the surface and is in a list of nodes, with the Shape as its first level.
  /// `mesh` is the surface; nothing is made when there are no levels and it is not to vanish. Returns the number of
  /// LODs.
  std::size_t add(const ShapeSurface& surface, const Mesh& mesh, std::span<const MeshLevel> levels,
                  const ScreenBudget& budget);
  /// Puts the LODs where their Shapes were: into grouping nodes, and among the roots of scopes. O(nodes).
  void replace_shapes();

 private:
  NodeId shape_like(NodeId shape, NodeId geometry);
  void replace(std::vector<NodeId>& list) const;
  /// Calls f(list) for the lists that may contain a LOD; f may change them.
  template <class F>
  void for_lists(F f);

  Scene& scene_;
  std::vector<char> listed_;    // by node: is in such a list
  std::vector<NodeId> lod_of_;  // by Shape
};

}  // namespace wrlkit
