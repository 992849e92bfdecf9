#include "writers/gltf/document/round_transforms.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace wrlkit::gltf {
namespace {

/// Digits behind the point, as the nearest double: 0.1 + 0.2 is written 0.3.
double decimal(double v, int digits) {
  const double per_unit = std::pow(10, digits);
  return std::round(v * per_unit) / per_unit;
}

int digits_for(double size) { return static_cast<int>(std::ceil(std::log10(std::max(size, 1e-9)))); }

/// How far what is in each node goes, in its frame.
std::vector<double> reaches(const Document& d, const Family& family, const RoundingRules& rules) {
  std::vector<double> reach(d.nodes.size(), 0);
  for (std::size_t i = family.order.size(); i-- > 0;) {
    const std::uint32_t id = family.order[i], parent = family.parent[id];
    const Node& n = d.nodes[id];
    if (n.attachment == Attachment::mesh && n.instances == none)
      reach[id] = std::max(reach[id], rules.reach(n.attached));
    if (n.instances != none)
      for (const Trs& t : d.instances[n.instances].places)
        reach[id] = std::max(reach[id], length(t.translation) + stretch(t) * rules.reach(n.attached));
    if (n.attachment == Attachment::camera || n.attachment == Attachment::light)
      reach[id] = std::max(reach[id], diagonal(d.world));
    const Trs t = d.place(n);
    if (parent != none) reach[parent] = std::max(reach[parent], length(t.translation) + stretch(t) * reach[id]);
  }
  return reach;
}

/// `scale`: how much lengths grow on the way to the frame that the node is in.
Trs rounded(const Trs& t, int digits, double scale, double reach) {
  Trs r = t;
  const int turn_digits = std::clamp(digits + digits_for(2 * reach * scale * stretch(t)), 3, 15);
  const int place_digits = std::clamp(digits + digits_for(scale), 0, 15);
  for (double& v : r.translation) v = decimal(v, place_digits);
  for (double& v : r.scale) v = decimal(v, turn_digits) == 0 ? v : decimal(v, turn_digits);
  for (double* v : {&r.rotation.x, &r.rotation.y, &r.rotation.z, &r.rotation.w}) *v = decimal(*v, turn_digits);
  return r;
}

/// How far a point at `reach` from the node may be from where it was, in the frame that the node is in.
double moved_by(const Trs& t, const Trs& r, double reach) {
  const Quaternion &a = t.rotation, &b = r.rotation;
  const double place = length(t.translation - r.translation), grown = length(t.scale - r.scale);
  const double turn = 2 * std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z) +
                                    (a.w - b.w) * (a.w - b.w));
  return place + (turn * stretch(t) + grown) * reach;
}

struct Attempt {
  std::vector<std::pair<std::uint32_t, Trs>> transforms;  // by their place in Document::transforms
  double worst = 0;
};

Attempt round_to(const Document& d, const Family& family, std::span<const double> reach, const RoundingRules& rules,
                 int digits) {
  Attempt out;
  std::vector<double> moved(d.nodes.size(), 0), scale(d.nodes.size(), 1);
  for (std::uint32_t id : family.order) {
    if (const auto parent = family.parent[id]; parent != none) {
      moved[id] = moved[parent];
      scale[id] = scale[parent];
    }
    const Node& n = d.nodes[id];
    const Trs t = d.place(n);
    if (n.transform != none && !rules.moves(n.source)) {
      const Trs r = rounded(t, digits, scale[id], reach[id]);
      moved[id] += scale[id] * moved_by(t, r, reach[id]);
      out.worst = std::max(out.worst, moved[id]);
      out.transforms.emplace_back(n.transform, r);
    }
    scale[id] *= stretch(t);
  }
  return out;
}

}  // namespace

/// The fewest digits with which the sum on the way to each leaf stays below the tolerance.
double round_transforms(Document& d, const RoundingRules& rules) {
  constexpr int most = 9;
  const Family family = family_of(d);
  const auto reach = reaches(d, family, rules);
  for (int digits = std::max(0, static_cast<int>(std::floor(-std::log10(rules.tolerance)))); digits <= most; ++digits) {
    const Attempt attempt = round_to(d, family, reach, rules, digits);
    if (attempt.worst > rules.tolerance) continue;
    for (const auto& [transform, t] : attempt.transforms) d.transforms[transform] = t;
    return attempt.worst;
  }
  return 0;
}

}  // namespace wrlkit::gltf
