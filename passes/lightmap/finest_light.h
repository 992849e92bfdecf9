// Light of the first levels of detail for those behind them: a simpler surface should look as the one that it stands
// for, also where it lies within something that the finer one does not touch.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/closest_point.h"
#include "light/world.h"
#include "passes/lightmap/bake.h"

namespace wrlkit::bake {

class FinestLight {
 public:
  /// Shapes have places of their own (own_shapes.h). O(nodes).
  explicit FinestLight(const Scene& scene);
  /// Keeps the light of the Shapes below LODs. Takes the pages, if there is any.
  void keep(const std::vector<Part>& parts, const Layout& layout, const drawing::Stage& stage,
            std::vector<BakedPage> pages);
  /// Irradiance over pi at the nearest place that faces as `normal` does, of what was kept of the LOD around a Shape;
  /// none when that is further away than `within`. In the world. O(log triangles), from any thread.
  std::optional<Rgb> at(NodeId shape, const drawing::V3& place, const drawing::V3& normal, double within) const;
  /// Of the nearest place that there is, if any.
  std::optional<Rgb> anywhere(NodeId shape, const drawing::V3& place, const drawing::V3& normal) const;

 private:
  /// What one LOD showed: triangles in the world, by corners of their own, and where they lie on a page.
  struct Surface {
    std::vector<double> positions;
    std::vector<std::uint32_t> corners, sides, pages;  // sides, pages: of each triangle
    std::vector<Spot2> spots;                          // of each corner
    std::unique_ptr<ClosestPoint> nearest;
  };
  void add(Surface& to, const PageLayout& page, std::uint32_t number, std::size_t triangle, const Part& part,
           const drawing::Affine& frame);
  const Surface* surface_of(NodeId shape) const;
  Rgb light(const Surface& s, std::uint32_t triangle, const drawing::V3& place) const;

  std::vector<std::uint32_t> lod_of_;  // by node: 1 + the outermost LOD around a Shape; 0: none
  std::map<std::uint32_t, Surface> surfaces_;
  std::vector<Canvas> pages_;
};

}  // namespace wrlkit::bake
