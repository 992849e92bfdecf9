// Lines that are broken: LineProperties.linetype (ISO/IEC 19775-1:2023, 12.4.3), in the plane of the picture.
#pragma once
#include <vector>

#include "light/render/camera.h"
#include "light/render/mesh_pool.h"
#include "light/render/ray_scene.h"
#include "light/render/stage.h"

namespace wrlkit::drawing {

/// The patterns of the register of ISO/IEC 9973: 2 dashed, 3 dotted, 4 dashes and dots, 5 dashes and two dots; all
/// others are plain. A dash is a twentieth of the picture's height long, and a pattern goes on around corners.
class Dashes {
 public:
  /// Refers to all of them but the scene. O(uses), and O(segments) of lines that are broken.
  Dashes(const Scene&, const Stage&, const MeshPool&, std::span<const std::uint32_t> mesh_of, const Camera&);

  /// Whether a line that a ray meets at `position`, in the world, has a gap there.
  bool is_gap(const Hit&, const V3& position) const;

 private:
  struct Line {
    int type = 1;
    std::vector<float> start;  // of each segment along its line, pixels
  };
  V3 end_of(std::uint32_t use, std::size_t segment, int end) const;
  double pixels_between(const V3& a, const V3& b) const;
  std::vector<float> starts(std::uint32_t use) const;

  const Stage& stage_;
  const MeshPool& meshes_;
  std::span<const std::uint32_t> mesh_of_;
  const Camera& camera_;
  std::vector<Line> lines_;  // by use; empty: none is broken
};

}  // namespace wrlkit::drawing
