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

}  // namespace

std::string_view minification_filter(Minified minified) {
  return std::ranges::find(filters, minified, &std::pair<std::string_view, Minified>::second)->first;
}

NodeId texture_properties(const Scene& scene, NodeId n) {
  const NodeId properties = scene.is(n, nodes::ImageTexture)   ? scene.get(n, nodes::image_texture::textureProperties)
                            : scene.is(n, nodes::PixelTexture) ? scene.get(n, nodes::pixel_texture::textureProperties)
                                                               : NodeId{};
  return scene.is(properties, nodes::TextureProperties) ? properties : NodeId{};
}

TextureSampler read_sampler(const Scene& scene, NodeId n) {
  const auto wrap = [](bool repeats) { return repeats ? Wrap::repeat : Wrap::clamp; };
  if (const NodeId properties = texture_properties(scene, n))
    return {.s = wrap_of(scene.get(properties, p::boundaryModeS)),
            .t = wrap_of(scene.get(properties, p::boundaryModeT)),
            .nearest = scene.get(properties, p::magnificationFilter) == "NEAREST_PIXEL",
            .minified = minified_of(scene.get(properties, p::minificationFilter))};
  namespace i = nodes::image_texture;
  namespace x = nodes::pixel_texture;
  if (scene.is(n, nodes::ImageTexture))
    return {.s = wrap(scene.get(n, i::repeatS)), .t = wrap(scene.get(n, i::repeatT))};
  if (scene.is(n, nodes::PixelTexture))
    return {.s = wrap(scene.get(n, x::repeatS)), .t = wrap(scene.get(n, x::repeatT))};
  return {};
}

}  // namespace wrlkit
