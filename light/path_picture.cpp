#include "light/path_picture.h"

#include <algorithm>
#include <utility>
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

/// What is seen in a pixel: each surface, and each thing behind something transparent, with its share. Shares are 1
/// together.
class Seen {
 public:
  void add(const SeenFace& face, double share, const V3& radiance) {
    auto at = std::ranges::find(parts_, face, &Part::face);
    if (at == parts_.end()) at = parts_.insert(at, {face, {}, 0});
    at->light += share * radiance;
    at->share += share;
  }
  void scale(double by) {
    for (Part& p : parts_) p = {p.face, by * p.light, by * p.share};
  }

  V3 light() const {
    V3 sum;
    for (const Part& p : parts_) sum += p.light;
    return sum;
  }

  /// As a browser mixes it, from the colours that are displayed: what is behind something transparent, and what is on
  /// both sides of an edge. Of one surface the light itself is mixed.
  V3 shown(double exposure) const {
    V3 sum;
    for (const Part& p : parts_) {
      const V3 light = (exposure / p.share) * p.light;
      sum += p.share * V3(linear_to_srgb(light.x), linear_to_srgb(light.y), linear_to_srgb(light.z));
    }
    return sum;
  }

 private:
  struct Part {
    SeenFace face;
    V3 light;
    double share = 0;
  };
  std::vector<Part> parts_;
};

class Painter {
 public:
  Painter(const LightWorld& world, const drawing::Camera& camera, const PathOptions& options)
      : camera_(camera), options_(options), direct_(world), transport_(world, direct_, nullptr) {}

  /// Random numbers belong to a pixel, so that pixels may be done in any order.
  Seen pixel(std::size_t x, std::size_t y) const {
    const int n = options_.samples;
    const std::uint64_t key = random_key(seed, y, x);
    RandomStream random(key);
    Seen out;
    for (int v = 0; v < n; ++v)
      for (int u = 0; u < n; ++u) {
        const double px = static_cast<double>(x) + (u + random.next()) / n,
                     py = static_cast<double>(y) + (v + random.next()) / n;
        transport_.each_seen(
            {camera_.eye, camera_.direction(px, py)}, key, static_cast<std::uint32_t>(v * n + u), options_.background,
            [&](const SeenFace& face, double part, const V3& radiance) { out.add(face, part, radiance); });
      }
    out.scale(1.0 / (n * n));
    return out;
  }

 private:
  const drawing::Camera& camera_;
  const PathOptions& options_;
  DirectLight direct_;
  Transport transport_;
};

/// Noise makes a logarithmic mean too low: the mean is taken of squares of pixels.
double exposure_of(const std::vector<Seen>& seen, std::size_t width, std::size_t height) {
  constexpr std::size_t side = 8;
  LightMeter meter;
  for (std::size_t top = 0; top < height; top += side)
    for (std::size_t left = 0; left < width; left += side) {
      double sum = 0;
      const std::size_t bottom = std::min(height, top + side), right = std::min(width, left + side);
      for (std::size_t y = top; y < bottom; ++y)
        for (std::size_t x = left; x < right; ++x) sum += mean(seen[y * width + x].light());
      meter.add(sum / static_cast<double>((bottom - top) * (right - left)));
    }
  return meter.factor(middle_grey);
}

void show(const V3& display, std::uint8_t* pixel) {
  for (double v : {display.x, display.y, display.z}) *pixel++ = static_cast<std::uint8_t>(v * 255 + 0.5);
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
  std::vector<Seen> seen(options.exposure.automatic ? n : 0);
  auto paint = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      Seen pixel = painter.pixel(i % width, i / width);
      if (seen.empty())
        show(pixel.shown(options.exposure.factor), &image.pixels[i * 3]);
      else
        seen[i] = std::move(pixel);
    }
  };
  const std::size_t n_blocks = (n + pixel_block - 1) / pixel_block, stretch = (n_blocks + stretches - 1) / stretches;
  for (std::size_t b = 0; b < n_blocks; b += stretch) {
    parallel_for(std::min(stretch, n_blocks - b),
                 [&](std::size_t i) { paint((b + i) * pixel_block, std::min(n, (b + i + 1) * pixel_block)); });
    if (options.done)
      options.done(static_cast<double>(std::min(b + stretch, n_blocks)) / static_cast<double>(n_blocks));
  }
  if (seen.empty()) return image;
  const double factor = exposure_of(seen, width, image.height);
  const auto said = Exposure{.factor = factor}.print();
  diag.report(Diag::light_exposure, {}, said, "--exposure " + said);
  for (std::size_t i = 0; i < n; ++i) show(seen[i].shown(factor), &image.pixels[i * 3]);
  return image;
}

}  // namespace wrlkit::light
