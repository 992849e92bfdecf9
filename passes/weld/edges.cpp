// Corners are chained by the lower point of the edge that starts at them. While the chain of a point is walked, `seen`
// holds for each other end the edge that was found last; it is right if it was found from this same point.
#include "passes/weld/edges.h"

namespace wrlkit {
namespace {

constexpr std::uint32_t none = 0xffffffffu;

std::uint32_t root(std::vector<std::uint32_t>& parents, std::uint32_t c) {
  while (parents[c] != c) c = parents[c] = parents[parents[c]];
  return c;
}

void unite(std::vector<std::uint32_t>& parents, std::uint32_t a, std::uint32_t b) {
  a = root(parents, a);
  b = root(parents, b);
  parents[std::max(a, b)] = std::min(a, b);
}

}  // namespace

void EdgeTable::build(const Surface& s) {
  const auto& corners = s.mesh.corners;
  first_.assign(s.n_points(), none);
  links_.resize(corners.size());
  for (std::uint32_t f = s.n_faces(); f-- > 0;)  // backwards, so that chains run forwards
    for (std::uint32_t c = s.end(f), next = s.begin(f); c-- > s.begin(f); next = c) {
      std::uint32_t low = std::min(corners[c], corners[next]), high = std::max(corners[c], corners[next]);
      if (low == high) continue;
      links_[c] = {high, first_[low]};
      first_[low] = c;
    }
  seen_.assign(s.n_points(), {none, none});
  edges_.clear();
  for (std::uint32_t p = 0; p < s.n_points(); ++p)
    for (std::uint32_t c = first_[p]; c != none; c = links_[c].next) {
      Seen& seen = seen_[links_[c].high];
      if (seen.low != p) {
        seen = {p, static_cast<std::uint32_t>(edges_.size())};
        edges_.push_back({c, none, 1});
      } else if (++edges_[seen.edge].n_faces == 2) {
        edges_[seen.edge].second = c;
      }
    }
}

/// Across a manifold edge the corners of both its faces are united, at either end. What is left apart at a point are
/// fans of their own.
std::size_t count_non_manifold_points(const Surface& s, const std::vector<SurfaceEdge>& edges,
                                      std::vector<std::uint32_t>& parents, std::vector<std::uint32_t>& fans) {
  const auto& corners = s.mesh.corners;
  parents.resize(corners.size());
  for (std::uint32_t c = 0; c < corners.size(); ++c) parents[c] = c;
  for (const SurfaceEdge& e : edges) {
    if (!e.manifold()) continue;
    std::uint32_t a = s.after(e.first), b = s.after(e.second);
    bool opposite = corners[e.first] != corners[e.second];  // as it should be
    unite(parents, e.first, opposite ? b : e.second);
    unite(parents, a, opposite ? e.second : b);
  }
  fans.assign(s.n_points(), 0);
  std::size_t n = 0;
  for (std::uint32_t c = 0; c < corners.size(); ++c)
    if (parents[c] == c && ++fans[corners[c]] == 2) ++n;
  return n;
}

}  // namespace wrlkit
