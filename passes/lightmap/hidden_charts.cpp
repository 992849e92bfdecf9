#include "passes/lightmap/hidden_charts.h"

#include <cmath>
#include <map>
#include <optional>

#include "geometry/closest_point.h"

namespace wrlkit::bake {
namespace {

struct Chart {
  std::size_t n = 0, n_known = 0;
  Vec3 middle{};
  Rgb light;

  bool is_hidden() const { return n && !n_known; }
};

std::vector<Chart> charts_of(const Page& page, std::span<const std::uint32_t> chart, std::span<const char> known,
                             std::span<const Rgb> light) {
  std::vector<Chart> out;
  for (std::size_t i = 0; i < chart.size(); ++i) {
    if (chart[i] == TexelPlace::nowhere) continue;
    if (chart[i] >= out.size()) out.resize(std::size_t{chart[i]} + 1);
    Chart& c = out[chart[i]];
    const Vec& p = page.places[i].position;
    c.middle = c.middle + Vec3{p.x, p.y, p.z};
    ++c.n;
    if (!known[i]) continue;
    c.light += light[i];
    ++c.n_known;
  }
  for (Chart& c : out) {
    if (c.n) c.middle = (1 / static_cast<double>(c.n)) * c.middle;
    if (c.n_known) c.light = (1 / static_cast<float>(c.n_known)) * c.light;
  }
  return out;
}

/// Of a Shape. Their middles are triangles without area.
struct LitCharts {
  std::vector<std::uint32_t> charts, corners;
  std::vector<double> middles;
  std::optional<ClosestPoint> nearest;

  void add(std::uint32_t number, const Chart& c) {
    corners.insert(corners.end(), 3, static_cast<std::uint32_t>(charts.size()));
    middles.insert(middles.end(), c.middle.begin(), c.middle.end());
    charts.push_back(number);
  }
};

}  // namespace

void light_hidden_charts(const Page& page, std::span<const std::uint32_t> chart, std::span<const std::uint32_t> use_of,
                         std::vector<char>& known, std::vector<Rgb>& light) {
  auto charts = charts_of(page, chart, known, light);
  std::map<std::uint32_t, LitCharts> lit_of;
  for (std::uint32_t c = 0; c < charts.size(); ++c)
    if (charts[c].is_hidden()) lit_of[use_of[c]];
  if (lit_of.empty()) return;
  for (std::uint32_t c = 0; c < charts.size(); ++c)
    if (const auto at = lit_of.find(use_of[c]); at != lit_of.end() && charts[c].n_known) at->second.add(c, charts[c]);
  for (auto& [use, lit] : lit_of) lit.nearest.emplace(Triangles{lit.middles, lit.corners});
  for (std::uint32_t c = 0; c < charts.size(); ++c) {
    if (!charts[c].is_hidden()) continue;
    const LitCharts& lit = lit_of[use_of[c]];
    const auto there = lit.nearest->nearest(charts[c].middle, {0, 1, 0});
    if (std::isfinite(there.distance)) charts[c].light = charts[lit.charts[there.triangle]].light;
  }
  for (std::size_t i = 0; i < chart.size(); ++i)
    if (chart[i] != TexelPlace::nowhere && charts[chart[i]].is_hidden()) {
      light[i] = charts[chart[i]].light;
      known[i] = 1;
    }
}

}  // namespace wrlkit::bake
