#include "writers/gltf/interactivity/cascade.h"

#include <algorithm>

#include "base/stop.h"
#include "scenegraph/nodes.h"

namespace wrlkit::gltf {
namespace {

using Type = Graph::Type;

}  // namespace

Cascade::Cascade(const Scene& scene, const Document& document, const Animations& animations, Graph& graph,
                 std::optional<std::uint32_t> tick, Diagnostics& diag)
    : scene_(scene),
      events_(animations.events()),
      graph_(graph),
      diag_(diag),
      targets_(scene, document, animations, graph),
      scripts_(scene, document, graph),
      clocks_(scene, animations, graph, tick,
              [this](Graph::Flow at, NodeId n, Events::Slot slot, const Graph::Value& v) {
                send(std::move(at), n, slot, v);
              }) {}

bool Cascade::one_too_many(NodeId from) {
  if (n_hops_++ == max_hops)
    diag_.report(Diag::expansion_limit, scene_.where(from), max_hops, "ROUTEs followed for KHR_interactivity");
  return n_hops_ > max_hops;
}

void Cascade::send(Graph::Flow at, NodeId n, Events::Slot slot, const Graph::Value& value) {
  if (!at || n_hops_ > max_hops) return;
  check_stop();
  if (path_.size() >= max_length) {
    diag_.report(Diag::expansion_limit, scene_.where(n), max_length, "ROUTEs behind one another");
    return;
  }
  std::vector<Graph::Part> parts;
  for (const Events::Hop& hop : events_.from(n, slot)) {
    if (one_too_many(n)) break;
    if (std::ranges::find(path_, hop.route) != path_.end()) continue;
    parts.push_back([this, &hop, &value](Graph::Flow to) {
      path_.push_back(hop.route);
      receive(std::move(to), hop, value);
      path_.pop_back();
    });
  }
  graph_.in_turn(std::move(at), parts);
}

void Cascade::receive(Graph::Flow at, const Events::Hop& hop, const Graph::Value& value) {
  switch (hop.act) {
    case Act::start:
      return clocks_.start(std::move(at), hop.to);
    case Act::stop:
      return clocks_.stop(std::move(at), hop.to);
    case Act::run_or_halt:
      return clocks_.enable(std::move(at), hop.to, value);
    case Act::repeat:
      return clocks_.repeat(std::move(at), hop.to, value);
    case Act::choose:
      return targets_.choose(std::move(at), hop.to, value);
    case Act::move:
      return targets_.move(std::move(at), hop.to, hop.slot, value);
    case Act::shine:
      return targets_.shine(std::move(at), hop.to, value);
    case Act::bind:
      return targets_.bind(std::move(at), hop.to, value);
    case Act::sound:
      return targets_.sound(std::move(at), hop.to, hop.slot, value);
    case Act::listen:
      return listen(std::move(at), hop.to, value);
    case Act::tell_script:
      return scripts_.tell(std::move(at), hop.to, hop.slot, value);
    default:
      return utility(std::move(at), hop, value);
  }
}

void Cascade::utility(Graph::Flow at, const Events::Hop& hop, const Graph::Value& value) {
  using namespace nodes;
  const NodeId n = hop.to;
  switch (hop.act) {
    case Act::filter:
      return filter(std::move(at), n, value);
    case Act::toggle:
      return toggle(graph_.branch(std::move(at), value).yes, n);
    case Act::set_toggle:
      return set_toggle(std::move(at), n, value);
    case Act::trigger_true:
      return send(std::move(at), n, boolean_trigger::triggerTrue.slot, Graph::value(true));
    case Act::trigger_integer:
      return send(std::move(at), n, integer_trigger::triggerValue.slot,
                  Graph::value(scene_.get(n, integer_trigger::integerKey)));
    case Act::trigger_time:
      return send(std::move(at), n, time_trigger::triggerTime.slot, Graph::value(0.0));
    case Act::at_fraction:
      return at_fraction(std::move(at), n, value);
    case Act::next:
      return step_key(graph_.branch(std::move(at), value).yes, n, 1);
    case Act::previous:
      return step_key(graph_.branch(std::move(at), value).yes, n, -1);
    default:
      return;
  }
}

void Cascade::script(NodeId n) {
  const auto fields = scene_.type(n).fields;
  for (std::uint16_t slot = 0; slot < fields.size(); ++slot) {
    if (!events_.any_from(n, slot)) continue;
    if (fields[slot].type == FieldType::SFNode || fields[slot].type == FieldType::MFNode) {
      direct_output(n, slot);
      continue;
    }
    auto [flow, value] = scripts_.told(n, slot);
    send(std::move(flow), n, slot, value);
  }
}

/// One event for each field of the nodes that it holds there.
void Cascade::direct_output(NodeId n, Events::Slot slot) {
  for (const Events::Hop& hop : events_.from(n, slot)) {
    if (one_too_many(n)) break;
    auto [flow, value] = scripts_.told(n, hop.route->event_out, scene_.type(hop.to).fields[hop.slot].type);
    if (flow) receive(std::move(flow), hop, value);
  }
}

Graph::Variable Cascade::memory(NodeId n, const Graph::Value& initial) {
  const auto at = memory_.find(n.value);
  return at != memory_.end() ? at->second : memory_[n.value] = graph_.variable(initial);
}

Graph::Value Cascade::listens(NodeId sensor) {
  const auto slot = scene_.type(sensor).find("enabled", Dialect::x3d);
  const bool enabled =
      scene_.is(sensor, nodes::TouchSensor)        ? scene_.get(sensor, nodes::touch_sensor::enabled)
      : scene_.is(sensor, nodes::ProximitySensor)  ? scene_.get(sensor, nodes::proximity_sensor::enabled)
      : scene_.is(sensor, nodes::VisibilitySensor) ? scene_.get(sensor, nodes::visibility_sensor::enabled)
                                                   : true;
  if (!slot || !events_.sets(sensor, *slot)) return Graph::value(enabled);
  return graph_.read(memory(sensor, Graph::value(enabled)));
}

void Cascade::listen(Graph::Flow at, NodeId sensor, const Graph::Value& value) {
  listens(sensor);
  graph_.set(at, memory_.at(sensor.value), value);
}

void Cascade::filter(Graph::Flow at, NodeId n, const Graph::Value& value) {
  namespace f = nodes::boolean_filter;
  std::vector<Graph::Part> parts;
  if (events_.any_from(n, f::inputTrue.slot) || events_.any_from(n, f::inputFalse.slot))
    parts.push_back([&](Graph::Flow to) {
      auto [yes, no] = graph_.branch(std::move(to), value);
      send(std::move(yes), n, f::inputTrue.slot, Graph::value(true));
      send(std::move(no), n, f::inputFalse.slot, Graph::value(false));
    });
  if (events_.any_from(n, f::inputNegate.slot))
    parts.push_back([&](Graph::Flow to) {
      const auto opposite = value.is(true)    ? Graph::value(false)
                            : value.is(false) ? Graph::value(true)
                                              : graph_.compute("math/not", Type::boolean, {{"a", value}});
      send(std::move(to), n, f::inputNegate.slot, opposite);
    });
  graph_.in_turn(std::move(at), parts);
}

void Cascade::toggle(Graph::Flow at, NodeId n) {
  if (!at) return;
  const auto state = memory(n, Graph::value(scene_.get(n, nodes::boolean_toggle::toggle)));
  set_toggle(std::move(at), n, graph_.compute("math/not", Type::boolean, {{"a", graph_.read(state)}}));
}

void Cascade::set_toggle(Graph::Flow at, NodeId n, const Graph::Value& value) {
  namespace b = nodes::boolean_toggle;
  const auto state = memory(n, Graph::value(scene_.get(n, b::toggle)));
  graph_.set(at, state, value);
  send(std::move(at), n, b::toggle.slot, graph_.read(state));
}

std::size_t Cascade::n_keys(NodeId n) {
  namespace b = nodes::boolean_sequencer;
  namespace i = nodes::integer_sequencer;
  const bool whole = scene_.is(n, nodes::IntegerSequencer);
  const std::size_t size = whole ? std::min(scene_.get(n, i::key).size(), scene_.get(n, i::keyValue).size())
                                 : std::min(scene_.get(n, b::key).size(), scene_.get(n, b::keyValue).size());
  if (size > max_keys && told_.insert(n.value).second)
    diag_.report(Diag::expansion_limit, scene_.where(n), max_keys, "keys of a sequencer");
  return std::min(size, max_keys);
}

Graph::Value Cascade::key_value(NodeId n, std::size_t i) {
  if (scene_.is(n, nodes::IntegerSequencer)) return Graph::value(scene_.get(n, nodes::integer_sequencer::keyValue)[i]);
  return Graph::value(static_cast<bool>(scene_.get(n, nodes::boolean_sequencer::keyValue)[i]));
}

/// Of the key whose value was sent last; at first none, or the first one where nothing else sends values.
Graph::Variable Cascade::key_index(NodeId n) {
  return memory(n, Graph::value(events_.sets(n, "set_fraction") ? -1 : 0));
}

/// The value of the last key that is not beyond the fraction, whenever that is another key than before (X3D 30.3.2).
void Cascade::at_fraction(Graph::Flow at, NodeId n, const Graph::Value& fraction) {
  const auto size = n_keys(n);
  if (size == 0) return;
  const auto keys = scene_.is(n, nodes::IntegerSequencer) ? scene_.get(n, nodes::integer_sequencer::key)
                                                          : scene_.get(n, nodes::boolean_sequencer::key);
  auto index = Graph::value(0);
  for (std::size_t i = 1; i < size; ++i) {
    const auto beyond =
        graph_.compute("math/ge", Type::boolean, {{"a", fraction}, {"b", Graph::value(static_cast<double>(keys[i]))}});
    index = graph_.compute("math/select", Type::integer,
                           {{"condition", beyond}, {"a", Graph::value(static_cast<std::int32_t>(i))}, {"b", index}});
  }
  const auto last = key_index(n);
  const auto same = graph_.compute("math/eq", Type::boolean, {{"a", index}, {"b", graph_.read(last)}});
  auto changed = graph_.branch(std::move(at), same).no;
  graph_.set(changed, last, index);
  send_key(std::move(changed), n, graph_.read(last));
}

void Cascade::step_key(Graph::Flow at, NodeId n, int by) {
  const auto size = static_cast<std::int32_t>(n_keys(n));
  if (size == 0 || !at) return;
  const auto last = key_index(n);
  const auto sum =
      graph_.compute("math/add", Type::integer, {{"a", graph_.read(last)}, {"b", Graph::value(by > 0 ? 1 : size - 1)}});
  const auto index = graph_.compute("math/rem", Type::integer, {{"a", sum}, {"b", Graph::value(size)}});
  graph_.set(at, last, index);
  send_key(std::move(at), n, graph_.read(last));
}

void Cascade::send_key(Graph::Flow at, NodeId n, const Graph::Value& index) {
  const auto slot = *scene_.type(n).find("value_changed", Dialect::x3d);
  auto value = key_value(n, 0);
  for (std::size_t i = 1; i < n_keys(n); ++i) {
    const auto here =
        graph_.compute("math/eq", Type::boolean, {{"a", index}, {"b", Graph::value(static_cast<std::int32_t>(i))}});
    value = graph_.compute("math/select", value.type, {{"condition", here}, {"a", key_value(n, i)}, {"b", value}});
  }
  send(std::move(at), n, slot, value);
}

}  // namespace wrlkit::gltf
