#include "writers/gltf/document/move_to_origin.h"

#include <algorithm>
#include <cmath>

#include "base/math/affine.h"
#include "writers/gltf/origin.h"

namespace wrlkit::gltf {
namespace {

std::optional<Vec3> chosen(const GltfOrigin& origin, const Box& world) {
  switch (origin.kind) {
    case GltfOrigin::Kind::automatic:
      return world_origin(world);
    case GltfOrigin::Kind::given:
      if (origin.at != Vec3{0, 0, 0}) return origin.at;
      break;
    case GltfOrigin::Kind::none:
      break;
  }
  return std::nullopt;
}

/// Metres from which single precision is coarser than one millimetre.
constexpr double coarse = 1 << 14;

class Moving {
 public:
  Moving(Document& d, const IsAnimated& is_animated) : d_(d), is_animated_(is_animated), is_shared_(d.nodes.size()) {
    for (std::uint32_t i = 0; i < d.nodes.size(); ++i)
      if (const auto same = d.nodes[i].same_as; same != none) is_shared_[i] = is_shared_[same] = 1;
  }

  void move_all(const Vec3& by) {
    push(d_.roots, by, 1);
    while (!open_.empty()) {
      const Step step = open_.back();
      open_.pop_back();
      move(step);
    }
  }

 private:
  struct Step {
    std::uint32_t node;
    Vec3 by;       // in the frame around it
    double scale;  // how much lengths grow from there to the world
  };

  void push(std::span<const std::uint32_t> nodes, const Vec3& by, double scale) {
    for (const auto id : nodes) open_.push_back({id, by, scale});
  }

  void move(const Step& step) {
    Node& n = d_.nodes[step.node];
    if (n.lod) push(d_.lods.at(step.node).levels, step.by, step.scale);
    if (n.transform == none && n.attachment == Attachment::nothing) return push(d_.children_of(n), step.by, step.scale);
    if (n.transform == none) n.transform = d_.add_transform({}, true);
    n.moved = true;
    Trs& t = d_.transforms[n.transform];
    t.translation = t.translation + step.by;
    const double scale = step.scale * stretch(t);
    if (!passes_on(step.node, scale)) return;
    Matrix linear = matrix(t);
    for (int k = 0; k < 3; ++k) linear(k, 3) = 0;
    const Vec3 below = inverse(linear).point(t.translation);
    t.translation = {};
    push(d_.children_of(n), below, scale);
  }

  /// Units and axes of files are a Transform around all, in which parts are as far away as ever.
  bool passes_on(std::uint32_t id, double scale) const {
    const Node& n = d_.nodes[id];
    const auto children = d_.children_of(n);
    if (n.attachment != Attachment::nothing || n.lod || children.empty() || !stays(id) || !(scale > 0)) return false;
    const auto is_far = [&](std::uint32_t c) {
      const Vec3 at = d_.place(d_.nodes[c]).translation;
      return scale * std::hypot(at[0], at[1], at[2]) > coarse;
    };
    return std::ranges::any_of(children, is_far) && std::ranges::all_of(children, [&](auto c) { return stays(c); });
  }

  bool stays(std::uint32_t id) const {
    return !is_shared_[id] && !(is_animated_ && d_.nodes[id].source && is_animated_(d_.nodes[id].source));
  }

  Document& d_;
  const IsAnimated& is_animated_;
  std::vector<char> is_shared_;  // by node: another one has to stay the same
  std::vector<Step> open_;
};

}  // namespace

void move_to_origin(Document& d, const GltfOrigin& origin, const IsAnimated& is_animated) {
  d.origin = chosen(origin, d.world);
  if (d.origin) Moving(d, is_animated).move_all(Vec3{} - *d.origin);
}

}  // namespace wrlkit::gltf
