#include "writers/gltf/interactivity/graph.h"

#include <algorithm>

namespace wrlkit::gltf {
namespace {

std::string_view signature(Graph::Type type) {
  static constexpr std::string_view names[] = {"bool", "int", "float", "float3", "float4", "ref"};
  return names[static_cast<std::size_t>(type)];
}

using Socket = std::pair<std::string_view, Graph::Type>;

/// An operation that an extension defines, with the values that it gives out.
struct ExtensionOperation {
  std::string_view operation;
  GltfExtension extension;
  std::vector<Socket> outputs;
};

const ExtensionOperation* extension_operation(std::string_view operation) {
  using enum Graph::Type;
  static const std::vector<Socket> hover{
      {"hoveredNode", reference}, {"controllerIndex", integer}, {"event", reference}};
  static const ExtensionOperation all[] = {{"event/onSelect",
                                            GltfExtension::node_selectability,
                                            {{"selectedNode", reference},
                                             {"controllerIndex", integer},
                                             {"selectionPoint", vec3},
                                             {"selectionRayOrigin", vec3},
                                             {"event", reference}}},
                                           {"event/onHoverIn", GltfExtension::node_hoverability, hover},
                                           {"event/onHoverOut", GltfExtension::node_hoverability, hover}};
  const auto* at = std::ranges::find(all, operation, &ExtensionOperation::operation);
  return at == std::end(all) ? nullptr : at;
}

}  // namespace

void Graph::note_type(Type type) {
  if (std::ranges::find(types_, type) == types_.end()) types_.push_back(type);
}

std::uint32_t Graph::type_index(Type type) const {
  return static_cast<std::uint32_t>(std::ranges::find(types_, type) - types_.begin());
}

std::uint32_t Graph::declaration(std::string_view operation) {
  const auto at = std::ranges::find(declarations_, operation);
  const auto index = static_cast<std::uint32_t>(at - declarations_.begin());
  if (at != declarations_.end()) return index;
  declarations_.push_back(operation);
  if (const auto* extension = extension_operation(operation))
    for (const auto& [name, type] : extension->outputs) note_type(type);
  return index;
}

std::uint32_t Graph::add(std::string_view operation, Inputs inputs, Configuration configuration) {
  if (full()) return Flow::none;
  for (const auto& [name, v] : inputs) note_type(v.type);
  nodes_.push_back({declaration(operation), std::move(configuration), std::move(inputs), {}});
  return static_cast<std::uint32_t>(nodes_.size() - 1);
}

Graph::Value Graph::compute(std::string_view operation, Type type, Inputs inputs, Configuration configuration) {
  note_type(type);
  return {type, {}, add(operation, std::move(inputs), std::move(configuration))};
}

Graph::Value Graph::property(const std::string& pointer, Type type) {
  note_type(type);
  return compute("pointer/get", type, {}, {{"pointer", json_of(pointer)}, {"type", json_of(type_index(type))}});
}

Graph::Event Graph::event(std::string_view operation, Configuration configuration) {
  const auto node = add(operation, {}, std::move(configuration));
  return {{node}, node};
}

std::uint32_t Graph::step(Flow& at, std::string_view operation, Inputs inputs, Configuration configuration) {
  if (!at || full()) {
    at = {};
    return Flow::none;
  }
  const auto node = add(operation, std::move(inputs), std::move(configuration));
  nodes_[at.node].flows.emplace_back(at.socket, node);
  at = {node};
  return node;
}

Graph::Branch Graph::branch(Flow at, const Value& condition) {
  if (condition.is(true)) return {std::move(at), {}};
  if (condition.is(false)) return {{}, std::move(at)};
  const auto node = step(at, "flow/branch", {{"condition", condition}});
  return {{node, "true"}, {node, "false"}};
}

void Graph::in_turn(Flow at, std::span<const Part> parts) {
  if (parts.size() == 1) return parts[0](std::move(at));
  if (parts.empty() || !at) return;
  const auto node = step(at, "flow/sequence");
  if (!at) return;
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i]({node, turn(i)});
}

/// Sockets of a sequence are in the order of their names.
std::string Graph::turn(std::size_t i) {
  const std::string digits = std::to_string(i);
  return std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
}

/// A node that no flow goes on from: the flow goes on behind it.
void Graph::act(Flow& at, std::string_view operation, Inputs inputs, Configuration configuration) {
  constexpr std::uint32_t most = 1000;
  if (at && (at.done == 0 || at.done == most)) {
    const auto node = step(at, "flow/sequence");
    at = {node, turn(0)};
  }
  Flow to{at.node, at.socket};
  step(to, operation, std::move(inputs), std::move(configuration));
  if (!to) at = {};
  if (!at) return;
  ++at.done;
  at.socket = turn(at.done);
}

Graph::Variable Graph::variable(const Value& initial) {
  note_type(initial.type);
  variables_.push_back(initial);
  return {static_cast<std::uint32_t>(variables_.size() - 1), initial.type};
}

Graph::Value Graph::read(Variable v) { return compute("variable/get", v.type, {}, {{"variable", json_of(v.index)}}); }

void Graph::set(Flow& at, Variable v, const Value& value) {
  act(at, "variable/set", {{std::to_string(v.index), value}}, {{"variables", json_of(v.index)}});
}

void Graph::set_property(Flow& at, const std::string& pointer, const Value& value) {
  note_type(value.type);
  for (const auto& e : gltf_extensions)
    if (pointer.find(e.name) != std::string::npos) sets_.insert(e.id);
  act(at, "pointer/set", {{"value", value}},
      {{"pointer", json_of(pointer)}, {"type", json_of(type_index(value.type))}});
}

std::uint32_t Graph::custom_event(const std::string& id, std::optional<Type> carries) {
  const auto next = static_cast<std::uint32_t>(events_.size());
  const auto index = id.empty() ? next : event_ids_.try_emplace(id, next).first->second;
  if (index == next) events_.push_back({id, carries});
  if (carries) note_type(*carries);
  return index;
}

void Graph::send(Flow& at, std::uint32_t event, std::optional<Value> value) {
  Inputs inputs;
  if (value) inputs.emplace_back("value", *std::move(value));
  act(at, "event/send", std::move(inputs), {{"event", json_of(event)}});
}

Graph::Flow Graph::receive(std::uint32_t index) { return event("event/receive", {{"event", json_of(index)}}).flow; }

bool Graph::uses(GltfExtension e) const {
  if (e == GltfExtension::interactivity) return !empty();
  if (sets_.contains(e)) return true;
  return std::ranges::any_of(declarations_, [&](std::string_view operation) {
    const auto* extension = extension_operation(operation);
    return extension && extension->extension == e;
  });
}

void Graph::write_declaration(JsonOut& json, std::string_view operation) const {
  json.object([&] {
    json.member("op", operation);
    const auto* extension = extension_operation(operation);
    if (!extension) return;
    json.member("extension", gltf_extension_name(extension->extension));
    json.object("outputValueSockets", [&] {
      for (const auto& [name, type] : extension->outputs) json.member(name, json_object("type", type_index(type)));
    });
  });
}

void Graph::write_node(JsonOut& json, const Node& n) const {
  json.object([&] {
    json.member("declaration", n.declaration);
    if (!n.configuration.empty())
      json.object("configuration", [&] {
        for (const auto& [name, text] : n.configuration)
          json.object(name, [&, &text = text] { json.member("value", JsonText{"[" + text + "]"}); });
      });
    if (!n.inputs.empty())
      json.object("values", [&] {
        for (const auto& [name, v] : n.inputs)
          json.object(name, [&, &v = v] {
            if (v.constant.empty()) return json.members("node", v.node, "socket", v.socket);
            json.member("type", type_index(v.type));
            json.member("value", JsonText{"[" + v.constant + "]"});
          });
      });
    if (n.flows.empty()) return;
    json.object("flows", [&] {
      for (const auto& [socket, to] : n.flows) json.member(socket, json_object("node", to));
    });
  });
}

void Graph::write(JsonOut& json) const {
  json.key("graphs");
  json.begin_array();
  json.object([&] {
    if (!types_.empty())
      json.list("types", types_, [&](Type t) { json.value(json_object("signature", signature(t))); });
    if (!variables_.empty())
      json.list("variables", variables_, [&](const Value& v) {
        json.object([&] {
          json.member("type", type_index(v.type));
          json.member("value", JsonText{"[" + v.constant + "]"});
        });
      });
    if (!events_.empty())
      json.list("events", events_, [&](const CustomEvent& e) {
        json.object([&] {
          if (!e.id.empty()) json.member("id", e.id);
          if (!e.carries) return;
          json.object("values", [&] { json.member("value", json_object("type", type_index(*e.carries))); });
        });
      });
    json.list("declarations", declarations_, [&](std::string_view o) { write_declaration(json, o); });
    json.list("nodes", nodes_, [&](const Node& n) { write_node(json, n); });
  });
  json.end_array();
  json.member("graph", 0);
}

}  // namespace wrlkit::gltf
