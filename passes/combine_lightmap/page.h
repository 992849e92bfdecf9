// A picture that triangles are painted into: who owns each texel, and what it shows. Texels within `reach` of a
// triangle are painted, too, by the nearest one, as the plane of its values goes on: what lies beyond the border of a
// chart is seen when a texture is filtered. Those further away take the colours around them, for smaller versions of
// the picture; next to charts those of the nearest one (passes/lightmap/borders.h).
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/image/image.h"

namespace wrlkit::combine {

/// In texels, x to the right and y down from the upper left corner of the page.
struct PageTriangle {
  std::array<double, 3> x, y;
  std::uint16_t chart = 1;                                                                       // any number but 0
  double area() const { return (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]); }  // twice, with a sign
};

struct Texel4 {
  std::array<std::uint8_t, 4> rgba;
};

class Page {
 public:
  /// Weights of the three corners at a texel's middle; outside of the triangle they are not all in [0, 1]. Called from
  /// several threads.
  using Paint = std::function<Texel4(std::size_t triangle, const std::array<double, 3>& weights, double x, double y)>;

  Page(int width, int height, double reach);

  /// So many times the texels of the page are looked at, at the most.
  static constexpr std::uint64_t most_layers = 64;

  /// Paints all triangles; of several at a texel's middle the first one. False when they overlap so much that the work
  /// was cut off. O(texels of the triangles).
  bool paint(std::span<const PageTriangle> triangles, const Paint& paint);
  /// The picture, of 3 or 4 channels. O(texels).
  Image image(int channels) const;

 private:
  class Band;
  void extend(std::vector<Texel4>& texels) const;

  int width_, height_;
  double reach_;
  std::vector<Texel4> texels_;
  std::vector<std::uint8_t> distance_;  // to the owner; 0: within it, `nobody`: none
  std::vector<std::uint16_t> chart_;    // of texels that a chart touches; 0: none does
};

}  // namespace wrlkit::combine
