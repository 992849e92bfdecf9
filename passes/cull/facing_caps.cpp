#include "passes/cull/facing_caps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <vector>

#include "base/hashing.h"
#include "base/math/vec.h"
#include "geometry/forms/form_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/places/places.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

constexpr double apart = 2e-4;    // metres
constexpr double aslant = 1e-3;   // radians
constexpr std::size_t most = 64;  // caps around one middle that are compared

/// A disc or an annulus, in metres of the world.
struct Cap {
  Vec3 centre, axis, first;
  double outer = 0, inner = 0;
  int segments = 0;
  std::uint32_t place = 0;
  bool top = false;
};

struct FormPlace {
  NodeId shape;
  std::uint8_t hidden = 0;  // 1: the cap at the bottom, 2: at the top
};

bool is_closed(const Form& form) {
  const auto* frustum = std::get_if<FrustumForm>(&form.shape);
  return (form.bottom || (frustum && frustum->bottom_radius == 0)) &&
         (form.top || (frustum && frustum->top_radius == 0));
}

bool face_each_other(const Cap& a, const Cap& b) {
  return length(a.centre - b.centre) <= apart && length(a.axis + b.axis) <= aslant;
}

/// With corners in the same places.
bool are_equal(const Cap& a, const Cap& b) {
  if (a.segments != b.segments || std::abs(a.outer - b.outer) > apart || std::abs(a.inner - b.inner) > apart)
    return false;
  const double turn = std::atan2(dot(cross(a.first, b.first), a.axis), dot(a.first, b.first));
  const double step = 2 * std::numbers::pi / a.segments;
  return std::abs(turn - step * std::round(turn / step)) * a.outer <= apart;
}

bool is_within(const Cap& a, const Cap& b) {
  return a.outer <= b.outer * std::cos(std::numbers::pi / b.segments) && a.inner >= b.inner;
}

class Ends {
 public:
  Ends(Scene& scene, const std::function<bool(NodeId)>& may_change) : scene_(scene), may_change_(may_change) {}

  DroppedCaps run() {
    if (!for_each_place(scene_, Shown::now, [&](NodeId shape, const Matrix& m) { add(shape, m); })) return {};
    hide([](const Cap& a, const Cap& b) { return are_equal(a, b); });
    hide([&](const Cap& a, const Cap& b) { return is_within(a, b) && !is_hidden(b); });
    return open();
  }

 private:
  const Form* form_of(NodeId shape) {
    const NodeId g = scene_.get(shape, nodes::shape::geometry);
    if (!g || !scene_.name(g).empty() || !may_change_(shape)) return nullptr;
    const auto [at, is_new] = forms_.try_emplace(g.value);
    if (is_new) at->second = read_form(scene_, g);
    const auto& form = at->second;
    return form && form->segments > 0 && is_closed(*form) ? &*form : nullptr;
  }

  void add(NodeId shape, const Matrix& m) {
    const Form* form = form_of(shape);
    if (!form) return;
    const double scale = scale_of(m);
    const auto is_rigid = [&](int a, int b) {
      return std::abs(dot(m.column(a), m.column(b)) - (a == b ? scale * scale : 0)) <= 1e-6 * scale * scale;
    };
    for (int a = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b)
        if (!is_rigid(a, b)) return;
    const auto place = static_cast<std::uint32_t>(places_.size());
    places_.push_back({shape});
    const auto* ring = std::get_if<RingForm>(&form->shape);
    Form placed = *form;
    placed.frame = m * form->frame;
    for (const FormEnd& end : round_ends(placed)) {
      const std::size_t n = caps_.size();
      caps_.push_back({end.centre, end.axis, end.first, end.radius * scale, ring ? ring->inner_radius * scale : 0,
                       form->segments, place, end.top});
      by_cell_[cell(end.centre, {})].push_back(n);
    }
  }

  static std::uint64_t cell(const Vec3& p, const std::array<int, 3>& next) {
    std::uint64_t out = 0;
    for (std::size_t k = 0; k < 3; ++k)
      out = mixed(out, static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(p[k] / (4 * apart)) + next[k])));
    return out;
  }

  static std::uint8_t bit(const Cap& c) { return c.top ? 2 : 1; }
  bool is_hidden(const Cap& c) const { return places_[c.place].hidden & bit(c); }

  /// Caps for which there is one that faces them and passes.
  template <class Covers>
  void hide(Covers&& covers) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < caps_.size(); ++i) {
      if (is_hidden(caps_[i])) continue;
      const bool covered = any_near(caps_[i], [&](const Cap& other) {
        return other.place != caps_[i].place && face_each_other(caps_[i], other) && covers(caps_[i], other);
      });
      if (covered) found.push_back(i);
    }
    for (auto i : found) places_[caps_[i].place].hidden |= bit(caps_[i]);
  }

  template <class F>
  bool any_near(const Cap& cap, F&& f) const {
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto near = by_cell_.find(cell(cap.centre, {x, y, z}));
          if (near == by_cell_.end()) continue;
          const auto& all = near->second;
          for (std::size_t k = 0; k < std::min(all.size(), most); ++k)
            if (f(caps_[all[k]])) return true;
        }
    return false;
  }

  /// Each Shape by the caps that are hidden in all of its places.
  DroppedCaps open() {
    std::map<NodeId, std::uint8_t> hidden;
    for (const FormPlace& p : places_) {
      const auto [at, is_new] = hidden.try_emplace(p.shape, p.hidden);
      if (!is_new) at->second &= p.hidden;
    }
    DroppedCaps out;
    std::map<std::pair<NodeId, std::uint8_t>, NodeId> made;
    for (const auto& [shape, caps] : hidden) {
      if (!caps) continue;
      const NodeId old = scene_.get(shape, nodes::shape::geometry);
      Form form = *forms_[old.value];
      const auto before = n_triangles(form, {});
      if (caps & 1) form.bottom = false;
      if (caps & 2) form.top = false;
      NodeId& one = made[{old, caps}];
      if (!one) one = add_form(scene_, form, is_solid(scene_, old), scene_.where(old));
      scene_.set(shape, nodes::shape::geometry, one);
      out.caps += (caps & 1) + (caps >> 1);
      out.triangles += before - n_triangles(form, {});
    }
    return out;
  }

  Scene& scene_;
  const std::function<bool(NodeId)>& may_change_;
  std::unordered_map<std::uint32_t, std::optional<Form>> forms_;  // by geometry
  std::vector<FormPlace> places_;
  std::vector<Cap> caps_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> by_cell_;
};

}  // namespace

DroppedCaps drop_facing_caps(Scene& scene, const std::function<bool(NodeId)>& may_change) {
  return Ends(scene, may_change).run();
}

}  // namespace wrlkit
