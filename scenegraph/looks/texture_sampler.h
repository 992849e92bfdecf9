// How a picture goes on beyond its border and between its pixels: repeatS and repeatT (ISO/IEC 14772-1, 6.22), or a
// TextureProperties, which stands above them (ISO/IEC 19775-1, 18.4.9).
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit {

enum class Wrap : std::uint8_t { repeat, clamp, mirror };

struct TextureSampler {
  /// Of a picture that is shown smaller, by their numbers in glTF 2.0 (5.27): within a level of its pyramid, and
  /// between levels.
  enum class Minified : std::uint16_t {
    nearest = 9728,
    linear = 9729,
    nearest_mipmap_nearest = 9984,
    linear_mipmap_nearest = 9985,
    nearest_mipmap_linear = 9986,
    linear_mipmap_linear = 9987
  };

  Wrap s = Wrap::repeat, t = Wrap::repeat;
  bool nearest = false;  // shown larger, its pixels are squares
  Minified minified = Minified::linear_mipmap_linear;

  bool operator==(const TextureSampler&) const = default;
};

/// The value of TextureProperties.minificationFilter that means it.
std::string_view minification_filter(TextureSampler::Minified);

/// Of an ImageTexture or PixelTexture; the usual one for others. Borders of a colour are those of the picture.
TextureSampler read_sampler(const Scene&, NodeId texture);

}  // namespace wrlkit
