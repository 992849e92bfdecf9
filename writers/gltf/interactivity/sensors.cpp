#include "writers/gltf/interactivity/sensors.h"

#include <cmath>

#include "base/math/affine.h"
#include "scenegraph/nodes.h"

namespace wrlkit::gltf {
namespace {

using Type = Graph::Type;

Graph::Value camera(Graph& graph, std::string_view what, Type type) {
  return graph.property("/extensions/KHR_interactivity/activeCamera/" + std::string(what), type);
}

Graph::Value all_of(Graph& graph, const std::vector<Graph::Value>& conditions) {
  auto all = conditions[0];
  for (std::size_t i = 1; i < conditions.size(); ++i)
    all = graph.compute("math/and", Type::boolean, {{"a", all}, {"b", conditions[i]}});
  return all;
}

}  // namespace

Sensors::Sensors(const Scene& scene, const Document& document, const Events& events, Graph& graph, Cascade& cascade)
    : scene_(scene), document_(document), events_(events), graph_(graph), cascade_(cascade) {
  family_ = family_of(document);
  for (std::uint32_t id = 0; id < document.nodes.size(); ++id)
    if (const NodeId source = document.nodes[id].source) by_source_[source.value].push_back(id);
  shows_.resize(document.nodes.size());
  for (std::size_t i = family_.order.size(); i-- > 0;) {
    const auto id = family_.order[i], above = family_.parent[id];
    shows_[id] |= document.nodes[id].attachment == Attachment::mesh;
    if (above != none) shows_[above] |= shows_[id];
  }
}

std::vector<std::uint32_t> Sensors::nodes_of(NodeId n) const {
  const auto at = by_source_.find(n.value);
  return at == by_source_.end() ? std::vector<std::uint32_t>() : at->second;
}

std::vector<std::uint32_t> Sensors::held_by(NodeId sensor) const {
  std::vector<std::uint32_t> out;
  for (auto id : nodes_of(sensor)) {
    if (family_.parent[id] != none) {
      out.push_back(family_.parent[id]);
      continue;
    }
    out = document_.roots;
    break;
  }
  std::erase_if(out, [&](std::uint32_t id) { return !shows_[id]; });
  return out;
}

/// From the sensor, where it stands first, to the file's world.
Matrix Sensors::frame(NodeId sensor) const {
  Matrix m;
  const auto places = nodes_of(sensor);
  bool top = true;
  for (auto id = places.empty() ? none : family_.parent[places[0]]; id != none; id = family_.parent[id]) {
    m = matrix(document_.place(document_.nodes[id])) * m;
    top = false;
  }
  if (!top || !document_.origin) return m;
  return matrix(placed_at(-1.0 * *document_.origin, {})) * m;
}

/// One flow for the same event of several nodes: they send it to each other. A sensor that is not enabled leaves a
/// click to those above it.
Graph::Flow Sensors::any_event(std::string_view operation, std::span<const std::uint32_t> nodes,
                               const Graph::Value& enabled) {
  const auto listen = [&](std::uint32_t node) {
    auto [flow, event] = graph_.event(operation, {{"nodeIndex", json_of(node)}});
    flow = graph_.branch(std::move(flow), enabled).yes;
    if (operation == "event/onSelect")
      graph_.step(flow, "event/stopPropagation",
                  {{"stopImmediate", Graph::value(false)}, {"event", {Type::reference, {}, event, "event"}}});
    return flow;
  };
  if (nodes.size() == 1) return listen(nodes[0]);
  const auto id = graph_.custom_event();
  for (auto node : nodes) {
    if (graph_.full()) return {};
    auto flow = listen(node);
    graph_.send(flow, id);
  }
  return graph_.receive(id);
}

void Sensors::touch(NodeId sensor) {
  namespace t = nodes::touch_sensor;
  const auto nodes = held_by(sensor);
  if (nodes.empty() || cascade_.listens(sensor).is(false)) return;
  std::vector<std::pair<Events::Slot, Graph::Value>> events{{t::isActive.slot, Graph::value(true)},
                                                            {t::isActive.slot, Graph::value(false)},
                                                            {t::touchTime.slot, Graph::value(0.0)}};
  std::vector<Graph::Part> parts;
  for (const auto& [slot, value] : events)
    if (events_.any_from(sensor, slot))
      parts.push_back([this, sensor, slot = slot, value = value](Graph::Flow to) {
        cascade_.send(std::move(to), sensor, slot, value);
      });
  if (!parts.empty()) graph_.in_turn(any_event("event/onSelect", nodes, cascade_.listens(sensor)), parts);
  if (!events_.any_from(sensor, t::isOver.slot)) return;
  for (const bool in : {true, false}) {
    auto flow = any_event(in ? "event/onHoverIn" : "event/onHoverOut", nodes, cascade_.listens(sensor));
    cascade_.send(std::move(flow), sensor, t::isOver.slot, Graph::value(in));
  }
}

void Sensors::anchor(NodeId n) {
  const auto nodes = nodes_of(n);
  if (!nodes.empty()) cascade_.targets().open(any_event("event/onSelect", nodes), n);
}

/// Sends what a sensor says when its state is another one than at the last tick.
void Sensors::when_changed(Graph::Flow at, NodeId sensor, const Graph::Value& state, const Says& says) {
  const auto was = graph_.variable(Graph::value(false));
  const auto same = graph_.compute("math/eq", Type::boolean, {{"a", state}, {"b", graph_.read(was)}});
  auto changed = graph_.branch(std::move(at), same).no;
  graph_.set(changed, was, state);
  std::vector<Graph::Part> parts;
  if (events_.any_from(sensor, says.active))
    parts.push_back([&](Graph::Flow to) { cascade_.send(std::move(to), sensor, says.active, graph_.read(was)); });
  if (events_.any_from(sensor, says.enter) || events_.any_from(sensor, says.leave))
    parts.push_back([&](Graph::Flow to) {
      auto [entered, left] = graph_.branch(std::move(to), graph_.read(was));
      cascade_.send(std::move(entered), sensor, says.enter, Graph::value(0.0));
      cascade_.send(std::move(left), sensor, says.leave, Graph::value(0.0));
    });
  graph_.in_turn(std::move(changed), parts);
}

void Sensors::proximity(Graph::Flow at, NodeId sensor) {
  namespace p = nodes::proximity_sensor;
  const Vec3 center = scene_.get(sensor, p::center), size = scene_.get(sensor, p::size);
  if (!(size[0] > 0 && size[1] > 0 && size[2] > 0) || nodes_of(sensor).empty()) return;
  const Matrix to_sensor = inverse(frame(sensor));
  const auto eye = camera(graph_, "position", Type::vec3);
  std::array<Graph::Value, 3> place;
  std::vector<Graph::Value> conditions;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec3 row{to_sensor(i, 0), to_sensor(i, 1), to_sensor(i, 2)};
    const auto along = graph_.compute("math/dot", Type::number, {{"a", eye}, {"b", Graph::value(row)}});
    place[k] = number("math/add", along, Graph::value(to_sensor(i, 3)));
    const auto off = number("math/sub", place[k], Graph::value(center[k]));
    const auto distance = graph_.compute("math/abs", Type::number, {{"a", off}});
    conditions.push_back(graph_.compute("math/le", Type::boolean, {{"a", distance}, {"b", Graph::value(size[k] / 2)}}));
  }
  if (const auto listens = cascade_.listens(sensor); !listens.is(true)) conditions.push_back(listens);
  const auto inside = all_of(graph_, conditions);
  const Says says{p::isActive.slot, p::enterTime.slot, p::exitTime.slot};
  std::vector<Graph::Part> parts{[&](Graph::Flow to) { when_changed(std::move(to), sensor, inside, says); }};
  if (events_.any_from(sensor, p::position_changed.slot) || events_.any_from(sensor, p::orientation_changed.slot))
    parts.push_back([&](Graph::Flow to) { follow(std::move(to), sensor, inside, place); });
  graph_.in_turn(std::move(at), parts);
}

/// Where the viewer is and how he is turned, in the sensor's coordinates, while he is inside.
void Sensors::follow(Graph::Flow at, NodeId sensor, const Graph::Value& inside,
                     const std::array<Graph::Value, 3>& place) {
  namespace p = nodes::proximity_sensor;
  const auto position =
      graph_.compute("math/combine3", Type::vec3, {{"a", place[0]}, {"b", place[1]}, {"c", place[2]}});
  const auto to_sensor = trs_of(inverse(frame(sensor)));
  const auto turn = Graph::value(to_sensor ? to_sensor->rotation : Quaternion{});
  const auto orientation =
      graph_.compute("math/quatMul", Type::vec4, {{"a", turn}, {"b", camera(graph_, "rotation", Type::vec4)}});
  const std::vector<Graph::Part> parts{
      [&](Graph::Flow to) { cascade_.send(std::move(to), sensor, p::position_changed.slot, position); },
      [&](Graph::Flow to) { cascade_.send(std::move(to), sensor, p::orientation_changed.slot, orientation); }};
  graph_.in_turn(graph_.branch(std::move(at), inside).yes, parts);
}

void Sensors::visibility(Graph::Flow at, NodeId sensor) {
  namespace v = nodes::visibility_sensor;
  if (nodes_of(sensor).empty()) return;
  const Matrix to_world = frame(sensor);
  const double radius = length(scene_.get(sensor, v::size)) / 2 * largest_scale(to_world);
  const auto eye = camera(graph_, "position", Type::vec3), turn = camera(graph_, "rotation", Type::vec4);
  const auto from_eye = graph_.compute(
      "math/sub", Type::vec3, {{"a", Graph::value(to_world.point(scene_.get(sensor, v::center)))}, {"b", eye}});
  const auto back = graph_.compute("math/quatConjugate", Type::vec4, {{"a", turn}});
  const auto seen = graph_.compute("math/rotate3D", Type::vec3, {{"a", from_eye}, {"rotation", back}});
  const auto along = [&](const Vec3& axis) {
    return graph_.compute("math/dot", Type::number, {{"a", seen}, {"b", Graph::value(axis)}});
  };
  const auto one = [&](std::string_view operation, const Graph::Value& a) {
    return graph_.compute(operation, Type::number, {{"a", a}});
  };
  const auto depth = along({0, 0, -1});
  const auto half_height = number("math/mul", camera(graph_, "perspective/yfov", Type::number), Graph::value(0.5));
  const auto width =
      number("math/mul", one("math/tan", half_height), camera(graph_, "perspective/aspectRatio", Type::number));
  const auto half_width = one("math/atan", width);
  std::vector<Graph::Value> conditions;
  for (const auto& [across, angle] : {std::pair{along({1, 0, 0}), half_width}, {along({0, 1, 0}), half_height}}) {
    const auto out = number("math/mul", one("math/abs", across), one("math/cos", angle));
    const auto in = number("math/mul", depth, one("math/sin", angle));
    conditions.push_back(
        graph_.compute("math/le", Type::boolean, {{"a", number("math/sub", out, in)}, {"b", Graph::value(radius)}}));
  }
  if (const auto listens = cascade_.listens(sensor); !listens.is(true)) conditions.push_back(listens);
  when_changed(std::move(at), sensor, all_of(graph_, conditions),
               {v::isActive.slot, v::enterTime.slot, v::exitTime.slot});
}

Graph::Value Sensors::number(std::string_view operation, const Graph::Value& a, const Graph::Value& b) {
  return graph_.compute(operation, Type::number, {{"a", a}, {"b", b}});
}

}  // namespace wrlkit::gltf
