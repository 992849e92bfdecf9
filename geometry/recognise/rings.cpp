#include "geometry/recognise/rings.h"

#include <algorithm>

#include "base/math/vec.h"

namespace wrlkit::recognising {
namespace {

double squared(const Vec3& v) { return dot(v, v); }

}  // namespace

/// From the half-edges out of a region, the loops of their twins. A point where two loops meet ends it.
std::vector<std::vector<std::uint32_t>> RingWalk::loops_around(std::uint32_t region) const {
  std::vector<std::uint32_t> edges;
  for (auto f : p_.faces_of(region))
    for (auto h = p_.begin[f]; h < p_.begin[f + 1]; ++h) {
      if (p_.twin[h] == none) return {};
      if (p_.region[p_.face_of[p_.twin[h]]] != region) edges.push_back(p_.twin[h]);
    }
  std::ranges::sort(edges, {}, [&](auto h) { return p_.origin[h]; });
  auto from = [&](std::uint32_t point) {
    auto origin = [&](auto h) { return p_.origin[h]; };
    const auto first = std::ranges::lower_bound(edges, point, {}, origin);
    const auto last = std::ranges::upper_bound(edges, point, {}, origin);
    return last - first == 1 ? static_cast<std::size_t>(first - edges.begin()) : edges.size();
  };
  std::vector<char> used(edges.size());
  std::vector<std::vector<std::uint32_t>> out;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (used[i]) continue;
    auto& loop = out.emplace_back();
    for (std::size_t k = i; !used[k];) {
      used[k] = 1;
      loop.push_back(edges[k]);
      k = from(p_.end(edges[k]));
      if (k == edges.size()) return {};
    }
  }
  return out;
}

void RingWalk::add_borders(std::vector<Start>& out) const {
  std::vector<char> seen(p_.origin.size());
  constexpr std::size_t most = 4;
  std::size_t n = 0;
  for (std::uint32_t h = 0; h < p_.origin.size() && n < most; ++h) {
    if (p_.twin[h] != none || seen[h]) continue;
    std::vector<std::uint32_t> loop;
    std::uint32_t at = h;
    for (std::size_t steps = 0; !seen[at]; ++steps) {
      seen[at] = 1;
      loop.push_back(at);
      // Around the end of the half-edge to the next border.
      std::uint32_t e = p_.next(at);
      for (std::size_t turns = 0; p_.twin[e] != none && turns < p_.origin.size(); ++turns) e = p_.next(p_.twin[e]);
      if (p_.twin[e] != none) return;
      at = e;
    }
    if (at != h) continue;
    ++n;
    out.push_back({std::move(loop), ChainEnd::open, none, none});
  }
}

void RingWalk::add_regions(std::vector<Start>& out, std::uint32_t least, std::uint32_t most, std::size_t tries) const {
  std::vector<std::uint32_t> order;
  for (std::uint32_t r = 0; r < p_.region_border.size(); ++r)
    if (p_.region_border[r] >= least && p_.region_border[r] <= most) order.push_back(r);
  std::ranges::stable_sort(order, std::greater<>(), [&](auto r) { return p_.region_border[r]; });
  if (order.size() > tries) order.resize(tries);
  for (auto r : order) {
    auto loops = loops_around(r);
    if (loops.size() == 1) out.push_back({std::move(loops[0]), ChainEnd::cap, r, none});
  }
}

void RingWalk::add_apices(std::vector<Start>& out) const {
  std::vector<std::uint32_t> valence(p_.points.size());
  std::vector<char> bad(p_.points.size());
  for (std::uint32_t h = 0; h < p_.origin.size(); ++h) {
    ++valence[p_.origin[h]];
    if (p_.twin[h] == none || p_.corners(p_.face_of[h]) != 3) bad[p_.origin[h]] = 1;
  }
  std::uint32_t best = none;
  for (std::uint32_t v = 0; v < valence.size(); ++v)
    if (!bad[v] && valence[v] >= 3 && (best == none || valence[v] > valence[best])) best = v;
  if (best == none) return;
  std::uint32_t first = none;
  for (std::uint32_t h = 0; h < p_.origin.size() && first == none; ++h)
    if (p_.origin[h] == best) first = h;
  Start start{{}, ChainEnd::apex, none, best};
  std::uint32_t h = first;
  do {
    const auto outer = p_.twin[p_.next(h)];
    if (outer == none) return;
    start.loop.push_back(outer);
    h = p_.next(p_.twin[h]);
  } while (h != first && start.loop.size() <= valence[best]);
  if (start.loop.size() != valence[best]) return;
  out.push_back(std::move(start));
}

/// For what has neither border nor cap nor apex: a whole torus. From one point straight on in each direction.
void RingWalk::add_straight_loops(std::vector<Start>& out) const {
  std::vector<std::uint32_t> around{0};
  while (true) {
    const auto t = p_.twin[around.back()];
    if (t == none || around.size() > 8) return;
    const auto h = p_.next(t);
    if (h == 0) break;
    around.push_back(h);
  }
  if (around.size() % 2) return;
  const std::size_t half = around.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    Start start{{}, ChainEnd::closed, none, none};
    std::uint32_t h = around[i];
    for (std::size_t n = 0; n <= 1024; ++n) {
      start.loop.push_back(h);
      std::uint32_t e = p_.next(h);
      for (std::size_t k = 1; k < half; ++k) {
        if (p_.twin[e] == none) return;
        e = p_.next(p_.twin[e]);
      }
      h = e;
      if (h == around[i]) break;
    }
    if (h == around[i] && start.loop.size() >= 3) out.push_back(std::move(start));
  }
}

std::vector<RingWalk::Start> RingWalk::starts() const {
  std::vector<Start> out;
  add_borders(out);
  add_regions(out, 5, none - 1, 6);
  add_apices(out);
  add_regions(out, 3, 4, 64);
  add_straight_loops(out);
  return out;
}

bool RingWalk::is_cap(const std::vector<std::uint32_t>& loop, bool hollow, std::uint32_t& region) const {
  region = p_.region[p_.face_of[loop[0]]];
  if (hollow ? p_.region_border[region] <= loop.size() : p_.region_border[region] != loop.size()) return false;
  return std::ranges::all_of(loop, [&](auto h) { return p_.region[p_.face_of[h]] == region; });
}

std::optional<RingWalk::Band> RingWalk::band(const std::vector<std::uint32_t>& loop) const {
  Band out;
  const std::size_t n = loop.size();
  bool pointed = true;
  for (std::size_t j = 0; j < n; ++j) {
    const std::uint32_t h = loop[j], follows = loop[(j + 1) % n], corners = p_.corners(p_.face_of[h]);
    if (corners > 4 || p_.end(h) != p_.origin[follows]) return std::nullopt;
    out.faces.push_back(p_.face_of[h]);
    std::uint32_t spoke = p_.next(h);
    if (corners == 4) {
      out.back.push_back(p_.next(spoke));
      pointed = false;
    }
    if (spoke == follows) return std::nullopt;
    for (std::size_t turns = 0;; ++turns) {
      const auto t = p_.twin[spoke];
      if (t == none || turns > 2 * n) return std::nullopt;
      if (pointed && out.apex == none) out.apex = p_.end(spoke);
      if (p_.end(spoke) != out.apex) pointed = false;
      const auto e = p_.next(t);
      if (e == follows) break;
      if (p_.corners(p_.face_of[t]) != 3) return std::nullopt;
      out.faces.push_back(p_.face_of[t]);
      out.back.push_back(p_.next(e));
      spoke = e;
    }
  }
  if (pointed && out.back.empty()) return out;
  out.apex = none;
  if (out.back.size() != n) return std::nullopt;
  for (std::size_t i = 0; i < n; ++i)  // each ends where the one before it begins
    if (p_.origin[out.back[i]] != p_.end(out.back[(i + 1) % n])) return std::nullopt;
  return out;
}

/// With triangles the first point of the next ring may belong to column 0 or 1: what is nearer is right.
void RingWalk::align(const std::vector<std::uint32_t>& ring, std::vector<std::uint32_t>& back) const {
  const std::size_t n = ring.size();
  double best = 0;
  std::size_t shift = 0;
  for (std::size_t s : {std::size_t{0}, std::size_t{1}, n - 1}) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += squared(p_.points[p_.end(back[(i + s) % n])] - p_.points[ring[i]]);
    if (s == 0 || sum < best * (1 - 1e-9)) {
      best = sum;
      shift = s;
    }
  }
  std::rotate(back.begin(), back.begin() + static_cast<std::ptrdiff_t>(shift), back.end());
}

void RingWalk::take_region(std::uint32_t region, std::vector<std::uint32_t>& faces) const {
  const auto all = p_.faces_of(region);
  faces.assign(all.begin(), all.end());
}

std::optional<Chain> RingWalk::walk(const Start& start) const {
  Chain chain;
  chain.first = start.end;
  chain.first_apex = start.apex;
  if (start.region != none) take_region(start.region, chain.first_faces);
  auto loop = start.loop;
  if (start.apex != none)
    for (auto h : loop)
      if (p_.twin[h] != none) chain.first_faces.push_back(p_.face_of[p_.twin[h]]);
  const std::size_t most = p_.n_faces() / loop.size() + 2;
  while (true) {
    auto& ring = chain.rings.emplace_back();
    for (auto h : loop) ring.push_back(p_.origin[h]);
    if (chain.rings.size() > most) return std::nullopt;
    if (chain.rings.size() > 1 && is_cap(loop, start.hollow, chain.last_region)) {
      chain.last = ChainEnd::cap;
      take_region(chain.last_region, chain.last_faces);
      return chain;
    }
    auto next = band(loop);
    if (!next) return std::nullopt;
    if (next->apex != none) {
      chain.last = ChainEnd::apex;
      chain.last_apex = next->apex;
      chain.last_faces = std::move(next->faces);
      return chain;
    }
    align(ring, next->back);
    chain.bands.push_back(std::move(next->faces));
    loop.clear();
    std::vector<std::uint32_t> points;
    for (auto b : next->back) {
      points.push_back(p_.end(b));
      if (p_.twin[b] != none) loop.push_back(p_.twin[b]);
    }
    if (start.end == ChainEnd::closed && std::ranges::find(points, chain.rings[0][0]) != points.end()) {
      chain.last = ChainEnd::closed;
      chain.rings.push_back(std::move(points));
      return chain;
    }
    if (loop.empty()) {
      chain.rings.push_back(std::move(points));
      return chain;
    }
    if (loop.size() != start.loop.size()) return std::nullopt;
  }
}

}  // namespace wrlkit::recognising
