#include "passes/combine_lightmap/light_charts.h"

#include <algorithm>
#include <cmath>

#include "passes/lightmap/connected.h"

namespace wrlkit::combine {
namespace {

using unwrap::Point2;
using unwrap::Point2f;

/// Numbers them by their first triangle.
void number_charts(const Attribute& places, LightCharts& out) {
  const auto root = bake::connected(places.index);
  std::vector<std::uint32_t> number(root.size(), LightCharts::nowhere);
  out.of_place.assign(places.count(), LightCharts::nowhere);
  std::uint32_t n = 0;
  for (std::size_t c = 0; c < places.index.size(); c += 3) {
    auto& mine = number[root[places.index[c]]];
    if (mine == LightCharts::nowhere) mine = n++;
    out.charts.chart_of.push_back(mine);
  }
  for (const std::uint32_t place : places.index) out.of_place[place] = number[root[place]];
  out.charts.sizes.resize(n);
}

void sort_triangles(unwrap::Charts& charts) {
  charts.begin.assign(charts.size() + 1, 0);
  for (const auto chart : charts.chart_of) ++charts.begin[chart + 1];
  for (std::size_t i = 0; i + 1 < charts.begin.size(); ++i) charts.begin[i + 1] += charts.begin[i];
  charts.triangles.resize(charts.chart_of.size());
  auto next = charts.begin;
  for (std::uint32_t t = 0; t < charts.chart_of.size(); ++t) charts.triangles[next[charts.chart_of[t]]++] = t;
}

}  // namespace

std::optional<LightCharts> light_charts(const Mesh& mesh, const TexcoordMap& to_texels) {
  constexpr double far = 1e6;
  const Attribute& places = mesh.lightcoord;
  LightCharts out;
  number_charts(places, out);
  sort_triangles(out.charts);
  std::vector<Point2> at, high(out.charts.size(), {-far, -far});
  out.origin.assign(out.charts.size(), {far, far});
  for (std::size_t c = 0; c < places.index.size(); ++c) {
    const float* place = places.at(places.index[c]);
    const auto [x, y] = to_texels(place[0], place[1]);
    if (!(std::abs(x) < far && std::abs(y) < far)) return {};
    at.push_back({x, y});
    const auto chart = out.charts.chart_of[c / 3];
    out.origin[chart] = {std::min(out.origin[chart].x, x), std::min(out.origin[chart].y, y)};
    high[chart] = {std::max(high[chart].x, x), std::max(high[chart].y, y)};
  }
  for (std::size_t c = 0; c < at.size(); ++c) {
    const Point2 p = at[c] - out.origin[out.charts.chart_of[c / 3]];
    out.charts.places.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
  }
  for (std::size_t i = 0; i < high.size(); ++i) {
    const Point2 size = high[i] - out.origin[i];
    out.charts.sizes[i] = {static_cast<float>(size.x), static_cast<float>(size.y)};
  }
  return out;
}

TexcoordMap inverse(const TexcoordMap& m) {
  const double d = m.determinant();
  TexcoordMap out{m.yy / d, -m.xy / d, -m.yx / d, m.xx / d, 0, 0};
  const Vec2 shift = out(m.x, m.y);
  out.x = -shift[0];
  out.y = -shift[1];
  return out;
}

}  // namespace wrlkit::combine
