#include "writers/gltf/interactivity/targets.h"

#include <algorithm>

#include "scenegraph/nodes.h"
#include "writers/gltf/document/hierarchy.h"
#include "writers/gltf/number.h"

namespace wrlkit::gltf {
namespace {

using Type = Graph::Type;

std::string node_pointer(std::uint32_t node, std::string_view property) {
  return "/nodes/" + std::to_string(node) + "/" + std::string(property);
}

std::optional<Path> path_of(std::uint16_t slot) {
  using namespace nodes::transform;
  if (slot == translation.slot) return Path::translation;
  if (slot == rotation.slot) return Path::rotation;
  if (slot == scale.slot) return Path::scale;
  return std::nullopt;
}

/// What shows a node or hides it. What is hidden can still be clicked (KHR_node_visibility), other than a Switch has
/// it.
std::vector<std::string_view> properties_of_choice(const Scene& scene, const Events& events) {
  namespace touch = nodes::touch_sensor;
  const auto any = [&](auto has) { return std::ranges::any_of(events.sources(), has); };
  std::vector<std::string_view> out{"extensions/KHR_node_visibility/visible"};
  if (any([&](NodeId n) { return scene.is(n, nodes::TouchSensor) || scene.is(n, nodes::Anchor); }))
    out.push_back("extensions/KHR_node_selectability/selectable");
  if (any([&](NodeId n) { return scene.is(n, nodes::TouchSensor) && events.any_from(n, touch::isOver.slot); }))
    out.push_back("extensions/KHR_node_hoverability/hoverable");
  return out;
}

}  // namespace

Targets::Targets(const Scene& scene, const Document& document, const Animations& animations, Graph& graph)
    : scene_(scene),
      document_(document),
      animations_(animations),
      graph_(graph),
      choice_(properties_of_choice(scene, animations.events())) {
  const Family family = family_of(document);
  for (std::uint32_t id = 0; id < document.nodes.size(); ++id) {
    const auto above = family.parent[id];
    if (document.nodes[id].choice != none && above != none && document.nodes[above].source)
      chosen_[document.nodes[above].source.value].push_back(id);
  }
  for (std::uint32_t id = 0; id < document.nodes.size(); ++id) {
    const NodeId n = document.nodes[id].source;
    if (!n || !scene.is(n, nodes::Sound)) continue;
    sounds_[n.value].push_back(id);
    if (const NodeId clip = scene.get(n, nodes::sound::source)) sounds_[clip.value].push_back(id);
  }
  for (std::size_t i = 0; i < document.lights.size(); ++i) lights_[document.lights[i].source.value].push_back(i);
}

void Targets::choose(Graph::Flow at, NodeId n, const Graph::Value& choice) {
  for (auto id : chosen_[n.value]) {
    if (!at) return;
    const auto index = Graph::value(static_cast<std::int32_t>(document_.nodes[id].choice));
    const bool known = !choice.constant.empty();
    const auto shown = known ? Graph::value(choice.constant == index.constant)
                             : graph_.compute("math/eq", Type::boolean, {{"a", choice}, {"b", index}});
    for (const auto property : choice_) graph_.set_property(at, node_pointer(id, property), shown);
  }
}

void Targets::move(Graph::Flow at, NodeId n, std::uint16_t slot, const Graph::Value& value) {
  const auto path = path_of(slot);
  if (!path) return;
  for (auto id : animations_.targets(n, *path)) {
    if (!at) return;
    const Vec3 offset = *path == Path::translation ? offset_of(document_, scene_, id) : Vec3{0, 0, 0};
    const auto there = offset == Vec3{0, 0, 0}
                           ? value
                           : graph_.compute("math/add", Type::vec3, {{"a", value}, {"b", Graph::value(offset)}});
    graph_.set_property(at, node_pointer(id, name_of(*path)), there);
  }
}

void Targets::shine(Graph::Flow at, NodeId n, const Graph::Value& on) {
  for (const auto i : lights_[n.value]) {
    if (!at) return;
    const Light& light = document_.lights[i];
    const double full = to_float(read_light(scene_, n).intensity * full_intensity(scene_, light, document_.world));
    const auto intensity = graph_.compute("math/select", Type::number,
                                          {{"condition", on}, {"a", Graph::value(full)}, {"b", Graph::value(0.0)}});
    graph_.set_property(at, "/extensions/KHR_lights_punctual/lights/" + std::to_string(i) + "/intensity", intensity);
  }
}

void Targets::bind(Graph::Flow at, NodeId n, const Graph::Value& bound) {
  auto yes = graph_.branch(std::move(at), bound).yes;
  send(yes, n, "set_bind", "viewpoint:" + std::string(camera_name(scene_, n)));
}

void Targets::open(Graph::Flow at, NodeId anchor) {
  const auto urls = scene_.get(anchor, nodes::anchor::url);
  const std::string_view url = urls[0];
  const bool inside = url.starts_with('#');
  send(at, anchor, "url", (inside ? "viewpoint:" : "open:") + std::string(inside ? url.substr(1) : url));
}

void Targets::sound(Graph::Flow at, NodeId n, std::uint16_t slot, const Graph::Value& value) {
  const FieldDef& field = scene_.type(n).fields[slot];
  for (const auto id : sounds_[n.value]) {
    const auto event = "sound:" + std::to_string(id) + ":" + std::string(field.name);
    if (field.type == FieldType::SFTime)
      send(at, n, field.name, event);
    else
      send(at, n, field.name, event, value);
  }
}

void Targets::send(Graph::Flow& at, NodeId from, std::string_view field, const std::string& event,
                   std::optional<Graph::Value> value) {
  if (!at) return;
  const auto carries = value ? std::optional(value->type) : std::nullopt;
  graph_.send(at, graph_.custom_event(event, carries), std::move(value));
  sent_.try_emplace(scene_.type(from).name, Sent{from, field, event});
}

void Targets::report(Diagnostics& diag) const {
  for (const auto& [type, sent] : sent_)
    diag.report(Diag::no_gltf_value, scene_.where(sent.first), type,
                std::string(sent.field) + ", other than as the event '" + sent.event + "' to the viewer,");
}

}  // namespace wrlkit::gltf
