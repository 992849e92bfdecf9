#include "writers/gltf/motion.h"

#include <algorithm>

#include "scenegraph/nodes.h"

namespace wrlkit::gltf {
namespace {

constexpr std::uint32_t no_curve = 0xffffffffu;

struct Row {
  TypeId interpolator, type;
  std::uint16_t slot;
  Motion::Reach reach;
};

const Row* row_of(TypeId interpolator, TypeId type, std::uint16_t slot) {
  using namespace nodes;
  using enum Motion::Reach;
  static constexpr Row rows[] = {
      {PositionInterpolator, Transform, transform::translation.slot, core},
      {OrientationInterpolator, Transform, transform::rotation.slot, core},
      {PositionInterpolator, Transform, transform::scale.slot, core},
      {PositionInterpolator, Viewpoint, viewpoint::position.slot, core},
      {OrientationInterpolator, Viewpoint, viewpoint::orientation.slot, core},
      {PositionInterpolator, PointLight, point_light::location.slot, core},
      {PositionInterpolator, SpotLight, spot_light::location.slot, core},
      {CoordinateInterpolator, Coordinate, coordinate::point.slot, core},
      {NormalInterpolator, Normal, normal::vector.slot, core},
      {ColorInterpolator, Material, material::diffuseColor.slot, pointers},
      {ColorInterpolator, Material, material::emissiveColor.slot, pointers},
      {ColorInterpolator, Material, material::specularColor.slot, pointers},
      {ScalarInterpolator, Material, material::shininess.slot, pointers},
      {ScalarInterpolator, Material, material::transparency.slot, pointers},
      {ColorInterpolator, PhysicalMaterial, physical_material::baseColor.slot, pointers},
      {ColorInterpolator, PhysicalMaterial, physical_material::emissiveColor.slot, pointers},
      {ScalarInterpolator, PhysicalMaterial, physical_material::metallic.slot, pointers},
      {ScalarInterpolator, PhysicalMaterial, physical_material::roughness.slot, pointers},
      {ScalarInterpolator, PhysicalMaterial, physical_material::transparency.slot, pointers},
      {ColorInterpolator, UnlitMaterial, unlit_material::emissiveColor.slot, pointers},
      {ScalarInterpolator, UnlitMaterial, unlit_material::transparency.slot, pointers},
      {ColorInterpolator, DirectionalLight, directional_light::color.slot, pointers},
      {ColorInterpolator, PointLight, point_light::color.slot, pointers},
      {ColorInterpolator, SpotLight, spot_light::color.slot, pointers},
      {ScalarInterpolator, DirectionalLight, directional_light::intensity.slot, pointers},
      {ScalarInterpolator, PointLight, point_light::intensity.slot, pointers},
      {ScalarInterpolator, SpotLight, spot_light::intensity.slot, pointers},
      {ScalarInterpolator, Viewpoint, viewpoint::fieldOfView.slot, pointers},
      {PositionInterpolator2D, TextureTransform, texture_transform::center.slot, pointers},
      {PositionInterpolator2D, TextureTransform, texture_transform::scale.slot, pointers},
      {PositionInterpolator2D, TextureTransform, texture_transform::translation.slot, pointers},
      {ScalarInterpolator, TextureTransform, texture_transform::rotation.slot, pointers}};
  auto i = std::ranges::find_if(
      rows, [&](const Row& r) { return r.interpolator == interpolator && r.type == type && r.slot == slot; });
  return i == std::end(rows) ? nullptr : i;
}

/// glTF scales before it turns, VRML behind.
bool turns_uneven(const Scene& scene, NodeId n, std::uint16_t slot) {
  namespace t = nodes::texture_transform;
  const Vec2 scale = scene.get(n, t::scale);
  return (slot == t::rotation.slot && scale[0] != scale[1]) ||
         (slot == t::scale.slot && scene.get(n, t::rotation) != 0);
}

}  // namespace

Motion::Motion(const Scene& scene, Reach reach, Diagnostics& diag) : scene_(scene), reach_(reach), diag_(diag) {
  if (reach == Reach::nothing) return;
  std::set<std::uint32_t> clocks;
  for (const Route& r : scene.main.routes) {
    onward_.emplace(r.from.value, &r);
    if (scene.is(r.from, nodes::TimeSensor)) clocks.insert(r.from.value);
  }
  for (auto n : clocks) run(NodeId{n});
  count_routes();
}

void Motion::run(NodeId clock) {
  steps_.clear();
  seen_.clear();
  steps_.push_back({clock, nodes::time_sensor::fraction_changed.slot, no_curve, nullptr, 0});
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step at = steps_[i];
    for (auto [r, end] = onward_.equal_range(at.node.value); r != end; ++r) {
      const auto from = scene_.type(at.node).find(r->second->event_out, scene_.dialect(), true);
      if (from != at.slot) continue;
      steps_.push_back(at);
      steps_.back().by = r->second;
      steps_.back().before = i;
      if (!take(at, *r->second))
        steps_.pop_back();
      else
        arrive(steps_.back(), clock);
    }
  }
}

/// The step beyond a ROUTE, in place of the one in front of it.
bool Motion::take(const Step& at, const Route& r) {
  const auto& type = scene_.type(r.to);
  const auto slot = type.find(r.event_in, scene_.dialect(), true);
  if (!slot || n_frames_ >= max_frames || !seen_.insert({r.to.value, *slot}).second) return false;
  Step& next = steps_.back();
  next.node = r.to;
  if (!is_interpolator(scene_, r.to) || r.event_in != "set_fraction") {
    next.slot = *slot;
    if (type.fields[*slot].access != Access::inout) return false;
    if (at.curve != no_curve) return true;
    if (type.fields[*slot].type != FieldType::SFFloat) return false;
    next.curve = static_cast<std::uint32_t>(curves_.size());  // the fraction itself
    curves_.push_back({NodeId{}, {{0, 0}, {1, 1}}});
    return true;
  }
  const bool scalar = at.curve == no_curve || !curves_[at.curve].interpolator ||
                      scene_.is(curves_[at.curve].interpolator, nodes::ScalarInterpolator);
  auto curve = scalar ? follow(scene_, r.to, at.curve == no_curve ? Ramp{} : ramp_of(scene_, curves_[at.curve]),
                               max_frames - n_frames_)
                      : std::nullopt;
  if (!curve) {
    if (scalar && !keys(scene_, r.to).empty() && told_.insert(r.to.value).second)
      diag_.report(Diag::no_gltf_value, scene_.where(r.to), type.name, "key, as it does not ascend,");
    return false;
  }
  n_frames_ += curve->frames.size();
  if (n_frames_ >= max_frames) {
    diag_.report(Diag::expansion_limit, scene_.where(r.to), max_frames, "keys of animations");
    return false;
  }
  next.slot = *type.find("value_changed", scene_.dialect(), true);
  next.curve = static_cast<std::uint32_t>(curves_.size());
  curves_.push_back(std::move(*curve));
  return true;
}

void Motion::arrive(const Step& at, NodeId clock) {
  if (is_interpolator(scene_, at.node)) return;
  const NodeId interpolator = curves_[at.curve].interpolator;
  const Row* row =
      row_of(interpolator ? scene_.type_id(interpolator) : nodes::ScalarInterpolator, scene_.type_id(at.node), at.slot);
  if (!row) return;
  if (scene_.is(at.node, nodes::TextureTransform) && turns_uneven(scene_, at.node, at.slot))
    return diag_.report(Diag::no_gltf_value, scene_.where(at.node), "TextureTransform",
                        "rotation, with a scale that is not even,");
  if (row->reach > reach_) {
    diag_.report(Diag::no_gltf_pointer, scene_.where(at.node), scene_.type(at.node).name,
                 scene_.type(at.node).fields[at.slot].name_in(scene_.dialect()));
    return;
  }
  fields_[{at.node.value, at.slot}].push_back({clock, at.curve});
  clocks_.insert(clock.value);
  for (const Step* s = &at; s->by; s = &steps_[s->before]) expressed_.insert(s->by);
}

void Motion::add_expressed(const std::set<const Route*>& others) {
  expressed_.insert(others.begin(), others.end());
  count_routes();
}

void Motion::count_routes() {
  routes_.clear();
  n_routes_ = expressed_.size();
  for (const Route& r : scene_.main.routes) {
    auto count = [&](NodeId n) {
      auto& [all, said] = routes_[n.value];
      ++all;
      said += expressed_.contains(&r);
    };
    count(r.from);
    if (!scene_.is(r.to, nodes::TimeSensor)) count(r.to);
  }
}

std::span<const Motion::Drive> Motion::drives(NodeId n, std::uint16_t slot) const {
  auto i = fields_.find({n.value, slot});
  return i == fields_.end() ? std::span<const Drive>() : i->second;
}

bool Motion::expressed(NodeId n) const {
  auto i = routes_.find(n.value);
  return i != routes_.end() && i->second.first == i->second.second;
}

}  // namespace wrlkit::gltf
