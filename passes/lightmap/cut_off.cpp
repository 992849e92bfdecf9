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

/// A texel in the shade and one that is lit.
struct TexelPair {
  std::size_t dark, lit;
};

/// Those in the shade take the mean of what the lit ones had. Pairs of one stand together.
template <class T>
void take_means(const std::vector<TexelPair>& pairs, std::vector<T>& values) {
  std::vector<T> means;
  for (auto first = pairs.begin(), last = first; first != pairs.end(); first = last) {
    T sum{};
    for (; last != pairs.end() && last->dark == first->dark; ++last) sum += values[last->lit];
    means.push_back((1.0f / static_cast<float>(last - first)) * sum);
  }
  auto mean = means.begin();
  for (auto p = pairs.begin(); p != pairs.end(); ++p)
    if (p == pairs.begin() || p->dark != (p - 1)->dark) values[p->dark] = *mean++;
}

}  // namespace

bool is_cut_off(const light::LightWorld& world, Shade shade, const V3& a, const V3& b, const V3& normal_a,
                const V3& normal_b) {
  constexpr double lift = 0.002;       // of the way: above what few bits of a coordinate make of a plane
  constexpr double least_slope = 0.1;  // sine of the angle between what crosses and the way
  constexpr int most = 8;
  const double way = length(b - a);
  if (shade == Shade::none || !(way > 0)) return false;
  auto lifted = [&](const V3& p, const V3& n) { return world.off_surface(p, n, 0) + (lift * way) * n; };
  const V3 from = lifted(a, normal_a), along = lifted(b, normal_b) - from;
  const drawing::Ray ray{from, unit(along)};
  drawing::Hit hit;
  double after = 0;
  for (int i = 0; i < most && world.nearest(ray, after, hit) && hit.distance < length(along); ++i, after = hit.distance)
    if (world.is_clear(hit.use) == (shade == Shade::dim) &&
        std::fabs(dot(unit(hit.across), ray.direction)) > least_slope)
      return true;
  return false;
}

Shade shade_beside(float light, float other) {
  constexpr float dark = 1.0f / 32, dim = 0.5f;
  if (!(other > 0) || light > dim * other) return Shade::none;
  return light <= dark * other ? Shade::dark : Shade::dim;
}

void lighten_cut_off(const Page& page, PageLight& light, const std::vector<char>& inside,
                     const light::LightWorld& world) {
  std::vector<TexelPair> pairs;
  const V3 centre = world.centre();
  for (int y = 0; y < page.height; ++y)
    for (int x = 0; x < page.width; ++x) {
      const auto i = page.at(x, y);
      if (!page.covered(i) || inside[i]) continue;
      const TexelPlace& own = page.places[i];
      each_beside(page, inside, x, y, [&](std::size_t j) {
        const TexelPlace& other = page.places[j];
        const Shade shade = shade_beside(luminance(light.at(i)), luminance(light.at(j)));
        if (shade != Shade::none && is_cut_off(world, shade, centre + v3(other.position), centre + v3(own.position),
                                               v3(other.normal), v3(own.normal)))
          pairs.push_back({i, j});
      });
    }
  if (pairs.empty()) return;
  for (Estimate* e : {&light.direct, &light.gathered}) {
    take_means(pairs, e->light());
    take_means(pairs, e->variance);
  }
  for (auto& layer : light.along) take_means(pairs, layer);
}

}  // namespace wrlkit::bake
