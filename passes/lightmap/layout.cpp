#include "passes/lightmap/layout.h"

#include <algorithm>

#include "passes/lightmap/whole_pages.h"
#include "passes/weld/points.h"

namespace wrlkit::bake {
namespace {

using unwrap::Placement;
using unwrap::Point2;

constexpr double usual_fill = 0.5;       // of a page
constexpr double most_texels = 1 << 28;  // of all pages; 3 GiB of light

/// An edge of a triangle: its points in order of their numbers, and where it is.
struct HalfEdge {
  std::uint32_t a, b, triangle, corner;
  auto operator<=>(const HalfEdge&) const = default;
};

std::vector<HalfEdge> edges_of(const Part& p) {
  PointJoiner joiner;
  StampedMap map;
  auto point = p.mesh.corners;
  joiner.join_equal(p.mesh.positions.span(), point, map);
  std::vector<HalfEdge> edges;
  for (std::uint32_t c = 0; c < point.size(); ++c) {
    const std::uint32_t t = c / 3, next = 3 * t + (c + 1) % 3;
    const auto [a, b] = std::minmax(point[c], point[next]);
    if (a != b) edges.push_back({a, b, t, c});
  }
  std::ranges::sort(edges);
  return edges;
}

/// Whether two corners lie in one place of one chart.
bool meet(const Part& p, std::uint32_t c, std::uint32_t d) {
  const auto &a = p.charts.places[c], &b = p.charts.places[d];
  return p.charts.chart_of[c / 3] == p.charts.chart_of[d / 3] && a.x == b.x && a.y == b.y;
}

/// Shading goes on across the edge: the normals of both triangles agree at both of its ends.
bool is_smooth(const Part& p, std::uint32_t c0, std::uint32_t c1, std::uint32_t d0, std::uint32_t d1) {
  constexpr double same = 0.97;  // 14 degrees
  return dot(p.normal(c0), p.normal(d0)) > same && dot(p.normal(c1), p.normal(d1)) > same;
}

}  // namespace

Layout::Layout(const std::vector<Part>& parts, const LayoutOptions& options)
    : parts_(parts),
      options_(options),
      items_(parts.size()),
      piece_unit_(parts.size(), 1),
      density_(options.density > 0 ? options.density : 1) {
  place_all(padding_of(std::max(options_.mips, 1)));
  if (const int padding = cheap_padding(); options_.mips == 0 && padding > padding_) place_all(padding);
  measure_pieces();
  place_triangles();
}

void Layout::place_all(int padding) {
  padding_ = padding;
  pages_.clear();
  density_ = 1;
  if (options_.density > 0) {
    density_ = possible_density();
    pack_all();
  } else
    pack(0, parts_.size(), options_.side);
}

/// By the boxes of the charts as they are packed, with what lies between them.
int Layout::cheap_padding() const {
  return affordable_padding(padding_, [&](int padding) {
    double sum = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      for (std::size_t c = 0; c < items_[i].charts.size(); ++c) {
        const auto& size = parts_[i].charts.sizes[c];
        const double scale = items_[i].charts[c].scale;
        sum += (size.x * scale + padding) * (size.y * scale + padding) * static_cast<double>(parts_[i].uses.size());
      }
    return sum;
  });
}

unwrap::PackItem Layout::item(std::size_t part) const {
  const Part& p = parts_[part];
  return {&p.charts, density_ * p.density, static_cast<std::uint32_t>(p.uses.size())};
}

/// Of the boxes of all charts, at one texel a metre.
double Layout::texels(std::size_t part) const {
  const Part& p = parts_[part];
  double area = 0;
  for (const auto& box : p.charts.sizes) area += box.x * box.y;
  return area * p.density * p.density * static_cast<double>(p.uses.size());
}

/// As was asked for, unless there would be more texels than memory can be expected for. A surface that is larger than a
/// page will not have as many as are counted here.
double Layout::possible_density() const {
  double sum = 0, wish = options_.density, page = usual_fill * options_.side * options_.side;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    sum += std::min(wish * wish * texels(i), page * static_cast<double>(parts_[i].uses.size()));
  return wish * std::min(1.0, std::sqrt(usual_fill * most_texels / sum));
}

Layout::Coarse Layout::coarse() const {
  constexpr double enough = 0.99;
  Coarse out{0, 1};
  for (std::size_t i = 0; i < parts_.size() && options_.density > 0; ++i) {
    double least = 1;
    for (const Placement& c : items_[i].charts)
      least = std::min(least, c.scale / (options_.density * parts_[i].density));
    if (least < enough) {
      out.n_shapes += parts_[i].uses.size();
      out.least = std::min(out.least, least);
    }
  }
  return out;
}

/// In runs of parts, as many as should fill a page.
void Layout::pack_all() {
  const double room = usual_fill * options_.side * options_.side / (density_ * density_);
  for (std::size_t begin = 0; begin < parts_.size();) {
    std::size_t end = begin;
    for (double area = 0; end < parts_.size() && (end == begin || area < room); ++end) area += texels(end);
    pack(begin, end, 0);
    begin = end;
  }
}

/// A Shape has one lightmap, so the charts of a part are on one page.
void Layout::pack(std::size_t begin, std::size_t end, int side) {
  std::vector<unwrap::PackItem> items;
  for (std::size_t i = begin; i < end; ++i) items.push_back(item(i));
  auto atlas = pack_whole(items, {padding_, std::max(options_.side, side), side});
  const auto first = static_cast<std::uint32_t>(pages_.size());
  for (const auto& page : atlas.pages) pages_.push_back({page.width, page.height, {}, {}});
  for (std::size_t i = begin; i < end; ++i) {
    items_[i] = std::move(atlas.items[i - begin]);
    for (auto* places : {&items_[i].charts, &items_[i].copies})
      for (Placement& c : *places) c.page += first;
  }
  if (options_.density <= 0) density_ = atlas.factor;
}

void Layout::measure_pieces() {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (items_[i].copies.empty()) continue;
    for (std::size_t c = 0; c < parts_[i].mesh.corners.size(); ++c) {
      const Point2 p = items_[i].charts[parts_[i].charts.chart_of[c / 3]].apply(
          {parts_[i].charts.places[c].x, parts_[i].charts.places[c].y});
      piece_unit_[i] = std::max({piece_unit_[i], p.x, p.y});
    }
  }
}

/// Where a corner lies: on its page, or in the piece of which there are copies.
Point2 Layout::in_item(std::size_t part, std::size_t corner) const {
  const auto& charts = parts_[part].charts;
  return items_[part].charts[charts.chart_of[corner / 3]].apply({charts.places[corner].x, charts.places[corner].y});
}

void Layout::place_triangles() {
  std::vector<std::uint32_t> n_charts(pages_.size());
  for (std::uint32_t i = 0; i < parts_.size(); ++i) {
    const Part& p = parts_[i];
    const auto& copies = items_[i].copies;
    for (std::uint32_t k = 0; k < p.uses.size(); ++k)
      for (std::uint32_t c = 0; c < p.charts.size(); ++c) {
        const std::uint32_t number = copies.empty() ? items_[i].charts[c].page : copies[k].page;
        PageLayout& page = pages_[number];
        const std::uint32_t chart = n_charts[number]++;
        for (std::uint32_t j = p.charts.begin[c]; j < p.charts.begin[c + 1]; ++j) {
          const std::uint32_t t = p.charts.triangles[j];
          PlacedTriangle placed{{}, chart};
          for (std::uint32_t v = 0; v < 3; ++v) {
            const Point2 inside = in_item(i, 3 * std::size_t{t} + v),
                         q = copies.empty() ? inside : copies[k].apply(inside);
            placed.corner[v] = {static_cast<float>(q.x), static_cast<float>(q.y)};
          }
          page.triangles.push_back(placed);
          page.refs.push_back({i, t, p.uses[k]});
        }
      }
  }
}

ShapePlace Layout::place(std::size_t part, std::size_t k) const {
  const auto& item = items_[part];
  if (item.copies.empty()) return {item.charts.empty() ? 0 : item.charts[0].page};
  const Placement& c = item.copies[k];
  return {c.page, false, c.quarter_turns, c.x, c.y, piece_unit_[part]};
}

std::vector<float> Layout::coords(std::size_t part) const {
  const Part& p = parts_[part];
  std::vector<float> out(2 * p.mesh.corners.size());
  if (out.empty()) return out;
  const bool own = items_[part].copies.empty();
  const auto& page = pages_[items_[part].charts[0].page];
  const double width = own ? page.width : piece_unit_[part], height = own ? page.height : piece_unit_[part];
  for (std::size_t c = 0; c < p.mesh.corners.size(); ++c) {
    const Point2 q = in_item(part, c);
    out[2 * c] = static_cast<float>(q.x / width);
    out[2 * c + 1] = static_cast<float>(q.y / height);
  }
  return out;
}

SeamSide Layout::side(std::size_t part, std::size_t k, std::uint32_t from, std::uint32_t to) const {
  const auto& item = items_[part];
  SeamSide s{item.copies.empty() ? item.charts[0].page : item.copies[k].page, {}};
  const std::uint32_t corners[] = {from, to};
  for (int e = 0; e < 2; ++e) {
    const Point2 inside = in_item(part, corners[e]), q = item.copies.empty() ? inside : item.copies[k].apply(inside);
    s.end[e] = {static_cast<float>(q.x), static_cast<float>(q.y)};
  }
  return s;
}

std::vector<Seam> Layout::seams() const {
  std::vector<Seam> out;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& p = parts_[i];
    const auto edges = edges_of(p);
    for (std::size_t e = 0; e + 1 < edges.size(); ++e) {
      const HalfEdge &f = edges[e], &g = edges[e + 1];
      if (f.a != g.a || f.b != g.b) continue;
      auto next = [](const HalfEdge& h) { return 3 * h.triangle + (h.corner + 1) % 3; };
      const std::uint32_t f0 = f.corner, f1 = next(f), g0 = next(g),
                          g1 = g.corner;  // neighbours run against each other
      if (!is_smooth(p, f0, f1, g0, g1) || (meet(p, f0, g0) && meet(p, f1, g1))) continue;
      for (std::size_t k = 0; k < p.uses.size(); ++k) out.push_back({side(i, k, f0, f1), side(i, k, g0, g1)});
    }
  }
  return out;
}

}  // namespace wrlkit::bake
