// Charts grow one after the other, each from the largest triangle that is left.
#include "geometry/unwrap/unfold.h"

#include <algorithm>

#include "geometry/unwrap/grower.h"
#include "geometry/unwrap/joints.h"
#include "geometry/unwrap/turn.h"

namespace wrlkit::unwrap {
namespace {

std::vector<std::uint32_t> seeds_of(const Links& links) {
  std::vector<std::uint32_t> seeds;
  for (std::uint32_t t = 0; t < links.n_triangles(); ++t)
    if (links.area(t) > 0) seeds.push_back(t);
  std::sort(seeds.begin(), seeds.end(), [&](std::uint32_t a, std::uint32_t b) {
    return links.area(a) != links.area(b) ? links.area(a) > links.area(b) : a < b;
  });
  return seeds;
}

void add_chart(Charts& charts, const Flattened& chart, const std::vector<Point2>& points, Point2 size) {
  auto number = static_cast<std::uint32_t>(charts.size());
  charts.sizes.push_back({static_cast<float>(size.x), static_cast<float>(size.y)});
  for (std::size_t i = 0; i < chart.triangles.size(); ++i) {
    std::uint32_t t = chart.triangles[i];
    charts.chart_of[t] = number;
    for (std::size_t k = 0; k < 3; ++k) {
      Point2 p = points[chart.corner_point[3 * i + k]];
      charts.places[3 * std::size_t{t} + k] = {static_cast<float>(p.x), static_cast<float>(p.y)};
    }
  }
}

/// What no chart reached has no area: all of it is one point.
void add_rest(Charts& charts) {
  auto number = static_cast<std::uint32_t>(charts.size());
  bool any = false;
  for (std::uint32_t& c : charts.chart_of)
    if (c == none) {
      c = number;
      any = true;
    }
  if (any) charts.sizes.push_back({});
}

void list_triangles(Charts& charts) {
  charts.begin.assign(charts.size() + 1, 0);
  for (std::uint32_t c : charts.chart_of) ++charts.begin[c + 1];
  for (std::size_t i = 0; i < charts.size(); ++i) charts.begin[i + 1] += charts.begin[i];
  std::vector<std::uint32_t> at = charts.begin;
  charts.triangles.resize(charts.chart_of.size());
  for (std::uint32_t t = 0; t < charts.chart_of.size(); ++t) charts.triangles[at[charts.chart_of[t]]++] = t;
}

}  // namespace

Charts unfold(const UnfoldInput& in, const UnfoldOptions& options) {
  Links links(in, options.crease_angle);
  cut_joints(links);
  Grower grower(links, options);
  Turner turner;
  Charts charts;
  charts.places.resize(3 * std::size_t{links.n_triangles()});
  charts.chart_of.assign(links.n_triangles(), none);
  std::vector<Point2> points;
  for (std::uint32_t seed : seeds_of(links)) {
    if (grower.taken(seed)) continue;
    const Flattened& chart = grower.grow(seed);
    points = chart.points;
    Point2 size = turner.turn(points);
    add_chart(charts, chart, points, size);
  }
  add_rest(charts);
  list_triangles(charts);
  return charts;
}

}  // namespace wrlkit::unwrap
