// LOD nodes around Shapes: how simplified meshes come into a scene (ISO/IEC 14772-1, 6.26).
#pragma once
#include <span>
#include <vector>

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
