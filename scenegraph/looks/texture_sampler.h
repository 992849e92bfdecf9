// How a picture goes on beyond its border and between its pixels: repeatS and repeatT (ISO/IEC 14772-1, 6.22), or a
// TextureProperties, which stands above them (ISO/IEC 19775-1, 18.4.9).
#pragma once
#include <algorithm>
#include <cstdint>

#include "scenegraph/scene.h"

namespace wrlkit {

enum class Wrap : std::uint8_t { repeat, clamp, mirror };

/// The pixel, of n, that lies at place i of the row: going round, back and forth, or stopping at the border.
inline int wrapped(std::int64_t i, int n, Wrap wrap) {
  if (wrap == Wrap::clamp) return static_cast<int>(std::clamp<std::int64_t>(i, 0, n - 1));
  const std::int64_t period = wrap == Wrap::mirror ? 2 * std::int64_t{n} : n;
  const std::int64_t r = i % period, place = r < 0 ? r + period : r;
  return static_cast<int>(place < n ? place : period - 1 - place);
}

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

/// The TextureProperties of an ImageTexture or PixelTexture; none: it has none.
NodeId texture_properties(const Scene&, NodeId texture);
/// Of an ImageTexture or PixelTexture; the usual one for others. Borders of a colour are those of the picture.
TextureSampler read_sampler(const Scene&, NodeId texture);

}  // namespace wrlkit
