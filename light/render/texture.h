// A picture that is laid over a surface: a pyramid of halved pictures, read bilinearly from the one whose pixels are
// about as large as those of the screen.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "light/render/linear.h"
#include "scenegraph/looks/texture_sampler.h"
#include "scenegraph/resources.h"

namespace wrlkit::drawing {

struct Texel {
  V3 color{1};
  double alpha = 1;
};

class Texture {
 public:
  /// What its smaller pictures are means of: of light, as display values of colours stand for it, or of the numbers.
  enum class Means : std::uint8_t { light, numbers };

  /// Null when the picture has no pixels.
  static std::shared_ptr<const Texture> make(const Image& image, Means means = Means::light);

  /// s to the right, t upwards, the picture in [0, 1]. `detail` is the number of its pixels that one sample spans.
  /// Where it is clamped, the pixels of the border go on.
  Texel sample(double s, double t, double detail, const TextureSampler& sampler) const;

  int width() const { return levels_[0].width; }
  int height() const { return levels_[0].height; }
  bool is_grey() const { return channels_ < 3; }
  bool has_alpha() const { return channels_ % 2 == 0; }

 private:
  struct Level {
    int width, height;
    std::vector<std::uint8_t> pixels;
  };
  Level half(const Level& from, Means means) const;
  void blend(const Level& level, double s, double t, const TextureSampler& sampler, double weight, double out[4]) const;

  int channels_ = 0;
  std::vector<Level> levels_;
};

/// SFImage (5.5): width, height, components, then a number a pixel, the lowest row first. Without pixels when it has
/// none or fewer than it says.
Image image_of(std::span<const std::int32_t> sfimage);

}  // namespace wrlkit::drawing
