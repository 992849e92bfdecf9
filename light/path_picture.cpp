#include "light/path_picture.h"

#include "base/parallel.h"
#include "light/transport.h"

namespace wrlkit::light {
namespace {

constexpr std::uint64_t seed = 1;
constexpr std::size_t pixel_block = 64;  // pixels that are done in one piece
constexpr std::size_t stretches = 100;

void report(const LightWorld& world, Diagnostics& diag) {
  std::size_t n_thin = 0;
  for (std::uint32_t mesh : world.mesh_of()) n_thin += world.meshes()[mesh].kind != Mesh::Kind::faces;
  if (n_thin) diag.report(Diag::no_path_lines, {}, n_thin);
  if (!world.has_sky_of_its_own()) diag.report(Diag::no_light, {});
}

class Painter {
 public:
  Painter(const LightWorld& world, const drawing::Camera& camera, const PathOptions& options)
      : camera_(camera), options_(options), direct_(world), transport_(world, direct_, nullptr) {}

  /// Random numbers belong to a pixel, so that pixels may be done in any order.
  V3 pixel(std::size_t x, std::size_t y) const {
    const int n = options_.samples;
    RandomStream random(random_key(seed, y, x));
    V3 sum;
    for (int v = 0; v < n; ++v)
      for (int u = 0; u < n; ++u) {
        const double px = static_cast<double>(x) + (u + random.next()) / n,
                     py = static_cast<double>(y) + (v + random.next()) / n;
        sum += transport_.seen({camera_.eye, camera_.direction(px, py)}, random, options_.background);
      }
    return (1.0 / (n * n)) * sum;
  }

 private:
  const drawing::Camera& camera_;
  const PathOptions& options_;
  DirectLight direct_;
  Transport transport_;
};

}  // namespace

Image path_picture(const Scene& scene, const MeshSource& source, const drawing::Camera& camera,
                   const PathOptions& options, Resources* resources, Diagnostics& diag) {
  const LightWorld world(scene, source, resources, {.viewer = camera.pose(), .level_of = options.level_of}, diag);
  report(world, diag);
  const Painter painter(world, camera, options);
  const auto width = static_cast<std::size_t>(camera.width), n = width * static_cast<std::size_t>(camera.height);
  Image image{camera.width, camera.height, 3, std::vector<std::uint8_t>(n * 3)};
  auto paint = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const V3 c = painter.pixel(i % width, i / width);
      auto* out = image.pixels.data() + i * 3;
      for (double v : {c.x, c.y, c.z}) *out++ = static_cast<std::uint8_t>(linear_to_srgb(v) * 255 + 0.5);
    }
  };
  const std::size_t n_blocks = (n + pixel_block - 1) / pixel_block, stretch = (n_blocks + stretches - 1) / stretches;
  for (std::size_t b = 0; b < n_blocks; b += stretch) {
    parallel_for(std::min(stretch, n_blocks - b),
                 [&](std::size_t i) { paint((b + i) * pixel_block, std::min(n, (b + i + 1) * pixel_block)); });
    if (options.done)
      options.done(static_cast<double>(std::min(b + stretch, n_blocks)) / static_cast<double>(n_blocks));
  }
  return image;
}

}  // namespace wrlkit::light
