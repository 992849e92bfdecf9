// A page of the atlas while light is baked onto it: for each texel the light that was found there and where in the world
// it lies. Texels are counted from the lower left corner, as texture coordinates are; row 0 is the lowest.
#pragma once
#include <cstdint>
#include <vector>

#include "passes/lightmap/rgb.h"

namespace wrlkit::bake {

struct Vec {
  float x = 0, y = 0, z = 0;
};
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline float dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Where a texel lies: what the denoiser compares.
struct Place {
  static constexpr std::uint32_t nowhere = 0xffffffff;

  std::uint32_t chart = nowhere;  // texels of several charts are never mixed
  Vec position, normal;           // world, relative to the centre of the world; the normal is unit
};

struct Page {
  int width = 0, height = 0;
  /// The first is light: irradiance over pi. Others may follow, which are denoised as it is.
  std::vector<std::vector<Rgb>> layers;
  std::vector<float> variance;           // of the luminance of the light
  std::vector<Place> places;

  Page(int w, int h, std::size_t n_layers = 1)
      : width(w), height(h), layers(n_layers, std::vector<Rgb>(size())), variance(size()), places(size()) {}

  std::size_t size() const { return std::size_t(width) * height; }
  std::size_t at(int x, int y) const { return std::size_t(y) * width + x; }
  bool covered(std::size_t i) const { return places[i].chart != Place::nowhere; }
  std::vector<Rgb>& light() { return layers[0]; }
  const std::vector<Rgb>& light() const { return layers[0]; }
};

}  // namespace wrlkit::bake
