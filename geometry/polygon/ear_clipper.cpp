#include "geometry/polygon/ear_clipper.h"

#include <algorithm>

namespace wrlkit {
namespace {

// Areas and distances, as parts of squared lengths. A corner that is kept away from the diagonals of others by the
// margin is never part of a triangle that counts as flat, and one that is clearly convex cannot be within the margin.
constexpr double flat_triangle = 1e-12;
constexpr double margin = 1e-11;
constexpr double clearly_convex = 1e-10;
constexpr double better_not_an_ear = 1e-6;
constexpr std::size_t max_rescans = 16;   // of all corners
constexpr std::size_t max_effort = 2000;  // a corner; a star of 100,000 needles takes 1000

double square(const Vec2& a, const Vec2& b) {
  double x = b[0] - a[0], y = b[1] - a[1];
  return x * x + y * y;
}

}  // namespace

bool EarClipper::clip(Rings& rings, std::uint32_t start, std::vector<std::uint32_t>& corners) {
  rings_ = &rings;
  corners_ = &corners;
  begin(start);
  while (n_left_ > 3) {
    std::uint32_t node;
    if (next(node))
      try_corner(node);
    else if (!ask_less())
      break;
  }
  if (n_left_ == 3) emit(rings.before(start_), start_, rings.after(start_));
  return !crossing_;
}

void EarClipper::begin(std::uint32_t start) {
  start_ = start;
  ask_ = Ask::everything;
  rescanned_ = effort_ = 0;
  crossing_ = false;
  state_.assign(rings_->nodes.size(), State::idle);
  tree_.build(rings_->at);
  n_left_ = 0;
  tips_.clear();
  for (auto node = start; n_left_ == 0 || node != start; node = rings_->after(node), ++n_left_) {
    tree_.set_live(node, is_flatter(node, clearly_convex));
    if (is_tip(node)) tips_.push_back(node);
  }
  enqueue_all();
}

// -- the queue

void EarClipper::enqueue_all() {
  ready_.clear();
  deferred_.clear();
  round_.clear();
  next_ready_ = next_round_ = 0;
  in_round_ = false;
  auto node = start_;
  do {
    state_[node] = State::ready;
    ready_.push_back(node);
    node = rings_->after(node);
  } while (node != start_);
}

/// The corner whose turn it is: tips before all others, as an ear must not be judged by a spike. Entries whose state
/// has changed since they were made are skipped.
bool EarClipper::next(std::uint32_t& node) {
  auto take = [&](std::vector<std::uint32_t>& queue, std::size_t& at, State state) {
    while (at < queue.size())
      if (node = queue[at++]; state_[node] == state) {
        state_[node] = State::idle;
        return true;
      }
    queue.clear();
    at = 0;
    return false;
  };
  while (!tips_.empty()) {
    node = tips_.back();
    tips_.pop_back();
    if (state_[node] != State::cut) return true;
  }
  while (true) {
    if (in_round_ && take(round_, next_round_, State::deferred)) return true;
    in_round_ = false;
    if (take(ready_, next_ready_, State::ready)) return true;
    if (deferred_.empty()) return false;
    round_.swap(deferred_);
    in_round_ = true;
  }
}

bool EarClipper::ask_less() {
  if (ask_ == Ask::nothing) return false;
  ask_ = static_cast<Ask>(static_cast<int>(ask_) + 1);
  rescanned_ += n_left_;
  enqueue_all();
  return true;
}

void EarClipper::changed(std::uint32_t node) {
  tree_.set_live(node, is_flatter(node, clearly_convex));
  if (is_tip(node)) tips_.push_back(node);
  if (state_[node] == State::ready) return;
  state_[node] = State::ready;
  ready_.push_back(node);
}

// -- ears

void EarClipper::try_corner(std::uint32_t node) {
  if (is_tip(node)) return remove(node);
  if (ask_ != Ask::nothing && rings_->turn(node) <= 0) return;
  if (!in_round_ && is_flatter(node, better_not_an_ear)) {
    state_[node] = State::deferred;
    deferred_.push_back(node);
    return;
  }
  if (effort_ > max_effort * state_.size()) ask_ = std::max(ask_, Ask::convex);
  if (ask_ <= Ask::touching && blocked(node)) return;
  cut_ear(node);
}

/// The end of a part without area: a point that is there twice, or the tip of a spike.
bool EarClipper::is_tip(std::uint32_t node) const {
  const Vec2 &a = rings_->at[rings_->before(node)], &b = rings_->at[node], &c = rings_->at[rings_->after(node)];
  if (a == b || b == c) return true;
  return (a[0] - b[0]) * (c[0] - b[0]) + (a[1] - b[1]) * (c[1] - b[1]) > 0 && orientation(a, b, c) == 0;
}

bool EarClipper::is_flatter(std::uint32_t node, double part) const {
  const Vec2 &a = rings_->at[rings_->before(node)], &b = rings_->at[node], &c = rings_->at[rings_->after(node)];
  return !(orientation(a, b, c) > part * (square(a, b) + square(b, c)));
}

bool EarClipper::blocked(std::uint32_t node) {
  auto before = rings_->before(node), after = rings_->after(node);
  return tree_.any(rings_->at[before], rings_->at[node], rings_->at[after], margin, effort_, [&](std::uint32_t other) {
    return other != before && other != node && other != after && blocks(node, other);
  });
}

/// Whether the boundary enters the triangle of `node` at `other`, or touches its diagonal there.
bool EarClipper::blocks(std::uint32_t node, std::uint32_t other) const {
  const Vec2 &a = rings_->at[rings_->before(node)], &b = rings_->at[node], &c = rings_->at[rings_->after(node)];
  const Vec2& p = rings_->at[other];
  double ab = orientation(a, b, p), bc = orientation(b, c, p), ca = orientation(c, a, p);
  if (ab < 0 || bc < 0 || ca < -margin * square(a, c)) return false;
  if (ask_ == Ask::touching) return ab > 0 && bc > 0 && ca > 0;
  if (ab > 0 && bc > 0) return true;
  // On an edge, or at a corner: only what runs on into the triangle is in the way.
  auto enters = [&](const Vec2& q) {
    return (ab != 0 || orientation(a, b, q) > 0) && (bc != 0 || orientation(b, c, q) > 0) &&
           (ca != 0 || orientation(c, a, q) > 0);
  };
  return enters(rings_->at[rings_->before(other)]) || enters(rings_->at[rings_->after(other)]);
}

void EarClipper::cut_ear(std::uint32_t node) {
  if (ask_ >= Ask::convex) crossing_ = true;
  if (rescanned_ <= max_rescans * state_.size()) ask_ = Ask::everything;
  emit(rings_->before(node), node, rings_->after(node));
  remove(node);
}

void EarClipper::remove(std::uint32_t node) {
  auto before = rings_->before(node), after = rings_->after(node);
  rings_->link(before, after);
  state_[node] = State::cut;
  tree_.set_live(node, false);
  if (start_ == node) start_ = after;
  --n_left_;
  changed(before);
  changed(after);
}

void EarClipper::emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const Vec2 &p = rings_->at[a], &q = rings_->at[b], &r = rings_->at[c];
  double area = orientation(p, q, r);
  if (!(std::abs(area) > flat_triangle * std::max({square(p, q), square(q, r), square(r, p)}))) return;
  if (area < 0) crossing_ = true;
  for (auto node : {a, b, c}) corners_->push_back(rings_->nodes[node].point);
}

}  // namespace wrlkit
