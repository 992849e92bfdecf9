#include "geometry/simplify/neighbours.h"

#include <algorithm>
#include <limits>

namespace wrlkit::simplify {
namespace {

constexpr std::size_t least_rebuilt = 1000;  // triangles
constexpr std::size_t least_crowd = 4096;    // triangles of a part with a tree of its own,
constexpr std::size_t crowd_share = 8;       // and the part of all that they are at least

}  // namespace

void Neighbours::add(const Triangles& surface, std::span<const std::uint32_t> faces, const Matrix& place,
                     std::uint32_t owner) {
  slot_.reset(surface.positions.size() / 3);
  for (auto f : faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto c = surface.corners[std::size_t{3} * f + k];
      if (!slot_.contains(c)) {
        slot_.set(c, static_cast<std::uint32_t>(positions_.size() / 3));
        const Vec3 p = place.point(surface.position(c));
        positions_.insert(positions_.end(), p.begin(), p.end());
      }
      corners_.push_back(slot_[c]);
    }
  owner_.insert(owner_.end(), faces.size(), owner);
}

void Neighbours::end_part() { part_ends_.push_back(static_cast<std::uint32_t>(owner_.size())); }

/// The first range is that of all parts without a tree of their own.
void Neighbours::prepare() {
  std::vector<std::array<std::uint32_t, 2>> common, crowds;
  std::uint32_t begin = 0;
  for (const auto end : part_ends_) {
    const std::size_t n = end - begin;
    const bool is_crowd = n >= least_crowd && crowd_share * n >= owner_.size() && owner_[begin] != owner_[end - 1];
    (is_crowd ? crowds : common).push_back({begin, end});
    begin = end;
  }
  left_.assign(owner_.empty() ? 0 : owner_.back() + std::size_t{1}, 1);
  std::vector<std::uint32_t> corners, owner;
  corners.reserve(corners_.size());
  owner.reserve(owner_.size());
  const auto append = [&](const std::array<std::uint32_t, 2>& part) {
    corners.insert(corners.end(), corners_.begin() + 3 * std::ptrdiff_t{part[0]},
                   corners_.begin() + 3 * std::ptrdiff_t{part[1]});
    owner.insert(owner.end(), owner_.begin() + part[0], owner_.begin() + part[1]);
    return static_cast<std::uint32_t>(owner.size());
  };
  ranges_.push_back({0, 0});
  for (const auto& part : common) ranges_[0].end = append(part);
  for (const auto& part : crowds) {
    const auto first = static_cast<std::uint32_t>(owner.size());
    ranges_.push_back({first, append(part)});
  }
  corners_ = std::move(corners);
  owner_ = std::move(owner);
  for (auto& range : ranges_) make_tree(range);
}

void Neighbours::make_tree(Range& range) const {
  const auto n = range.end - range.begin;
  const auto corners = std::span(corners_).subspan(std::size_t{3} * range.begin, std::size_t{3} * n);
  range.tree.emplace(Triangles{positions_, corners}, std::span(owner_).subspan(range.begin, n));
  range.n_gone = 0;
}

/// A tree is made again when half of it is gone.
void Neighbours::leave(std::uint32_t first, std::uint32_t end) {
  std::fill(left_.begin() + first, left_.begin() + end, char{0});
  for (auto& range : ranges_) {
    const auto owners = std::span(owner_).subspan(range.begin, range.end - range.begin);
    const auto n = std::ranges::lower_bound(owners, end) - std::ranges::lower_bound(owners, first);
    if (n == 0) continue;
    range.n_gone += static_cast<std::size_t>(n);
    if (2 * range.n_gone >= owners.size() && owners.size() >= least_rebuilt)
      compact(range);
    else
      range.tree->forget(first, end);
  }
}

void Neighbours::compact(Range& range) {
  range.tree.reset();
  auto to = range.begin;
  for (auto t = range.begin; t < range.end; ++t) {
    if (left_[owner_[t]] == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) corners_[std::size_t{3} * to + k] = corners_[std::size_t{3} * t + k];
    owner_[to++] = owner_[t];
  }
  range.end = to;
  make_tree(range);
}

bool Neighbours::counts_in(const Range& range, const ClosestPoint::Counting& counts) const {
  return range.begin < range.end && (owner_[range.begin] < counts.first || owner_[range.end - 1] >= counts.end);
}

Neighbours::Found Neighbours::nearest(const Vec3& p, double within, const ClosestPoint::Counting& counts,
                                      std::uint32_t guess) const {
  constexpr auto none = ClosestPoint::no_guess;
  Found found{std::numeric_limits<double>::infinity(), none, none};
  const auto ask = [&](const Range& range, std::uint32_t guess_there) {
    if (!counts_in(range, counts)) return;
    const auto there = range.tree->nearest_of(p, within, counts, guess_there);
    if (there.triangle == none || there.distance >= found.distance) return;
    within = there.distance;
    found = {there.distance, owner_[range.begin + there.triangle], range.begin + there.triangle};
  };
  const auto has_guess = [&](const Range& range) { return range.begin <= guess && guess < range.end; };
  for (const auto& range : ranges_)
    if (has_guess(range)) ask(range, guess - range.begin);
  for (const auto& range : ranges_)
    if (!has_guess(range)) ask(range, none);
  return found;
}

}  // namespace wrlkit::simplify
