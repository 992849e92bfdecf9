// The UV atlas of a mesh: seconds, charts, coverage, stretch, faults.
//   unwrap_bench IN.wrl SIDE [OUT.png]     all surfaces of the file, welded, on one page of that side

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "base/image/image.h"
#include "bench/loaded_world.h"
#include "bench/process_cost.h"
#include "geometry/unwrap/pack.h"
#include "geometry/unwrap/rows.h"
#include "geometry/unwrap/unfold.h"

namespace {

using namespace wrlkit;
using unwrap::Point2, unwrap::Triangle2;

constexpr std::uint32_t none = 0xffffffffu;

struct Soup {
  std::vector<double> positions;
  std::vector<std::uint32_t> corners;
};

/// All surfaces of the file, in local coordinates: an atlas does not mind where they are.
Soup read(const char* path) {
  LoadedWorld world(path, "tessellate,weld,triangulate");
  Soup all;
  world.each_mesh([&](const Mesh& m) {
    if (!m.is_triangles()) return;
    auto first = static_cast<std::uint32_t>(all.positions.size() / 3);
    auto p = m.positions.span();
    all.positions.insert(all.positions.end(), p.begin(), p.end());
    for (std::uint32_t c : m.corners) all.corners.push_back(first + c);
  });
  return all;
}

struct Sum {
  double area = 0, area2 = 0, squares = 0, most = 0;
  std::size_t mirrored = 0, unplaced = 0;
};

/// Sander et al. 2001, section 3, scaled to equal areas.
void add_stretch(const Soup& s, std::size_t t, const Triangle2& uv, Sum& sum) {
  const double* p[3];
  for (int k = 0; k < 3; ++k) p[k] = &s.positions[3 * std::size_t{s.corners[3 * t + k]}];
  double e[2][3], a = 0, b = 0, c = 0;
  for (int k = 0; k < 3; ++k) {
    e[0][k] = p[1][k] - p[0][k];
    e[1][k] = p[2][k] - p[0][k];
    a += e[0][k] * e[0][k];
    b += e[0][k] * e[1][k];
    c += e[1][k] * e[1][k];
  }
  double area = std::sqrt(std::max(0., a * c - b * b)) / 2;
  Point2 u = uv[1] - uv[0], v = uv[2] - uv[0];
  double area2 = cross(u, v) / 2;
  if (!(area > 0)) return;
  if (area2 < 0) ++sum.mirrored;
  if (area2 == 0) ++sum.unplaced;
  if (!(area2 > 0)) return;
  sum.area += area;
  sum.area2 += area2;
  // The edges by u and v: S = (v.y e0 - u.y e1) / 2A, T = (u.x e1 - v.x e0) / 2A.
  double d = 1 / (4 * area2 * area2);
  double ss = (v.y * v.y * a - 2 * v.y * u.y * b + u.y * u.y * c) * d;
  double tt = (v.x * v.x * a - 2 * v.x * u.x * b + u.x * u.x * c) * d;
  double st = (-v.y * v.x * a + (v.y * u.x + u.y * v.x) * b - u.y * u.x * c) * d;
  sum.squares += area * (ss + tt) / 2;
  sum.most = std::max(sum.most, (ss + tt + std::sqrt((ss - tt) * (ss - tt) + 4 * st * st)) / 2);
}

template <class F>
void for_each_texel(const Triangle2& t, int side, F&& f) {
  double y0 = std::min({t[0].y, t[1].y, t[2].y}), y1 = std::max({t[0].y, t[1].y, t[2].y});
  for (int y = std::max(0, int(std::ceil(y0 - 0.5))); y + 0.5 < y1 && y < side; ++y) {
    double low = HUGE_VAL, high = -HUGE_VAL, at = y + 0.5;
    for (int k = 0; k < 3; ++k) {
      Point2 a = t[k], b = t[(k + 1) % 3];
      if ((a.y <= at) == (b.y <= at)) continue;
      if (a.y > b.y) std::swap(a, b);  // both triangles at an edge find the same texels
      double x = a.x + (b.x - a.x) * (at - a.y) / (b.y - a.y);
      low = std::min(low, x);
      high = std::max(high, x);
    }
    for (int x = std::max(0, int(std::ceil(low - 0.5))); x + 0.5 < high && x < side; ++x) f(x, y);
  }
}

void write_png(const std::vector<std::uint32_t>& owner, int side, const char* path) {
  Image image{side, side, 3, {}};
  image.pixels.resize(owner.size() * 3);
  for (std::size_t i = 0; i < owner.size(); ++i) {
    std::uint32_t h = owner[i] == none ? 0 : (owner[i] + 1) * 0x9E3779B1u;
    for (int k = 0; k < 3; ++k)
      image.pixels[3 * i + k] = owner[i] == none ? 0 : static_cast<std::uint8_t>(80 + (h >> (8 * k + 8)) % 176);
  }
  std::string error;
  auto png = encode_png(image, error);
  if (png) std::ofstream(path, std::ios::binary) << *png;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "see the head of unwrap_bench.cpp\n");
    return 2;
  }
  Soup s = read(argv[1]);
  int side = std::atoi(argv[2]), padding = 2;
  double t0 = cpu_seconds();
  unwrap::Charts charts = unwrap::unfold({s.positions, s.corners, {}});
  double t1 = cpu_seconds();
  unwrap::PackItem item{&charts};
  unwrap::Atlas atlas = unwrap::pack({&item, 1}, {.padding = padding, .side = side});
  double t2 = cpu_seconds();

  std::size_t n = s.corners.size() / 3, covered = 0, twice = 0, near = 0;
  Sum sum;
  std::vector<std::uint32_t> owner(std::size_t(side) * side, none);
  for (std::size_t t = 0; t < n; ++t) {
    std::uint32_t c = charts.chart_of[t];
    Triangle2 uv;
    for (int k = 0; k < 3; ++k) {
      auto p = charts.places[3 * t + k];
      Point2 q = atlas.items[0].charts[c].apply({p.x, p.y});
      uv[k] = {static_cast<float>(q.x), static_cast<float>(q.y)};
    }
    add_stretch(s, t, uv, sum);
    if (atlas.items[0].charts[c].page > 0) continue;
    for_each_texel(uv, side, [&](int x, int y) {
      std::uint32_t& o = owner[std::size_t(y) * side + x];
      if (o != none) ++twice;
      if (o == none) ++covered;
      o = c;
    });
  }
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      std::uint32_t o = owner[std::size_t(y) * side + x];
      bool bad = false;
      for (int j = std::max(0, y - padding); o != none && j <= std::min(side - 1, y + padding); ++j)
        for (int i = std::max(0, x - padding); i <= std::min(side - 1, x + padding); ++i) {
          std::uint32_t p = owner[std::size_t(j) * side + i];
          bad |= p != none && p != o;
        }
      near += bad;
    }
  double k = sum.area2 / sum.area;
  std::printf(
      "faces=%zu unfold=%.3f pack=%.3f cpu=%.3f charts=%zu pages=%zu coverage=%.4f L2=%.4f Linf=%.3f overlap=%zu "
      "near=%zu mirrored=%zu unplaced=%zu factor=%.5g\n",
      n, t1 - t0, t2 - t1, t2 - t0, charts.size(), atlas.pages.size(), double(covered) / side / side,
      std::sqrt(sum.squares / sum.area * k), std::sqrt(sum.most * k), twice, near, sum.mirrored, sum.unplaced,
      atlas.factor);
  if (argc > 3) write_png(owner, side, argv[3]);
}
