// A flat polygon and the patches on it, turned to face the camera and drawn: Lazanyi's "snapshot" (3.2).
#pragma once
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "base/math/box.h"
#include "light/render/linear.h"

namespace wrlkit::light {

using drawing::V3;

/// The plane of a polygon as a picture has it: x to the right, y up. Walls stand upright; floors have -Z up, as seen
/// from above.
struct PictureFrame {
  V3 origin, right, up;

  static PictureFrame facing(const V3& normal, const V3& origin);
  Vec2 place(const V3& p) const { return {dot(p - origin, right), dot(p - origin, up)}; }
};

struct FlatPatch {
  std::array<Vec2, 3> corners;  // in a PictureFrame, metres
  std::array<V3, 3> colors;     // of the corners
};

struct PictureOptions {
  double texel = 0.01;  // metres
  int samples = 4;      // places a texel along each side
  int border = 2;       // texels around the box that go on with its colours
};

/// Linear colours, the top row first.
struct FloatPicture {
  int width = 0, height = 0;
  std::vector<V3> pixels;

  V3& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// Texels that no patch covers go on as those around them. O(patches + texels * samples^2).
FloatPicture draw(std::span<const FlatPatch> patches, const Box2& box, const PictureOptions& options);

/// The size of that picture. Its lower left corner is that of the box, less the border.
std::array<int, 2> picture_size(const Box2& box, const PictureOptions& options);

}  // namespace wrlkit::light
