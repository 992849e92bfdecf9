// The light of a page, tile by tile: which points of the surface are asked for, and what becomes of their light.
#pragma once
#include <span>
#include <vector>

#include "light/integrator.h"
#include "passes/lightmap/layout.h"
#include "passes/lightmap/page.h"
#include "passes/lightmap/texels.h"

namespace wrlkit::bake {

/// Where the points of a texel lie.
enum class Site : std::uint32_t {
  open,
  within,   // something: what few rays see is not the light there
  pierced,  // within something on all sides, and yet a lamp shines there, or a surface that is outside: a leak
};

/// What is kept of a texel: what the checkpoint holds.
struct TexelLight {
  std::int32_t x, y;
  std::uint32_t chart;
  Site site;
  Rgb direct, gathered, along[3];
  float direct_variance, gathered_variance;
  Rgb direct_apart, gathered_apart;  // half of what two estimates of these differ by, where there are two
  Vec position, normal;
};

class PageBaker {
 public:
  static constexpr int grid = 4;  // points along each side of a texel that may be lit

  /// `flat`: lit by the normals of the faces, not by those of shading.
  PageBaker(const std::vector<Part>& parts, const PageLayout& page, const light::LightWorld& world, bool flat)
      : parts_(parts), page_(page), world_(world), flat_(flat), grid_(page.triangles, page.width, page.height) {}

  const light::LightWorld& world() const { return world_; }
  const PageLayout& page() const { return page_; }
  std::size_t n_tiles() const { return grid_.n_tiles(); }

  /// Points of the surface for a tile's samples, in their order; of a grid with this many along each side of a texel.
  /// `chosen`, by texel of the page: only of those texels; empty: of all.
  const std::vector<light::Point>& points(std::size_t tile, int samples, int side = grid,
                                          std::span<const char> chosen = {});

  /// Of those points, among all that the tile has.
  std::span<const std::uint32_t> numbers() const { return numbers_; }

  /// The texels of the tile whose points were asked for last, and where those of each are.
  std::span<const TexelSamples> texels() const { return texels_.texels; }
  /// Where one of them lies; without light.
  TexelLight place(const TexelSamples& t) const;
  /// The light of each of them.
  std::vector<TexelLight> gather(std::vector<light::Irradiance> light) const;

 private:
  bool is_cut_off(std::span<const light::Irradiance> light, const TexelSamples& t, const light::Irradiance& own) const;
  bool is_enclosed(const light::Point& p) const;
  Site site_of(std::span<const light::Irradiance> light, std::size_t first) const;
  light::Point point(const SurfaceSample& s) const;

  const std::vector<Part>& parts_;
  const PageLayout& page_;
  const light::LightWorld& world_;
  bool flat_;
  TexelGrid grid_;
  TileTexels texels_;
  std::vector<light::Point> points_;
  std::vector<std::uint32_t> numbers_;
};

}  // namespace wrlkit::bake
