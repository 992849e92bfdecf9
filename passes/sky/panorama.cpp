#include "passes/sky/panorama.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "light/render/background.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

constexpr int width = 2048, height = width / 2;

drawing::V3 direction_of(int x, int y) {
  const double longitude = ((x + 0.5) / width - 0.5) * 2 * std::numbers::pi,
               latitude = (0.5 - (y + 0.5) / height) * std::numbers::pi;
  return {std::cos(latitude) * std::cos(longitude), std::sin(latitude), std::cos(latitude) * std::sin(longitude)};
}

std::uint8_t byte_of(double v) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0))); }

}  // namespace

std::shared_ptr<const std::string> sky_panorama(const Scene& scene, PassContext& ctx) {
  Diagnostics silent(ctx.diag.shared_sources());  // the pictures are reported with the dome
  const auto stage = drawing::set_stage(scene, silent);
  if (!stage.background) return nullptr;
  const drawing::Sky sky(scene, stage.background->node, stage.frames[stage.background->frame], ctx.resources, silent);
  Image image{width, height, 3, {}};
  image.pixels.reserve(std::size_t{3} * width * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const drawing::V3 c = sky.color(direction_of(x, y), std::numbers::pi / height);
      for (const double v : {c.x, c.y, c.z}) image.pixels.push_back(byte_of(v));
    }
  std::string fault;
  auto png = encode_png(image, fault);
  return png ? std::make_shared<const std::string>(std::move(*png)) : nullptr;
}

}  // namespace wrlkit
