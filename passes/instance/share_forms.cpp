#include "passes/instance/share_forms.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "geometry/forms/form_node.h"
#include "geometry/geometry.h"
#include "geometry/simplify/surface_scales.h"
#include "passes/analysis/placed_surfaces.h"
#include "passes/instance/unit_form.h"
#include "scenegraph/child_lists.h"
#include "scenegraph/nodes.h"
#include "scenegraph/tags.h"
#include "scenegraph/transform.h"
#include "scenegraph/walk.h"

namespace wrlkit::instancing {
namespace {

constexpr std::size_t most_compared = 16;  // classes of one key that a form is compared with, the latest first

struct Class {
  std::vector<std::uint32_t> members;  // surfaces
  std::vector<double> ratios;
};

class Sharing {
 public:
  Sharing(Scene& scene, double tolerance, std::size_t most_places)
      : scene_(scene),
        usage_(scene),
        tolerance_(tolerance),
        most_places_(most_places),
        textured_(textured_geometry(scene)) {}

  std::size_t run() {
    surfaces_ = placed_surfaces(scene_, usage_, [&](NodeId, NodeId g) { return may_share(g); });
    const auto scales = largest_scales(scene_, surfaces_);
    for (std::uint32_t i = 0; i < surfaces_.size(); ++i) sort_in(i, scales[i]);
    find_holders();
    std::size_t gone = 0;
    for (const Class& c : classes_) {
      if (c.members.size() < 2) continue;
      share(c);
      gone += c.members.size() - 1;
    }
    if (!instead_.empty()) replace_children(scene_, instead_);
    return gone;
  }

 private:
  bool may_share(NodeId g) const {
    if (textured_[g.value] || !is_plain(scene_, usage_, g) || has_tags(scene_, g)) return false;
    bool alone = true;
    for_each_child(scene_, g, [&](NodeId) { alone = false; });
    return alone && read_form(scene_, g);
  }

  void sort_in(std::uint32_t i, double world) {
    const NodeId g = surfaces_[i].geometry;
    const auto form = read_form(scene_, g);
    const bool often = most_places_ > 0 && surfaces_[i].shapes.size() > most_places_;
    auto unit = form && !often ? unit_form(*form, is_solid(scene_, g)) : std::nullopt;
    units_.push_back(std::move(unit));
    if (!units_.back()) return;
    const UnitForm& u = *units_.back();
    const double slack = tolerance_ / (world * std::ranges::max(u.scale));
    auto& known = by_key_[u.key];
    const std::size_t first = known.size() - std::min(known.size(), most_compared);
    for (std::size_t k = known.size(); k-- > first;) {
      Class& c = classes_[known[k]];
      if (!std::ranges::equal(c.ratios, u.ratios, [&](double a, double b) { return std::abs(a - b) <= slack; }))
        continue;
      c.members.push_back(i);
      return;
    }
    known.push_back(static_cast<std::uint32_t>(classes_.size()));
    classes_.push_back({{i}, u.ratios});
  }

  /// Transforms that only place one Shape, and could scale it, too.
  void find_holders() {
    namespace f = nodes::transform;
    holder_.resize(scene_.node_count());
    const TransformFields nothing;
    for (NodeId n : reachable(scene_, scene_.main)) {
      if (!scene_.is(n, nodes::Transform) || !is_plain(scene_, usage_, n)) continue;
      const auto children = scene_.get(n, f::children);
      const bool free = scene_.get(n, f::scale) == nothing.scale && scene_.get(n, f::center) == Vec3{} &&
                        scene_.get(n, f::scaleOrientation) == nothing.scale_orientation;
      if (free && children.size() == 1 && usage_.once(children[0])) holder_[children[0].value] = n;
    }
  }

  void share(const Class& c) {
    const ShapeSurface& first = surfaces_[c.members[0]];
    const NodeId one =
        add_form(scene_, units_[c.members[0]]->form, is_solid(scene_, first.geometry), scene_.where(first.geometry));
    for (auto i : c.members) {
      const auto name = scene_.name(surfaces_[i].geometry);
      for (std::size_t k = 0; k < surfaces_[i].shapes.size(); ++k)
        place(surfaces_[i].shapes[k], one, units_[i]->scale, k == 0 ? name : std::string_view());
    }
  }

  void place(NodeId shape, NodeId geometry, const Vec3& scale, std::string_view name) {
    namespace f = nodes::transform;
    scene_.set(shape, nodes::shape::geometry, geometry);
    NodeId t = name.empty() && shape.value < holder_.size() ? holder_[shape.value] : NodeId{};
    if (!t) {
      t = scene_.add(nodes::Transform, scene_.where(shape));
      scene_.set(t, f::children, std::vector<NodeId>{shape});
      scene_.set_name(t, name);
      instead_[shape.value] = t;
    }
    if (scale != Vec3{1, 1, 1}) scene_.set(t, f::scale, scale);
  }

  Scene& scene_;
  Usage usage_;
  double tolerance_;
  std::size_t most_places_;
  std::vector<char> textured_;
  std::vector<ShapeSurface> surfaces_;
  std::vector<std::optional<UnitForm>> units_;
  std::vector<Class> classes_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> by_key_;
  std::vector<NodeId> holder_;  // by Shape
  std::unordered_map<std::uint32_t, NodeId> instead_;
};

}  // namespace

std::size_t share_forms(Scene& scene, double tolerance, int most_places) {
  return Sharing(scene, tolerance, static_cast<std::size_t>(most_places)).run();
}

}  // namespace wrlkit::instancing
