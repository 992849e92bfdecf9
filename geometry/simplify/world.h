// The interaction points of a whole scene (Lazanyi, 2.3): the world at falling numbers of triangles, and all of them
// together in one scene with LOD nodes.
#pragma once
#include <vector>

#include "geometry/simplify/lod_nodes.h"

namespace wrlkit {

struct WorldSimplifyOptions {
  CollapseOptions collapse;
  // Where the interaction points are; one of these four.
  std::size_t every = 0;            // at the multiples of this number of triangles
  std::vector<std::size_t> counts;  // at these numbers of triangles
  std::vector<double> ratios;       // at these shares of the triangles
  std::vector<double> errors;       // with no surface farther than this from what it was, in metres of the world
  std::size_t drawn = 0;            // triangles that the world draws, of which ratios are; 0: those of its surfaces
  /// The scene with instances of prototypes replaced by their bodies, where nodes of both have the same numbers; it
  /// says where surfaces are shown. None: there are no instances. It must outlive the levels.
  const Scene* expanded = nullptr;
  bool one_part = false;        // of WorldLevels: of a scene of one part, too
  OfText text = OfText::leave;  // of WorldLevels; take: letters are parts
  ScreenBudget budget;
};

/// The numbers of triangles to stop at, falling, below `n`, which is what there are; of `every` the 10,000 largest.
std::vector<std::size_t> counts_of(const WorldSimplifyOptions& options, std::size_t n);

/// One interaction point. Counts and distances are over all surfaces, each counted once however often it is used, as
/// large as the largest of its places in the world. Distances in metres.
struct InteractionPoint {
  std::size_t n_faces = 0;
  double rms = 0,
         error = 0;    // two-sided distance from the first: root of the mean square over the surfaces, and largest
  double normals = 0;  // angle between the normals of both, in radians, in the mean over the surfaces
  double seconds = 0;  // processor time of the collapses up to here; unknown (0) when the points are by errors
};

class SimplifiedWorld {
 public:
  /// Reads the surfaces of a scene (surfaces_of) and simplifies them. Unless by errors, the triangles are taken where
  /// the error grows least, whichever surface that is on; within a surface in the order of the criterion. One of
  /// several surfaces keeps as many as a box has. What open borders of several parts have in common stays where it is
  /// (shared_borders.h). What is left alone is said (not-simplified). All meshes are in memory. `scene` must outlive
  /// this.
  SimplifiedWorld(const Scene& scene, const WorldSimplifyOptions& options, Task& ctx);

  std::size_t n_faces() const { return n_faces_; }
  std::size_t n_points() const { return points_.size(); }
  const InteractionPoint& point(std::size_t i) const { return points_[i]; }
  /// The world at an interaction point: each surface in the place of what it was, everything else as it is.
  Scene scene_at(std::size_t i) const;
  /// The world with LOD nodes that have the interaction points as levels.
  Scene scene_with_levels() const;

 private:
  struct Part {
    ShapeSurface surface;
    Mesh mesh;
    CollapseOptions collapse;       // with what neighbours share
    double scale = 1;               // metres of the world for its unit
    double area = 0;                // in the world
    std::vector<MeshLevel> levels;  // different ones, the finest first
    std::vector<std::size_t> at;    // by interaction point: how many of the levels have gone by; 0: as it was
  };
  void read_parts(const WorldSimplifyOptions& options, Task& ctx);
  void measure_points(std::size_t n);

  const Scene& scene_;
  ScreenBudget budget_;
  std::vector<Part> parts_;
  std::vector<InteractionPoint> points_;
  std::size_t n_faces_ = 0;
};

}  // namespace wrlkit
