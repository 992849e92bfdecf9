#include "passes/lightmap/cut_off.h"

#include <algorithm>
#include <cmath>

namespace wrlkit::bake {
namespace {

using drawing::V3;

V3 v3(const Vec& v) { return {v.x, v.y, v.z}; }

/// The texels around one that it may be mixed with.
template <class F>
void each_beside(const Page& page, const std::vector<char>& inside, int x, int y, F&& f) {
  const auto chart = page.places[page.at(x, y)].chart;
  for (int v = std::max(0, y - 1); v <= std::min(page.height - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(page.width - 1, x + 1); ++u)
      if (const auto j = page.at(u, v); page.places[j].chart == chart && !inside[j]) f(j);
}

}  // namespace

bool is_cut_off(const light::LightWorld& world, const V3& a, const V3& b, const V3& normal_a, const V3& normal_b) {
  constexpr double lift = 0.002;       // of the way: above what few bits of a coordinate make of a plane
  constexpr double least_slope = 0.1;  // sine of the angle between what crosses and the way
  constexpr int most = 8;
  const double way = length(b - a);
  if (!(way > 0)) return false;
  auto lifted = [&](const V3& p, const V3& n) { return world.off_surface(p, n, 0) + (lift * way) * n; };
  const V3 from = lifted(a, normal_a), along = lifted(b, normal_b) - from;
  const drawing::Ray ray{from, unit(along)};
  drawing::Hit hit;
  double after = 0;
  for (int i = 0; i < most && world.nearest(ray, after, hit) && hit.distance < length(along); ++i, after = hit.distance)
    if (!world.is_clear(hit.use) && std::fabs(dot(unit(hit.across), ray.direction)) > least_slope) return true;
  return false;
}

bool is_dark_beside(float light, float other) {
  constexpr float share = 1.0f / 32;
  return other > 0 && light <= share * other;
}

void lighten_cut_off(Page& page, const std::vector<char>& inside, const light::LightWorld& world) {
  const Page before = page;
  const V3 centre = world.centre();
  for (int y = 0; y < page.height; ++y)
    for (int x = 0; x < page.width; ++x) {
      const auto i = page.at(x, y);
      if (!page.covered(i) || inside[i]) continue;
      const Place& own = before.places[i];
      std::vector<Rgb> sum(page.layers.size());
      int n = 0;
      each_beside(page, inside, x, y, [&](std::size_t j) {
        const Place& other = before.places[j];
        if (!is_dark_beside(luminance(before.light()[i]), luminance(before.light()[j])) || !is_cut_off(world, centre + v3(other.position), centre + v3(own.position), v3(other.normal), v3(own.normal))) return;
        for (std::size_t l = 0; l < sum.size(); ++l) sum[l] += before.layers[l][j];
        page.variance[i] = std::max(page.variance[i], before.variance[j]), ++n;
      });
      for (std::size_t l = 0; l < sum.size() && n; ++l) page.layers[l][i] = (1.0f / static_cast<float>(n)) * sum[l];
    }
}

}  // namespace wrlkit::bake
