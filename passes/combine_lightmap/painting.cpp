#include "passes/combine_lightmap/painting.h"

#include <algorithm>
#include <cmath>

#include "base/image/srgb_table.h"
#include "passes/combine_lightmap/chart_image.h"

namespace wrlkit::combine {
namespace {

template <std::size_t N>
std::array<double, N> mixed(const Attribute& a, std::uint32_t corner, const std::array<double, 3>& weights) {
  std::array<double, N> out{};
  for (std::uint32_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < N; ++i) out[i] += weights[k] * a.at(a.index[corner + k])[i];
  return out;
}

}  // namespace

Texel4 Painted::color(const std::array<double, 3>& weights, double x, double y, bool alpha) const {
  if (image) {
    const auto [u, v] = at(x, y);
    return image->at(u, v);
  }
  const drawing::Surface& s = *surface;
  std::optional<drawing::Texel> vertex, texel;
  if (mesh->color.present()) {
    auto c = mixed<3>(mesh->color, corner, weights);
    const double opacity = mesh->color.width == 4 ? mixed<4>(mesh->color, corner, weights)[3] : 1;
    for (double& v : c) v = std::clamp(v, 0.0, 1.0);  // weights may lie outside
    vertex = drawing::Texel{{c[0], c[1], c[2]}, std::clamp(opacity, 0.0, 1.0)};
  }
  if (s.picture.texture && mesh->texcoord.present()) {
    const auto place = mixed<2>(mesh->texcoord, corner, weights);
    texel = s.picture.sample(s.texcoords(place[0], place[1]), detail);
  }
  const auto base = s.base(vertex, texel);
  const SrgbTable& table = SrgbTable::get();
  const auto light = s.baked.light.sample(at(x, y), 1).color;
  auto shown = [&](double own, double lit, double emitted) {
    return table.byte(table.linear(own) * s.baked.scale * table.linear(lit) + table.linear(emitted));
  };
  const auto opacity =
      alpha ? static_cast<std::uint8_t>(std::clamp(base.alpha, 0.0, 1.0) * 255 + 0.5) : std::uint8_t{255};
  return {{shown(base.color.x, light.x, s.emissive.x), shown(base.color.y, light.y, s.emissive.y),
           shown(base.color.z, light.z, s.emissive.z), opacity}};
}

double picture_area(const Attribute& a, std::uint32_t corner, const TexcoordMap& map) {
  const float *p = a.at(a.index[corner]), *q = a.at(a.index[corner + 1]), *r = a.at(a.index[corner + 2]);
  return std::abs((double{q[0]} - p[0]) * (double{r[1]} - p[1]) - (double{r[0]} - p[0]) * (double{q[1]} - p[1])) *
         std::abs(map.determinant());
}

double texture_detail(const drawing::Surface& s, const Mesh& mesh, std::uint32_t corner, double texels) {
  if (!s.picture.texture || !mesh.texcoord.present()) return 1;
  const double pixels = double(s.picture.texture->width()) * s.picture.texture->height();
  return std::sqrt(pixels * picture_area(mesh.texcoord, corner, s.texcoords) / texels);
}

void list_triangles(const drawing::Surface& s, const Mesh& mesh, int width, int height,
                    std::vector<PageTriangle>& triangles, std::vector<Painted>& painted) {
  const TexcoordMap to_light{1.0 / width, 0, 0, -1.0 / height, 0, 1};
  for (std::uint32_t c = 0; c < mesh.corners.size(); c += 3) {
    PageTriangle t;
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const float* at = mesh.lightcoord.at(mesh.lightcoord.index[c + corner]);
      const auto [u, v] = s.baked.places(at[0], at[1]);
      t.x[corner] = u * width;
      t.y[corner] = (1 - v) * height;
    }
    const double texels = std::abs(t.area());
    if (!(texels > 0) || !is_near(t)) continue;
    triangles.push_back(t);
    painted.push_back({&s, &mesh, c, texture_detail(s, mesh, c, texels), to_light});
  }
}

bool is_near(const PageTriangle& t) {
  constexpr double far = 1e9;
  auto near = [](double v) { return std::abs(v) < far; };
  return std::ranges::all_of(t.x, near) && std::ranges::all_of(t.y, near);
}

}  // namespace wrlkit::combine
