#include "writers/gltf/interactivity/clocks.h"

#include "scenegraph/nodes.h"

namespace wrlkit::gltf {
namespace {

namespace t = nodes::time_sensor;
using Type = Graph::Type;

}  // namespace

Clocks::Clocks(const Scene& scene, const Animations& animations, Graph& graph, std::optional<std::uint32_t> tick,
               Send send)
    : scene_(scene), animations_(animations), graph_(graph), tick_(tick), send_(std::move(send)) {}

bool Clocks::ticks(const Events& events, NodeId n) {
  return events.any_from(n, t::isActive.slot) || events.any_from(n, t::cycleTime.slot) ||
         events.any_from(n, t::fraction_changed.slot);
}

bool Clocks::runs_at_first(const Scene& scene, NodeId n) {
  const double start = scene.get(n, t::startTime), stop = scene.get(n, t::stopTime);
  return scene.get(n, t::enabled) && scene.get(n, t::loop) && !(stop > start);
}

Clocks::Clock& Clocks::clock(NodeId n) {
  const auto [at, is_new] = clocks_.try_emplace(n.value, Clock{.node = n});
  Clock& c = at->second;
  if (!is_new) return c;
  const Events& events = animations_.events();
  if (const auto i = animations_.index_of(n)) c.animation = Graph::reference("/animations/" + std::to_string(*i));
  c.cycle = animations_.cycle_of(n);
  c.ticks = ticks(events, n);
  c.active = graph_.variable(Graph::value(false));
  if (c.ticks) {
    c.started = graph_.variable(Graph::value(0.0));
    c.round = graph_.variable(Graph::value(0.0));
  }
  if (events.sets(n, t::enabled.slot)) c.enabled = graph_.variable(Graph::value(scene_.get(n, t::enabled)));
  if (events.sets(n, t::loop.slot)) c.loop = graph_.variable(Graph::value(scene_.get(n, t::loop)));
  return c;
}

Graph::Value Clocks::enabled(const Clock& c) {
  return c.enabled ? graph_.read(*c.enabled) : Graph::value(scene_.get(c.node, t::enabled));
}

Graph::Value Clocks::loop(const Clock& c) {
  return c.loop ? graph_.read(*c.loop) : Graph::value(scene_.get(c.node, t::loop));
}

Graph::Value Clocks::now() { return {Type::number, {}, *tick_, "timeSinceStart"}; }

/// Where its animation ends.
Graph::Value Clocks::end(const Clock& c) {
  const auto repeats = loop(c), once = Graph::value(c.cycle);
  if (repeats.is(false)) return once;
  const auto never = graph_.compute("math/Inf", Type::number, {});
  if (repeats.is(true)) return never;
  return graph_.compute("math/select", Type::number, {{"condition", repeats}, {"a", never}, {"b", once}});
}

void Clocks::play(Graph::Flow& at, const Clock& c) {
  const auto node = graph_.step(at, "animation/start",
                                {{"animation", c.animation},
                                 {"startTime", Graph::value(0.0)},
                                 {"endTime", end(c)},
                                 {"speed", Graph::value(1.0)}});
  Graph::Flow done{node, "done"};
  if (!c.ticks) graph_.set(done, c.active, Graph::value(false));
}

void Clocks::start(Graph::Flow at, NodeId n) {
  const Clock& c = clock(n);
  at = graph_.branch(std::move(at), enabled(c)).yes;
  if (!at) return;
  at = graph_.branch(std::move(at), graph_.read(c.active)).no;
  if (c.ticks) {
    graph_.set(at, c.started, tick_ && !starting_ ? now() : Graph::value(0.0));
    graph_.set(at, c.round, Graph::value(0.0));
  }
  graph_.set(at, c.active, Graph::value(true));
  if (c.animates()) play(at, c);
  const std::pair<Events::Slot, Graph::Value> events[] = {{t::isActive.slot, Graph::value(true)},
                                                          {t::cycleTime.slot, Graph::value(0.0)}};
  std::vector<Graph::Part> parts;
  for (const auto& [slot, value] : events)
    if (animations_.events().any_from(n, slot))
      parts.push_back([this, n, slot, value](Graph::Flow to) { send_(std::move(to), n, slot, value); });
  graph_.in_turn(std::move(at), parts);
}

void Clocks::stop(Graph::Flow at, NodeId n) {
  const Clock& c = clock(n);
  at = graph_.branch(std::move(at), graph_.read(c.active)).yes;
  graph_.set(at, c.active, Graph::value(false));
  if (c.animates()) graph_.step(at, "animation/stop", {{"animation", c.animation}});
  send_(std::move(at), n, t::isActive.slot, Graph::value(false));
}

void Clocks::enable(Graph::Flow at, NodeId n, const Graph::Value& value) {
  const Clock& c = clock(n);
  graph_.set(at, *c.enabled, value);
  auto [yes, no] = graph_.branch(std::move(at), value);
  if (no) stop(std::move(no), n);
  if (!yes) return;
  if (auto repeats = graph_.branch(std::move(yes), loop(c)).yes) start(std::move(repeats), n);
}

/// A clock that is no longer to repeat goes on to the end of its cycle.
void Clocks::repeat(Graph::Flow at, NodeId n, const Graph::Value& value) {
  const Clock& c = clock(n);
  graph_.set(at, *c.loop, value);
  auto [yes, no] = graph_.branch(std::move(at), value);
  if (yes) start(std::move(yes), n);
  if (!no || !c.animates()) return;
  const std::string pointer = Graph::pointer_of(c.animation) + "/extensions/KHR_interactivity/virtualPlayhead";
  const auto cycle = Graph::value(c.cycle), place = graph_.property(pointer, Type::number);
  const auto rounds = graph_.compute("math/div", Type::number, {{"a", place}, {"b", cycle}});
  const auto whole = graph_.compute("math/ceil", Type::number, {{"a", rounds}});
  const auto last = graph_.compute("math/mul", Type::number, {{"a", whole}, {"b", cycle}});
  const auto node = graph_.step(no, "animation/stopAt", {{"animation", c.animation}, {"stopTime", last}});
  Graph::Flow done{node, "done"};
  if (!c.ticks) graph_.set(done, c.active, Graph::value(false));
}

void Clocks::tick(Graph::Flow at, NodeId n) {
  const Clock& c = clock(n);
  at = graph_.branch(std::move(at), graph_.read(c.active)).yes;
  const auto number = [&](std::string_view operation, const Graph::Value& a, const Graph::Value& b) {
    return graph_.compute(operation, Type::number, {{"a", a}, {"b", b}});
  };
  const auto passed = number("math/sub", now(), graph_.read(c.started));
  const auto rounds = number("math/div", passed, Graph::value(c.cycle));
  const auto repeats = loop(c);
  auto over = Graph::value(false);
  auto fraction = graph_.compute("math/fract", Type::number, {{"a", rounds}});
  if (!repeats.is(true)) {
    const auto late = graph_.compute("math/ge", Type::boolean, {{"a", rounds}, {"b", Graph::value(1.0)}});
    const auto once = graph_.compute("math/not", Type::boolean, {{"a", repeats}});
    over = graph_.compute("math/and", Type::boolean, {{"a", late}, {"b", once}});
    fraction =
        graph_.compute("math/select", Type::number, {{"condition", over}, {"a", Graph::value(1.0)}, {"b", fraction}});
  }
  std::vector<Graph::Part> parts;
  if (animations_.events().any_from(n, t::fraction_changed.slot))
    parts.push_back([&](Graph::Flow to) { send_(std::move(to), n, t::fraction_changed.slot, fraction); });
  if (animations_.events().any_from(n, t::cycleTime.slot))
    parts.push_back([&](Graph::Flow to) { next_round(std::move(to), c, rounds, over); });
  if (!over.is(false)) parts.push_back([&](Graph::Flow to) { end_cycle(std::move(to), c, over); });
  graph_.in_turn(std::move(at), parts);
}

void Clocks::end_cycle(Graph::Flow at, const Clock& c, const Graph::Value& over) {
  at = graph_.branch(std::move(at), over).yes;
  graph_.set(at, c.active, Graph::value(false));
  send_(std::move(at), c.node, t::isActive.slot, Graph::value(false));
}

void Clocks::next_round(Graph::Flow at, const Clock& c, const Graph::Value& rounds, const Graph::Value& over) {
  const auto whole = graph_.compute("math/floor", Type::number, {{"a", rounds}});
  const auto later = graph_.compute("math/gt", Type::boolean, {{"a", whole}, {"b", graph_.read(c.round)}});
  auto next = graph_.branch(graph_.branch(std::move(at), over).no, later).yes;
  graph_.set(next, c.round, whole);
  send_(std::move(next), c.node, t::cycleTime.slot, Graph::value(0.0));
}

}  // namespace wrlkit::gltf
