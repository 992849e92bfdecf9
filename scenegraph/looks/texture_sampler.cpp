#include "scenegraph/looks/texture_sampler.h"

#include <algorithm>

#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

namespace p = nodes::texture_properties;
using Minified = TextureSampler::Minified;

Wrap wrap_of(std::string_view mode) {
  if (mode == "MIRRORED_REPEAT") return Wrap::mirror;
  return mode.starts_with("CLAMP") ? Wrap::clamp : Wrap::repeat;
}

constexpr std::pair<std::string_view, Minified> filters[] = {
    {"NEAREST_PIXEL", Minified::nearest},
    {"AVG_PIXEL", Minified::linear},
    {"NEAREST_PIXEL_NEAREST_MIPMAP", Minified::nearest_mipmap_nearest},
    {"AVG_PIXEL_NEAREST_MIPMAP", Minified::linear_mipmap_nearest},
    {"NEAREST_PIXEL_AVG_MIPMAP", Minified::nearest_mipmap_linear},
    {"AVG_PIXEL_AVG_MIPMAP", Minified::linear_mipmap_linear}};

/// FASTEST, NICEST and DEFAULT leave it to the viewer.
Minified minified_of(std::string_view filter) {
  const auto at = std::ranges::find(filters, filter, &std::pair<std::string_view, Minified>::first);
  return at == std::end(filters) ? Minified::linear_mipmap_linear : at->second;
}

TextureSampler sampler_of(const Scene& scene, bool repeat_s, bool repeat_t, NodeId properties) {
  if (!scene.is(properties, nodes::TextureProperties))
    return {.s = repeat_s ? Wrap::repeat : Wrap::clamp, .t = repeat_t ? Wrap::repeat : Wrap::clamp};
  return {.s = wrap_of(scene.get(properties, p::boundaryModeS)),
          .t = wrap_of(scene.get(properties, p::boundaryModeT)),
          .nearest = scene.get(properties, p::magnificationFilter) == "NEAREST_PIXEL",
          .minified = minified_of(scene.get(properties, p::minificationFilter))};
}

}  // namespace

std::string_view minification_filter(Minified minified) {
  return std::ranges::find(filters, minified, &std::pair<std::string_view, Minified>::second)->first;
}

TextureSampler read_sampler(const Scene& scene, NodeId n) {
  namespace i = nodes::image_texture;
  namespace x = nodes::pixel_texture;
  if (scene.is(n, nodes::ImageTexture))
    return sampler_of(scene, scene.get(n, i::repeatS), scene.get(n, i::repeatT), scene.get(n, i::textureProperties));
  if (scene.is(n, nodes::PixelTexture))
    return sampler_of(scene, scene.get(n, x::repeatS), scene.get(n, x::repeatT), scene.get(n, x::textureProperties));
  return {};
}

}  // namespace wrlkit
