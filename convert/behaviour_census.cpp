#include "convert/behaviour_census.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/math/affine.h"
#include "base/math/vec.h"
#include "scenegraph/looks/light_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/places/ways.h"
#include "scenegraph/transform.h"
#include "scenegraph/urls.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// To some four digits. They are binary ones: what is written with five decimal digits often lies halfway between two
/// numbers of four, and falls to either side.
double rounded(double v) {
  constexpr int bits = 12;
  int exponent = 0;
  const double mantissa = std::frexp(v, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, bits)), exponent - bits) + 0.0;
}

void add_value(const Value& v, std::string& out) {
  const auto element = info(v.type).element;
  if (element == Element::number)
    for (const double x : v.number_span()) out += fmt::format(" {}", rounded(x));
  else if (element == Element::integer)
    for (const auto x : v.integer_span()) out += fmt::format(" {}", x);
  else if (v.type == FieldType::SFString)
    (out += ' ') += v.text();
  else if (v.type == FieldType::MFString)
    for (const auto text : v.text_span()) (out += ' ') += text;
}

bool is_animation(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::X3DInterpolatorNode) || scene.is(n, nodes::X3DTimeDependentNode);
}

bool is_other(const Scene& scene, NodeId n) {
  constexpr BaseSet kinds[] = {nodes::X3DBackgroundNode, nodes::X3DFogObject,  nodes::X3DInfoNode,
                               nodes::X3DSensorNode,     nodes::X3DScriptNode, nodes::X3DSoundNode};
  if (scene.is(n, nodes::Collision) || scene.is(n, nodes::Anchor) || scene.is(n, nodes::Billboard)) return true;
  if (scene.is(n, nodes::NavigationInfo) || scene.is(n, nodes::LOD)) return true;
  return std::ranges::any_of(kinds, [&](BaseSet kind) { return scene.is(n, kind); });
}

/// Its type, and what it says that is not the default; without urls, for conversions may have to put files elsewhere.
std::string said_by(const Scene& scene, const UrlFields& urls, NodeId n) {
  const auto& type = scene.type(n);
  std::string out(type.name);
  for (std::uint16_t slot = 0; slot < type.fields.size(); ++slot) {
    const Value* v = scene.find(n, slot);
    if (!v || v->is || urls.use(scene.type_id(n), slot) != UrlUse::none) continue;
    std::string own, usual;
    add_value(*v, own);
    add_value(type.fields[slot].default_value, usual);
    if (own != usual) out += fmt::format(" {}{}", type.fields[slot].name, own);
  }
  return out;
}

/// Its length and its direction, so that what is nearly zero beside the rest does not count.
std::string text_of(const Vec3& v) {
  const double length = wrlkit::length(v);
  std::string out = fmt::format(" {}", rounded(length));
  for (const double x : v) out += fmt::format(" {}", length > 0 ? std::lround(1000 * x / length) : 0);
  return out;
}

/// From where it looks, and how.
std::string viewpoint_text(const Scene& scene, NodeId n, const Matrix& place) {
  namespace f = nodes::viewpoint;
  std::string out(scene.type(n).name);
  if (!scene.is(n, nodes::Viewpoint)) return out + text_of(place.point({}));
  const Matrix turned = place * rotation_matrix(scene.get(n, f::orientation));
  out += fmt::format(" {} {}", scene.get(n, f::description), rounded(scene.get(n, f::fieldOfView)));
  out += text_of(place.point(scene.get(n, f::position)));
  return out + text_of(unit(direction(turned, {0, 0, -1}))) + text_of(unit(direction(turned, {0, 1, 0})));
}

std::string light_text(const Scene& scene, NodeId n, const Matrix& place) {
  const LightNode light = read_light(scene, n);
  std::string out = fmt::format("{} {} {} {}", scene.type(n).name, light.on, light.global, rounded(light.intensity));
  out += text_of(light.color);
  if (light.kind != LightNode::Kind::point) out += text_of(unit(direction(place, light.direction)));
  if (light.kind != LightNode::Kind::directional)
    out +=
        text_of(place.point(light.location)) + text_of(light.attenuation) + fmt::format(" {}", rounded(light.radius));
  if (light.kind == LightNode::Kind::spot)
    out += fmt::format(" {} {}", rounded(light.beam_width), rounded(light.cut_off_angle));
  return out;
}

}  // namespace

BehaviourCensus count_behaviour(const Scene& scene) {
  BehaviourCensus out;
  for (const auto& r : scene.main.routes)
    ++out.routes[fmt::format("{}.{} TO {}.{}", scene.type(r.from).name, r.event_out, scene.type(r.to).name,
                             r.event_in)];
  const UrlFields urls(scene);
  for (const NodeId n : reachable(scene, scene.main))
    if (is_animation(scene, n))
      ++out.animations[said_by(scene, urls, n)];
    else if (is_other(scene, n))
      ++out.others[said_by(scene, urls, n)];
  Ways<Matrix> ways(scene);
  ways.push(scene.main.roots, {});
  while (const auto step = ways.next()) {
    const auto& [n, place] = *step;
    if (scene.is(n, nodes::X3DViewpointNode)) ++out.viewpoints[viewpoint_text(scene, n, place)];
    if (is_light(scene, n)) ++out.lights[light_text(scene, n, place)];
    ways.push(hierarchy_children(scene, n), place * local_matrix(scene, n));
  }
  return out;
}

SaidDifference difference(const SaidTimes& a, const SaidTimes& b) {
  const auto more_in = [](const SaidTimes& one, const SaidTimes& other) {
    std::size_t n = 0;
    for (const auto& [said, times] : one) {
      const auto there = other.find(said);
      const auto known = there == other.end() ? 0 : there->second;
      n += times > known ? times - known : 0;
    }
    return n;
  };
  return {more_in(a, b), more_in(b, a)};
}

}  // namespace wrlkit
