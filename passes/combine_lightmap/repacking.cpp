#include "passes/combine_lightmap/repacking.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/parallel.h"
#include "passes/lightmap/borders.h"
#include "passes/lightmap/whole_pages.h"

namespace wrlkit::combine {
namespace {

using unwrap::Placement;
using unwrap::Point2;

TexcoordMap scaling(double x, double y) { return {x, 0, 0, y, 0, 0}; }
TexcoordMap shift(double x, double y) { return {1, 0, 0, 1, x, y}; }
/// Of a picture of that height: y upwards instead of downwards, and back.
TexcoordMap flip(double height) { return {1, 0, 0, -1, 0, height}; }

/// Placement::apply as a map.
TexcoordMap map_of(const Placement& p) {
  const Point2 o = p.apply({0, 0}), x = p.apply({1, 0}) - o, y = p.apply({0, 1}) - o;
  return {x.x, y.x, x.y, y.y, o.x, o.y};
}

/// Of a picture of a chart in the middle of its box, y down: where the chart's own places are.
TexcoordMap in_box(const ChartImage& image, double scale) {
  return flip(image.height()) * shift(image.margin().x, image.margin().y) * scaling(scale, scale);
}

/// To less than a hundredth of a texel: short in text.
double rounded(double place, double side) {
  const double steps = std::pow(10, std::ceil(std::log10(50 * side)));
  return std::round(place * steps) / steps;
}

double width_of(const drawing::Surface& s) { return s.baked.light.texture->width(); }
double height_of(const drawing::Surface& s) { return s.baked.light.texture->height(); }

/// What the texels of a chart show of the texture, in the mean over them.
double detail_of(const drawing::Surface& s, const Mesh& mesh, const unwrap::Charts& charts, std::uint32_t chart) {
  if (!s.picture.texture || !mesh.texcoord.present()) return 1;
  double pixels = 0, texels = 0;
  for (std::uint32_t i = charts.begin[chart]; i < charts.begin[chart + 1]; ++i) {
    const unwrap::Point2f* p = &charts.places[3 * std::size_t{charts.triangles[i]}];
    texels += std::abs(double{p[1].x - p[0].x} * (p[2].y - p[0].y) - double{p[2].x - p[0].x} * (p[1].y - p[0].y));
    pixels += picture_area(mesh.texcoord, 3 * charts.triangles[i], s.texcoords);
  }
  pixels *= double(s.picture.texture->width()) * s.picture.texture->height();
  return texels > 0 ? std::sqrt(pixels / texels) : 1;
}

}  // namespace

Repacking::Repacking(std::span<const Item> shapes, const MeshOf& mesh_of, const RepackOptions& options)
    : shapes_(shapes), options_(options) {
  std::unordered_map<std::uint32_t, std::size_t> known;
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    const auto [at, is_new] = known.try_emplace(shapes[i].geometry.value, geometries_.size());
    if (is_new) geometries_.emplace_back().node = shapes[i].geometry;
    geometries_[at->second].shapes.push_back(i);
  }
  for (Geometry& g : geometries_) {
    const bool textured =
        std::ranges::any_of(g.shapes, [&](std::uint32_t i) { return shapes[i].surface->picture.texture != nullptr; });
    g.mesh = mesh_of(g.node, textured);
  }
}

/// Shapes that share a geometry are taken to show it as large as the first one does.
bool Repacking::make_charts(Geometry& g) {
  if (!g.mesh.is_triangles() || !g.mesh.lightcoord.present()) return false;
  const drawing::Surface& s = *shapes_[g.shapes[0]].surface;
  g.to_texels = scaling(width_of(s), height_of(s)) * s.baked.places;
  constexpr double flat = 1e-9;
  for (const std::uint32_t i : g.shapes)
    if (!(std::abs(shapes_[i].surface->baked.places.determinant()) > flat)) return false;
  auto charts = light_charts(g.mesh, g.to_texels);
  if (!charts) return false;
  g.light = std::move(*charts);
  g.first_need = needs_.size();
  for (const auto& size : g.light.charts.sizes) {
    ChartNeed& n = needs_.emplace_back();
    n.size = size;
    n.copies = static_cast<std::uint32_t>(g.shapes.size());
  }
  g.images.resize(g.shapes.size() * g.light.charts.size());
  return true;
}

void Repacking::find_scale(const Geometry& g, std::uint32_t chart) {
  ChartNeed& n = needs_[g.first_need + chart];
  for (const std::uint32_t i : g.shapes) {
    const drawing::Surface& s = *shapes_[i].surface;
    const int most = std::max(1, options_.max_size / static_cast<int>(std::max(width_of(s), height_of(s))));
    const double wish = options_.scale ? options_.scale : detail_of(s, g.mesh, g.light.charts, chart);
    n.scale = std::max(n.scale, std::min<double>(wish, most));
  }
}

/// From texels of the light of the first Shape to places of that of Shape k.
TexcoordMap Repacking::light_of(const Geometry& g, std::size_t k) const {
  return shapes_[g.shapes[k]].surface->baked.places * inverse(g.to_texels);
}

std::vector<ChartImage> Repacking::halved(const Geometry& g, std::size_t k, std::uint32_t chart,
                                          std::vector<Difference>& errors) const {
  const ChartNeed& n = need(g, chart);
  const unwrap::Charts& charts = g.light.charts;
  const Point2 size{n.size.x * n.scale, n.size.y * n.scale}, origin = g.light.origin[chart];
  ChartImage full(size);
  const TexcoordMap box = in_box(full, n.scale);
  const TexcoordMap at = light_of(g, k) * shift(origin.x, origin.y) * inverse(box);
  std::vector<PageTriangle> triangles;
  std::vector<Painted> painted;
  const drawing::Surface& s = *shapes_[g.shapes[k]].surface;
  for (std::uint32_t i = charts.begin[chart]; i < charts.begin[chart + 1]; ++i) {
    const std::uint32_t corner = 3 * charts.triangles[i];
    PageTriangle t;
    for (std::uint32_t v = 0; v < 3; ++v) {
      const auto [x, y] = box(charts.places[corner + v].x, charts.places[corner + v].y);
      t.x[v] = x;
      t.y[v] = y;
    }
    const double texels = std::abs(t.area());
    if (!(texels > 0)) continue;
    triangles.push_back(t);
    painted.push_back({&s, &g.mesh, corner, texture_detail(s, g.mesh, corner, texels), at});
  }
  std::vector<ChartImage> out;
  if (triangles.empty()) return out;
  full.paint(triangles, painted, options_.alpha);
  for (double scale = 0.5; std::max(size.x, size.y) * scale > 0.5; scale /= 2) {
    const ChartImage& twice = out.empty() ? full : out.back();
    ChartImage image = twice.shrunk({2 * scale * size.x, 2 * scale * size.y}, 0.5);
    const Difference error = full.difference(image, scale);
    if (!options_.all && !is_within(error, options_.tolerance)) break;
    errors.push_back(error);
    out.push_back(std::move(image));
  }
  return out;
}

/// The worst of its Shapes counts.
void Repacking::find_errors(Geometry& g, std::uint32_t chart) {
  constexpr double few = 4;  // texels: nothing to gain
  ChartNeed& n = needs_[g.first_need + chart];
  if (double{n.size.x} * n.size.y * n.scale * n.scale <= few || !(options_.all || options_.tolerance > 0)) return;
  for (std::size_t k = 0; k < g.shapes.size(); ++k) {
    std::vector<Difference> errors;
    g.images[k * g.light.charts.size() + chart] = halved(g, k, chart, errors);
    if (k == 0) n.error = errors;
    n.error.resize(std::min(n.error.size(), errors.size()));
    for (std::size_t i = 0; i < n.error.size(); ++i)
      n.error[i] = {std::max(n.error[i].mean, errors[i].mean), std::max(n.error[i].most, errors[i].most)};
  }
}

bool Repacking::measure() {
  for (Geometry& g : geometries_)
    if (!make_charts(g)) return false;
  std::vector<Job> jobs;
  for (std::size_t g = 0; g < geometries_.size(); ++g)
    for (std::size_t c = 0; c < geometries_[g].light.charts.size(); ++c) jobs.push_back({g, c});
  parallel_for(jobs.size(), [&](std::size_t i) {
    Geometry& g = geometries_[jobs[i].geometry];
    const auto chart = static_cast<std::uint32_t>(jobs[i].chart);
    find_scale(g, chart);
    find_errors(g, chart);
  });
  return true;
}

int Repacking::padding() const {
  return bake::affordable_padding(bake::padding_of(1), [&](int padding) { return area_of(needs_, padding); });
}

void Repacking::pack() {
  std::vector<unwrap::Charts> scaled;
  scaled.reserve(geometries_.size());
  std::vector<unwrap::PackItem> items;
  for (const Geometry& g : geometries_) {
    auto& charts = scaled.emplace_back(g.light.charts);
    for (std::size_t c = 0; c < charts.places.size(); ++c) {
      const auto f = static_cast<float>(need(g, charts.chart_of[c / 3]).factor());
      charts.places[c] = {f * charts.places[c].x, f * charts.places[c].y};
    }
    for (std::uint32_t c = 0; c < charts.size(); ++c) {
      const auto f = static_cast<float>(need(g, c).factor());
      charts.sizes[c] = {f * charts.sizes[c].x, f * charts.sizes[c].y};
    }
    items.push_back({&charts, 1, static_cast<std::uint32_t>(g.shapes.size())});
  }
  atlas_ = bake::pack_whole(items, {padding(), options_.max_size, 0});
}

std::uint64_t Repacking::texels() const {
  std::uint64_t sum = 0;
  for (const auto& p : atlas_.pages) sum += static_cast<std::uint64_t>(p.width) * static_cast<std::uint64_t>(p.height);
  return sum;
}

std::uint32_t Repacking::page(std::size_t g, std::size_t k) const {
  const auto& item = atlas_.items[g];
  return item.copies.empty() ? item.charts[0].page : item.copies[k].page;
}

/// From texels of the light to the page, y upwards, or to the piece of which there are copies.
TexcoordMap Repacking::chart_map(std::size_t g, std::uint32_t chart) const {
  const Geometry& geometry = geometries_[g];
  const double f = need(geometry, chart).factor();
  const Point2 origin = geometry.light.origin[chart];
  return map_of(atlas_.items[g].charts[chart]) * scaling(f, f) * shift(-origin.x, -origin.y);
}

/// Of a piece of which there are copies: its larger side in texels.
double Repacking::unit(std::size_t g) const {
  const LightCharts& light = geometries_[g].light;
  double out = 1;
  for (std::uint32_t c = 0; c < light.charts.size(); ++c) {
    const TexcoordMap map = chart_map(g, c);
    const auto& size = light.charts.sizes[c];
    for (const Point2 corner : {Point2{0, 0}, Point2{size.x, size.y}}) {
      const auto [x, y] = map(light.origin[c].x + corner.x, light.origin[c].y + corner.y);
      out = std::max({out, x, y});
    }
  }
  return out;
}

std::vector<double> Repacking::places(std::size_t g) const {
  const Geometry& geometry = geometries_[g];
  const Attribute& from = geometry.mesh.lightcoord;
  const auto& sides = atlas_.pages[page(g, 0)];
  const bool own = atlas_.items[g].copies.empty();
  const double piece = own ? 1 : unit(g);
  const TexcoordMap to = own ? scaling(1.0 / sides.width, 1.0 / sides.height) : scaling(1 / piece, 1 / piece);
  std::vector<TexcoordMap> maps;
  for (std::uint32_t c = 0; c < geometry.light.charts.size(); ++c)
    maps.push_back(to * chart_map(g, c) * geometry.to_texels);
  std::vector<double> out(2 * from.count());
  for (std::uint32_t i = 0; i < from.count(); ++i) {
    const auto chart = geometry.light.of_place[i];
    if (chart == LightCharts::nowhere) continue;
    const auto [x, y] = maps[chart](from.at(i)[0], from.at(i)[1]);
    out[2 * i] = rounded(x, own ? sides.width : piece);
    out[2 * i + 1] = rounded(y, own ? sides.height : piece);
  }
  return out;
}

std::optional<TexcoordMap> Repacking::transform(std::size_t g, std::size_t k) const {
  const auto& item = atlas_.items[g];
  if (item.copies.empty()) return {};
  const auto& sides = atlas_.pages[page(g, k)];
  const double piece = unit(g);
  return scaling(1.0 / sides.width, 1.0 / sides.height) * map_of(item.copies[k]) * scaling(piece, piece);
}

void Repacking::list(std::size_t g, std::size_t k, std::uint32_t page, std::vector<PageTriangle>& triangles,
                     std::vector<Painted>& painted) const {
  const Geometry& geometry = geometries_[g];
  const auto& item = atlas_.items[g];
  const unwrap::Charts& charts = geometry.light.charts;
  const drawing::Surface& s = *shapes_[geometry.shapes[k]].surface;
  const TexcoordMap down = flip(atlas_.pages[page].height);
  for (std::uint32_t chart = 0; chart < charts.size(); ++chart) {
    const Point2 origin = geometry.light.origin[chart];
    const TexcoordMap own = chart_map(g, chart);
    const TexcoordMap map = item.copies.empty() ? down * own : down * map_of(item.copies[k]) * own;
    const std::uint32_t halvings = need(geometry, chart).halvings;
    const ChartImage* image = halvings ? &geometry.images[k * charts.size() + chart][halvings - 1] : nullptr;
    const TexcoordMap to =
        image ? in_box(*image, need(geometry, chart).factor()) * shift(-origin.x, -origin.y) : light_of(geometry, k);
    const TexcoordMap at = to * inverse(map);
    const std::uint16_t number =
        bake::chart_number(static_cast<std::uint32_t>(&need(geometry, chart) - needs_.data() + k));
    for (std::uint32_t i = charts.begin[chart]; i < charts.begin[chart + 1]; ++i) {
      const std::uint32_t corner = 3 * charts.triangles[i];
      PageTriangle t;
      t.chart = number;
      for (std::uint32_t v = 0; v < 3; ++v) {
        const auto& place = charts.places[corner + v];
        const auto [x, y] = map(origin.x + place.x, origin.y + place.y);
        t.x[v] = x;
        t.y[v] = y;
      }
      const double texels = std::abs(t.area());
      if (!(texels > 0) || !is_near(t)) continue;
      triangles.push_back(t);
      painted.push_back({&s, &geometry.mesh, corner, texture_detail(s, geometry.mesh, corner, texels), at, image});
    }
  }
}

Image Repacking::paint(std::uint32_t page) const {
  constexpr double reach = 2;  // texels beyond a chart that show how its surface goes on
  std::vector<PageTriangle> triangles;
  std::vector<Painted> painted;
  for (std::size_t g = 0; g < geometries_.size(); ++g)
    for (std::size_t k = 0; k < geometries_[g].shapes.size(); ++k)
      if (this->page(g, k) == page) list(g, k, page, triangles, painted);
  Page to(atlas_.pages[page].width, atlas_.pages[page].height, reach);
  to.paint(triangles, [&](std::size_t i, const std::array<double, 3>& weights, double x, double y) {
    return painted[i].color(weights, x, y, options_.alpha);
  });
  return to.image(options_.alpha ? 4 : 3);
}

}  // namespace wrlkit::combine
