#include "light/path_picture.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/parallel.h"
#include "light/transport.h"

namespace wrlkit::light {
namespace {

constexpr std::uint64_t seed = 1;
constexpr std::size_t pixel_block = 64;  // pixels that are done in one piece
constexpr std::size_t stretches = 100;
constexpr double middle_grey = 0.18;  // of what reflects all light

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

using Pixel = std::array<float, 3>;  // linear

V3 vec(const Pixel& p) { return {p[0], p[1], p[2]}; }

/// Noise makes a logarithmic mean too low: the mean is taken of squares of pixels.
double exposure_of(const std::vector<Pixel>& light, std::size_t width, std::size_t height) {
  constexpr std::size_t side = 8;
  LightMeter meter;
  for (std::size_t top = 0; top < height; top += side)
    for (std::size_t left = 0; left < width; left += side) {
      double sum = 0;
      const std::size_t bottom = std::min(height, top + side), right = std::min(width, left + side);
      for (std::size_t y = top; y < bottom; ++y)
        for (std::size_t x = left; x < right; ++x) sum += mean(vec(light[y * width + x]));
      meter.add(sum / static_cast<double>((bottom - top) * (right - left)));
    }
  return meter.factor(middle_grey);
}

void show(const V3& light, std::uint8_t* pixel) {
  for (double v : {light.x, light.y, light.z}) *pixel++ = static_cast<std::uint8_t>(linear_to_srgb(v) * 255 + 0.5);
}

}  // namespace

Image path_picture(const Scene& scene, const MeshSource& source, const drawing::Camera& camera,
                   const PathOptions& options, Resources* resources, Diagnostics& diag) {
  const LightWorld world(scene, source, resources,
                         {.lamps = options.lamps, .viewer = camera.pose(), .level_of = options.level_of}, diag);
  report(world, diag);
  const Painter painter(world, camera, options);
  const auto width = static_cast<std::size_t>(camera.width), n = width * static_cast<std::size_t>(camera.height);
  Image image{camera.width, camera.height, 3, std::vector<std::uint8_t>(n * 3)};
  std::vector<Pixel> light(options.exposure.automatic ? n : 0);
  auto paint = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const V3 c = options.exposure.factor * painter.pixel(i % width, i / width);
      if (light.empty())
        show(c, &image.pixels[i * 3]);
      else
        light[i] = {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)};
    }
  };
  const std::size_t n_blocks = (n + pixel_block - 1) / pixel_block, stretch = (n_blocks + stretches - 1) / stretches;
  for (std::size_t b = 0; b < n_blocks; b += stretch) {
    parallel_for(std::min(stretch, n_blocks - b),
                 [&](std::size_t i) { paint((b + i) * pixel_block, std::min(n, (b + i + 1) * pixel_block)); });
    if (options.done)
      options.done(static_cast<double>(std::min(b + stretch, n_blocks)) / static_cast<double>(n_blocks));
  }
  if (light.empty()) return image;
  const double factor = exposure_of(light, width, image.height);
  diag.report(Diag::light_exposure, {}, Exposure{.factor = factor}.print(), Exposure{.factor = factor}.print());
  for (std::size_t i = 0; i < n; ++i) show(factor * vec(light[i]), &image.pixels[i * 3]);
  return image;
}

}  // namespace wrlkit::light
