#include "light/emitter_tree.h"

#include <algorithm>
#include <numeric>

namespace wrlkit::light {
namespace {

V3 middle_of(const Emitter& e) { return e.at(1. / 3, 1. / 3); }

double coordinate(const V3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// cos(max(0, a - b)) for angles in [0, pi] given by their cosines and sines.
double cos_of_rest(double cos_a, double cos_b, double sin_b) {
  if (cos_a >= cos_b) return 1;
  return cos_a * cos_b + std::sqrt(std::max(0.0, 1 - cos_a * cos_a)) * sin_b;
}

}  // namespace

EmitterTree::EmitterTree(std::span<const Emitter> emitters) : leaf_of_(emitters.size(), none) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < emitters.size(); ++i)
    if (leaf(emitters[i]).power > 0) order.push_back(i);
  nodes_.reserve(order.size() * 2);
  if (!order.empty()) build(emitters, order, none);
}

EmitterTree::Node EmitterTree::leaf(const Emitter& e) const {
  Node n;
  const V3 across = e.across();
  n.middle = middle_of(e);
  for (const V3& p : {e.corner, e.corner + e.edge1, e.corner + e.edge2})
    n.radius = std::max(n.radius, length(p - n.middle));
  n.axis = unit(across);
  n.wide = e.both_sides;
  n.power = mean(e.radiance) * 0.5 * length(across);
  return n;
}

EmitterTree::Node EmitterTree::join(const Node& a, const Node& b) {
  Node n;
  V3 way = b.middle - a.middle;
  double distance = length(way);
  // The smallest ball around two balls.
  n.radius = std::max({a.radius, b.radius, 0.5 * (distance + a.radius + b.radius)});
  double along = distance > 0 ? std::clamp((n.radius - a.radius) / distance, 0.0, 1.0) : 0;
  n.middle = a.middle + along * way;
  n.power = a.power + b.power;
  double angle_a = std::atan2(a.sin_spread, a.cos_spread), angle_b = std::atan2(b.sin_spread, b.cos_spread);
  double between = std::acos(std::clamp(dot(a.axis, b.axis), -1.0, 1.0));
  // About the middle of the axes, wide enough for both: not the tightest cone, but cheap and safe.
  n.axis = unit(a.axis + b.axis);
  double spread = 0.5 * between + std::max(angle_a, angle_b);
  n.wide = a.wide || b.wide || !(dot(n.axis, n.axis) > 0.5) || spread >= 0.5 * pi;
  n.cos_spread = std::cos(spread);
  n.sin_spread = std::sin(spread);
  return n;
}

std::uint32_t EmitterTree::build(std::span<const Emitter> emitters, std::span<std::uint32_t> order,
                                 std::uint32_t parent) {
  auto id = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  if (order.size() == 1) {
    nodes_[id] = leaf(emitters[order[0]]);
    nodes_[id].emitter = order[0];
    leaf_of_[order[0]] = id;
  } else {
    Box box;
    for (auto i : order) box.add(middle_of(emitters[i]));
    V3 size = box.size();
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    auto half = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
    std::nth_element(order.begin(), half, order.end(), [&](std::uint32_t a, std::uint32_t b) {
      double x = coordinate(middle_of(emitters[a]), axis), y = coordinate(middle_of(emitters[b]), axis);
      return x < y || (x == y && a < b);
    });
    std::uint32_t left = build(emitters, order.first(order.size() / 2), id);
    std::uint32_t right = build(emitters, order.subspan(order.size() / 2), id);
    nodes_[id] = join(nodes_[left], nodes_[right]);
    nodes_[id].left = left;
    nodes_[id].right = right;
  }
  nodes_[id].parent = parent;
  return id;
}

/// What the emitters of a node may give at most, but for how they stand in each other's way.
double EmitterTree::importance(const Node& n, const Receiver& at) {
  V3 way = n.middle - at.start;
  double d2 = dot(way, way), r2 = n.radius * n.radius;
  if (d2 <= r2) return n.power / r2;
  double d = std::sqrt(d2), sin_u = n.radius / d, cos_u = std::sqrt(1 - r2 / d2);
  double arriving = cos_of_rest(dot(at.normal, way) / d, cos_u, sin_u);
  if (!(arriving > 0)) return 0;
  double leaving = 1;
  if (!n.wide) {
    double cos_both = n.cos_spread * cos_u - n.sin_spread * sin_u,
           sin_both = n.sin_spread * cos_u + n.cos_spread * sin_u;
    leaving = cos_of_rest(-dot(n.axis, way) / d, cos_both, sin_both);
    if (!(leaving > 0)) return 0;
  }
  return n.power * arriving * leaving / d2;
}

/// Not a number when neither side can shine there.
double EmitterTree::share_of_left(const Node& n, const Receiver& at) const {
  double left = importance(nodes_[n.left], at), right = importance(nodes_[n.right], at);
  return left / (left + right);
}

void EmitterTree::choose(const Receiver& at, std::span<Choice> choices) const {
  if (!empty()) choose_below(0, 1, at, choices);
}

void EmitterTree::choose_below(std::uint32_t node, double probability, const Receiver& at,
                               std::span<Choice> choices) const {
  while (!choices.empty()) {
    const Node& n = nodes_[node];
    if (n.emitter != none) {
      for (Choice& c : choices) {
        c.emitter = n.emitter;
        c.probability = probability;
      }
      return;
    }
    double left = share_of_left(n, at);
    if (!(left >= 0)) return;
    auto begin_right = std::partition(choices.begin(), choices.end(), [&](const Choice& c) { return c.u < left; });
    std::span<Choice> to_left(choices.begin(), begin_right), to_right(begin_right, choices.end());
    for (Choice& c : to_left) c.u /= left;
    for (Choice& c : to_right) c.u = std::min((c.u - left) / (1 - left), 0x1.fffffffffffffp-1);
    choose_below(n.left, probability * left, at, to_left);
    node = n.right;
    probability *= 1 - left;
    choices = to_right;
  }
}

double EmitterTree::probability(const Receiver& at, std::uint32_t emitter) const {
  double p = 1;
  std::uint32_t child = leaf_of_[emitter];
  if (child == none) return 0;
  for (std::uint32_t node = nodes_[child].parent; node != none; child = node, node = nodes_[node].parent) {
    double left = share_of_left(nodes_[node], at);
    if (!(left >= 0)) return 0;
    p *= child == nodes_[node].left ? left : 1 - left;
  }
  return p;
}

}  // namespace wrlkit::light
