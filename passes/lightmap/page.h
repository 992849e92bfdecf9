// A page of the atlas while light is baked onto it: for each texel where in the world it lies, and the light that was
// found there. Texels are counted from the lower left corner, as texture coordinates are; row 0 is the lowest.
#pragma once
#include <cstdint>
#include <vector>

#include "passes/lightmap/rgb.h"

namespace wrlkit::bake {

/// Its operators are friends, so that they do not hide those of Vec3 from this namespace.
struct Vec {
  float x = 0, y = 0, z = 0;

  friend Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend float dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
};

/// Where a texel lies: what the denoiser compares.
struct TexelPlace {
  static constexpr std::uint32_t nowhere = 0xffffffff;

  std::uint32_t chart = nowhere;  // texels of several charts are never mixed
  Vec position, normal;           // world, relative to the centre of the world; the normal is unit
};

struct Page {
  int width = 0, height = 0;
  std::vector<TexelPlace> places;

  Page(int w, int h) : width(w), height(h), places(size()) {}

  std::size_t size() const { return std::size_t(width) * height; }
  std::size_t at(int x, int y) const { return std::size_t(y) * width + x; }
  bool covered(std::size_t i) const { return places[i].chart != TexelPlace::nowhere; }
};

/// What rays found of the light, by texel of a page.
struct Estimate {
  /// The first is light: irradiance over pi. Others may follow, which are denoised as it is.
  std::vector<std::vector<Rgb>> layers;
  std::vector<float> variance;  // of the luminance of the light

  explicit Estimate(const Page& page, std::size_t n_layers = 1)
      : layers(n_layers, std::vector<Rgb>(page.size())), variance(page.size()) {}

  std::vector<Rgb>& light() { return layers[0]; }
  const std::vector<Rgb>& light() const { return layers[0]; }
};

/// Light of a page by two estimates, which add up: by rays to lamps and emitters, and by rays in all directions. The
/// edges of shadows are in the one, so that the noise of the other can be taken out across them.
struct PageLight {
  Estimate direct, gathered;
  std::vector<std::vector<Rgb>>
      along;  // of both: times x, y and z of the direction to where it comes from; empty unless that is wanted

  PageLight(const Page& page, bool directional)
      : direct(page), gathered(page), along(directional ? 3 : 0, std::vector<Rgb>(page.size())) {}

  Rgb at(std::size_t i) const { return direct.light()[i] + gathered.light()[i]; }
};

}  // namespace wrlkit::bake
