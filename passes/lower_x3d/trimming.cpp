#include "passes/lower_x3d/trimming.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "geometry/polygon.h"

namespace wrlkit::x3d {
namespace {

using Ring = std::vector<Vec2>;

double signed_area(std::span<const Vec2> ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

/// Calls f(u) for each place where the ring crosses the line of that v.
template <class F>
void crossings(std::span<const Vec2> ring, double v, F&& f) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a[1] > v) != (b[1] > v)) f(a[0] + (b[0] - a[0]) * (v - a[1]) / (b[1] - a[1]));
  }
}

bool is_inside(const Vec2& p, std::span<const Vec2> ring) {
  bool inside = false;
  crossings(ring, p[1], [&](double u) { inside ^= u < p[0]; });
  return inside;
}

/// The lines of a grid, the outer ones outside of it and none through a point of a ring: every part of a contour is
/// then inside of a cell, or goes from one to the next.
std::vector<double> clear_lines(std::vector<double> lines, const std::vector<Ring>& rings, std::size_t axis) {
  const double range = lines.back() - lines.front(), step = 1e-7 * range;
  std::vector<double> taken;
  for (const Ring& ring : rings)
    for (const Vec2& p : ring) taken.push_back(p[axis]);
  std::ranges::sort(taken);
  const auto is_taken = [&](double x) {
    const auto i = std::ranges::lower_bound(taken, x - step / 10);
    return i != taken.end() && *i < x + step / 10;
  };
  for (std::size_t i = 1; i + 1 < lines.size(); ++i) {
    double x = lines[i];
    while (is_taken(x) && x < lines[i + 1] && x + step > x) x += step;
    lines[i] = x;
  }
  lines.front() -= range;
  lines.back() += range;
  return lines;
}

class Trimmer {
 public:
  Trimmer(const Grid& grid, std::vector<Ring> rings)
      : rings_(std::move(rings)), u_(clear_lines(grid.u, rings_, 0)), v_(clear_lines(grid.v, rings_, 1)) {}

  TrimmedGrid run() {
    corner_.assign(u_.size() * v_.size(), none);
    for (const Ring& ring : rings_) cut_ring(ring);
    for (auto& [number, cell] : cells_) fill_cell(number, cell);
    whole_cells();
    return std::move(out_);
  }

 private:
  static constexpr std::uint32_t none = ~0U;
  /// A part of a contour from where it enters a cell to where it leaves it: points of the result.
  using Chain = std::vector<std::uint32_t>;
  struct Cell {
    std::vector<Chain> chains, loops;
  };

  std::size_t columns() const { return u_.size() - 1; }
  std::size_t cell_of(const Vec2& p) const {
    const auto at = [](const std::vector<double>& lines, double x) {
      const auto i = std::ranges::upper_bound(lines, x) - lines.begin() - 1;
      return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, std::ssize(lines) - 2));
    };
    return at(v_, p[1]) * columns() + at(u_, p[0]);
  }
  std::uint32_t add(const Vec2& p) {
    out_.points.push_back(p);
    return static_cast<std::uint32_t>(out_.points.size() - 1);
  }
  std::uint32_t corner(std::size_t column, std::size_t row) {
    auto& c = corner_[row * u_.size() + column];
    if (c == none) c = add({u_[column], v_[row]});
    return c;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    out_.triangles.insert(out_.triangles.end(), {a, b, c});
  }

  // ---- contours ----

  /// The points of an edge behind its first one: where it crosses lines, and its end.
  void edge(const Vec2& a, const Vec2& b, std::vector<Vec2>& to) const {
    std::vector<std::pair<double, Vec2>> cuts;
    for (const std::size_t axis : {0, 1}) {
      const auto& lines = axis == 0 ? u_ : v_;
      const auto [low, high] = std::minmax(a[axis], b[axis]);
      for (auto i = std::ranges::upper_bound(lines, low); i != lines.end() && *i < high; ++i) {
        const double t = (*i - a[axis]) / (b[axis] - a[axis]);
        Vec2 p{a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t};
        p[axis] = *i;
        cuts.emplace_back(t, p);
      }
    }
    std::ranges::sort(cuts);
    for (const auto& c : cuts) to.push_back(c.second);
    to.push_back(b);
  }

  void cut_ring(const Ring& ring) {
    std::vector<Vec2> all;
    for (std::size_t i = 0; i < ring.size(); ++i) edge(ring[i], ring[(i + 1) % ring.size()], all);
    const std::size_t n = all.size();
    std::vector<std::size_t> cell(n);  // of the part from a point to the next
    std::size_t start = n;             // a point where a cell begins
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 &a = all[i], &b = all[(i + 1) % n];
      cell[i] = cell_of({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2});
      if (i > 0 && cell[i] != cell[i - 1]) start = i;
    }
    const auto first = static_cast<std::uint32_t>(out_.points.size());
    for (const Vec2& p : all) add(p);
    const auto id = [&](std::size_t i) { return first + static_cast<std::uint32_t>(i % n); };
    if (start == n) {
      Chain& loop = cells_[cell[0]].loops.emplace_back();
      for (std::size_t i = 0; i < n; ++i) loop.push_back(id(i));
      return;
    }
    for (std::size_t i = start; i < start + n;) {
      const std::size_t here = cell[i % n];
      Chain chain{id(i)};
      for (; i < start + n && cell[i % n] == here; ++i) chain.push_back(id(i + 1));
      cells_[here].chains.push_back(std::move(chain));
    }
  }

  // ---- cells that a contour crosses ----

  /// How far around a cell a point of its border is: 0 to 4, anticlockwise from the corner of the lowest u and v.
  double around(std::uint32_t point, std::size_t column, std::size_t row) const {
    const Vec2& p = out_.points[point];
    const double s = (p[0] - u_[column]) / (u_[column + 1] - u_[column]),
                 t = (p[1] - v_[row]) / (v_[row + 1] - v_[row]);
    if (p[1] == v_[row]) return s;
    if (p[0] == u_[column + 1]) return 1 + t;
    if (p[1] == v_[row + 1]) return 3 - s;
    return 4 - t;
  }

  /// The chains of a cell as polygons: from the end of each along the border to the beginning of the next, with what
  /// stays on the left.
  std::vector<Chain> outlines(const Cell& cell, std::size_t column, std::size_t row) {
    const auto nth_corner = [&](int k) {
      k %= 4;
      return corner(column + (k == 1 || k == 2), row + (k >= 2));
    };
    std::vector<std::pair<double, std::size_t>> entries;
    for (std::size_t i = 0; i < cell.chains.size(); ++i)
      entries.emplace_back(around(cell.chains[i].front(), column, row), i);
    std::ranges::sort(entries);
    std::vector<char> used(cell.chains.size());
    std::vector<Chain> out;
    for (std::size_t begin = 0; begin < cell.chains.size(); ++begin) {
      if (used[begin]) continue;
      Chain& polygon = out.emplace_back();
      for (std::size_t c = begin; !used[c];) {
        used[c] = 1;
        polygon.insert(polygon.end(), cell.chains[c].begin(), cell.chains[c].end());
        const double leaves = around(cell.chains[c].back(), column, row);
        auto next = std::ranges::upper_bound(entries, std::pair{leaves, cell.chains.size()});
        const double enters = next == entries.end() ? entries[0].first + 4 : next->first;
        c = next == entries.end() ? entries[0].second : next->second;
        for (int k = static_cast<int>(std::floor(leaves)) + 1; k < enters; ++k) polygon.push_back(nth_corner(k));
      }
    }
    return out;
  }

  Ring places(const Chain& chain) const {
    Ring out;
    for (std::uint32_t i : chain) out.push_back(out_.points[i]);
    return out;
  }

  void fill_cell(std::size_t number, const Cell& cell) {
    const std::size_t column = number % columns(), row = number / columns();
    std::vector<Chain> polygons = outlines(cell, column, row);
    if (cell.chains.empty() && is_on_surface({u_[column], v_[row]}))
      polygons = {{corner(column, row), corner(column + 1, row), corner(column + 1, row + 1), corner(column, row + 1)}};
    std::vector<Chain> holes;
    for (const Chain& loop : cell.loops) (signed_area(places(loop)) > 0 ? polygons : holes).push_back(loop);
    std::vector<std::vector<Chain>> rings;  // of each polygon: its outline and its holes
    for (Chain& p : polygons) rings.push_back({std::move(p)});
    for (Chain& hole : holes) {
      std::vector<Chain>* smallest = nullptr;
      for (auto& r : rings) {
        const Ring outline = places(r[0]);
        if (is_inside(out_.points[hole[0]], outline) &&
            (!smallest || signed_area(outline) < signed_area(places((*smallest)[0]))))
          smallest = &r;
      }
      if (smallest) smallest->push_back(std::move(hole));
    }
    for (const auto& r : rings) fill(r);
  }

  void fill(const std::vector<Chain>& rings) {
    Chain all;
    std::vector<std::uint32_t> ends;
    for (const Chain& r : rings) {
      all.insert(all.end(), r.begin(), r.end());
      ends.push_back(static_cast<std::uint32_t>(all.size()));
    }
    cutter_.cut(places(all), ends);
    for (std::uint32_t c : cutter_.corners()) out_.triangles.push_back(all[c]);
  }

  bool is_on_surface(const Vec2& p) const {
    return std::ranges::count_if(rings_, [&](const Ring& r) { return is_inside(p, r); }) % 2;
  }

  // ---- the others ----

  void whole_cells() {
    std::vector<double> cuts;
    for (std::size_t row = 0; row + 1 < v_.size(); ++row) {
      cuts.clear();
      for (const Ring& r : rings_) crossings(r, (v_[row] + v_[row + 1]) / 2, [&](double u) { cuts.push_back(u); });
      std::ranges::sort(cuts);
      for (std::size_t column = 0; column < columns(); ++column) {
        const double middle = (u_[column] + u_[column + 1]) / 2;
        const bool inside = (std::ranges::lower_bound(cuts, middle) - cuts.begin()) % 2;
        if (!inside || cells_.contains(row * columns() + column)) continue;
        const auto a = corner(column, row), c = corner(column + 1, row + 1);
        triangle(a, corner(column + 1, row), c);
        triangle(a, c, corner(column, row + 1));
      }
    }
  }

  std::vector<Ring> rings_;
  std::vector<double> u_, v_;
  std::map<std::size_t, Cell> cells_;
  std::vector<std::uint32_t> corner_;  // of lines of the grid
  TrimmedGrid out_;
  PolygonCutter cutter_;
};

/// Within the grid, without repeated points, and not without an area.
std::vector<Ring> clean(const Grid& g, const std::vector<Ring>& contours) {
  const double size = std::max(g.u.back() - g.u.front(), g.v.back() - g.v.front()), least = 1e-9 * size;
  std::vector<Ring> out;
  for (const Ring& contour : contours) {
    Ring ring;
    for (const Vec2& p : contour) {
      const Vec2 at{std::clamp(p[0], g.u.front(), g.u.back()), std::clamp(p[1], g.v.front(), g.v.back())};
      if (ring.empty() || std::abs(at[0] - ring.back()[0]) + std::abs(at[1] - ring.back()[1]) > least)
        ring.push_back(at);
    }
    while (ring.size() > 1 && std::abs(ring[0][0] - ring.back()[0]) + std::abs(ring[0][1] - ring.back()[1]) <= least)
      ring.pop_back();
    if (ring.size() > 2 && std::abs(signed_area(ring)) > least * size) out.push_back(std::move(ring));
  }
  return out;
}

}  // namespace

TrimmedGrid trim(const Grid& grid, const std::vector<Ring>& contours) {
  auto rings = clean(grid, contours);
  constexpr std::size_t most_cuts = 30'000'000, most_steps = 1'000'000'000;
  std::size_t n = 0;
  for (const Ring& r : rings) n += r.size();
  const bool too_many = n * (grid.u.size() + grid.v.size()) > most_cuts || n * rings.size() > most_steps;
  if (rings.empty() || too_many) return {};
  std::vector<char> is_hole;
  bool outside = true;
  for (const Ring& r : rings) {
    const auto around = std::ranges::count_if(rings, [&](const Ring& o) { return &o != &r && is_inside(r[0], o); });
    is_hole.push_back(around % 2);
    outside &= around > 0 || signed_area(r) < 0;
  }
  for (std::size_t i = 0; i < rings.size(); ++i)
    if ((signed_area(rings[i]) < 0) != ((is_hole[i] != 0) != outside)) std::ranges::reverse(rings[i]);
  if (outside) {
    const double u0 = grid.u.front(), u1 = grid.u.back(), v0 = grid.v.front(), v1 = grid.v.back();
    rings.push_back({{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}});
  }
  return Trimmer(grid, std::move(rings)).run();
}

}  // namespace wrlkit::x3d
