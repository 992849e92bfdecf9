#include "light/render/inspect.h"

#include <algorithm>
#include <cmath>

#include "light/render/picture_place.h"

namespace wrlkit::drawing {
namespace {

const V3 paper{0.55};  // what has no lightmap

/// Blue, cyan, green, yellow, red for 0 to 1.
V3 ramp(double t) {
  constexpr int n = 5;
  const V3 colors[n] = {{0.1, 0.2, 0.9}, {0, 0.8, 0.9}, {0.1, 0.8, 0.2}, {0.95, 0.85, 0.1}, {0.9, 0.1, 0.1}};
  double x = std::clamp(t, 0.0, 1.0) * (n - 1);
  int i = std::min(static_cast<int>(x), n - 2);
  return mix(colors[i], colors[i + 1], x - i);
}

bool is_dark(double x, double y) {
  auto parity = [](double v) { return static_cast<std::int64_t>(std::floor(v)) & 1; };
  return parity(x) != parity(y);
}

}  // namespace

V3 Inspector::color(double px, double py) const {
  Ray ray{camera_.eye, camera_.direction(px, py)};
  Hit hit;
  if (!tracer_.nearest(ray, 0, hit)) return background_;
  if (drawing_.meshes[drawing_.mesh_of[hit.use]].kind != Mesh::Kind::faces) return paper;
  Spot spot = spot_at(drawing_, ray, hit);
  double area = length(spot.face), facing = area > 0 ? std::fabs(dot(spot.face, ray.direction)) / area : 1;
  if (mode_ == RenderOptions::Mode::albedo) return albedo(hit, area, facing);
  V3 c = light(hit, area, facing);
  // A little form, where colours are signs and not light.
  return mode_ == RenderOptions::Mode::lightmap ? c : (0.7 + 0.3 * facing) * c;
}

V3 Inspector::albedo(const Hit& hit, double area, double facing) const {
  const MeshPool& pool = drawing_.meshes;
  const PooledMesh& m = pool[drawing_.mesh_of[hit.use]];
  const Surface& s = drawing_.surfaces[drawing_.surface_of[hit.use]];
  return s.base(vertex_color(pool, m, hit), texel_of(drawing_, s, hit, camera_, {area, facing})).color;
}

V3 Inspector::light(const Hit& hit, double area, double facing) const {
  const MeshPool& pool = drawing_.meshes;
  const PooledMesh& m = pool[drawing_.mesh_of[hit.use]];
  const BakedLight& baked = drawing_.surfaces[drawing_.surface_of[hit.use]].baked;
  auto place = baked ? place_of(pool, m, hit, pool.lightcoords, m.lightcoords, baked.places, area) : std::nullopt;
  if (!place) return paper;
  const Texture& page = *baked.light.texture;
  switch (mode_) {
    case RenderOptions::Mode::checker:
      return is_dark(place->at[0] * page.width(), place->at[1] * page.height()) ? V3(0.2) : V3(0.9);
    case RenderOptions::Mode::density:
      return ramp(std::log2(std::sqrt(place->density * page.width() * page.height())) /
                  std::log2(most_texels_per_metre));
    case RenderOptions::Mode::lightmap:
    case RenderOptions::Mode::albedo:
    case RenderOptions::Mode::preview:
    case RenderOptions::Mode::path:
    case RenderOptions::Mode::wireframe:
      break;
  }
  return to_srgb(baked.at(place->at, place->detail(page, hit, camera_, facing)));
}

}  // namespace wrlkit::drawing
