#include "writers/gltf/interactivity/clocks.h"

#include "scenegraph/nodes.h"

namespace wrlkit::gltf {
namespace {

namespace t = nodes::time_sensor;
constexpr double far_future = 4'102'444'800;  // 2100: a clock that starts there waits for an event
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
  return scene.get(n, t::enabled) && scene.get(n, t::loop) && start < far_future && !(stop > start);
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
  const bool stopped = scene_.get(n, t::stopTime) > scene_.get(n, t::startTime);
  if (events.sets(n, t::stopTime.slot) || (stopped && events.sets(n, t::startTime.slot)))
    c.stopped = graph_.variable(Graph::value(stopped));
  return c;
}

Graph::Value Clocks::enabled(const Clock& c) {
  return c.enabled ? graph_.read(*c.enabled) : Graph::value(scene_.get(c.node, t::enabled));
}

Graph::Value Clocks::loop(const Clock& c) {
  return c.loop ? graph_.read(*c.loop) : Graph::value(scene_.get(c.node, t::loop));
}

Graph::Value Clocks::stopped(const Clock& c) {
  return c.stopped ? graph_.read(*c.stopped)
                   : Graph::value(scene_.get(c.node, t::stopTime) > scene_.get(c.node, t::startTime));
}

Graph::Value Clocks::now() { return {Type::number, {}, *tick_, "timeSinceStart"}; }

/// Where its animation ends.
Graph::Value Clocks::end(const Clock& c) {
  const auto repeats = loop(c);
  auto once = Graph::value(c.cycle);
  if (repeats.is(false)) return once;
  auto never = graph_.compute("math/Inf", Type::number, {});
  if (repeats.is(true)) return never;
  return graph_.compute("math/select", Type::number, {{"condition", repeats}, {"a", never}, {"b", once}});
}

void Clocks::play(Graph::Flow& at, const Clock& c) {
  const auto node = graph_.step(at, "animation/start",
                                {{"animation", c.animation},
                                 {"startTime", Graph::value(0.0)},
                                 {"endTime", c.loop ? graph_.compute("math/Inf", Type::number, {}) : end(c)},
                                 {"speed", Graph::value(1.0)}});
  // What the animation began with cannot be changed while it runs, but where it is to stop.
  if (c.loop) return stop_at(at, c, end(c));
  Graph::Flow done{node, "done"};
  if (!c.ticks) graph_.set(done, c.active, Graph::value(false));
}

void Clocks::stop_at(Graph::Flow& at, const Clock& c, const Graph::Value& time) {
  const auto node = graph_.step(at, "animation/stopAt", {{"animation", c.animation}, {"stopTime", time}});
  Graph::Flow done{node, "done"};
  if (!c.ticks) graph_.set(done, c.active, Graph::value(false));
}

void Clocks::start(Graph::Flow at, NodeId n) {
  const Clock& c = clock(n);
  if (c.stopped) graph_.set(at, *c.stopped, Graph::value(false));
  begin(std::move(at), c);
}

void Clocks::begin(Graph::Flow at, const Clock& c) {
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
    if (animations_.events().any_from(c.node, slot))
      parts.push_back(
          [this, &c, slot = slot, value = value](Graph::Flow to) { send_(std::move(to), c.node, slot, value); });
  graph_.in_turn(std::move(at), parts);
}

void Clocks::stop(Graph::Flow at, NodeId n) {
  const Clock& c = clock(n);
  if (c.stopped) graph_.set(at, *c.stopped, Graph::value(true));
  halt(std::move(at), c);
}

void Clocks::halt(Graph::Flow at, const Clock& c) {
  at = graph_.branch(std::move(at), graph_.read(c.active)).yes;
  graph_.set(at, c.active, Graph::value(false));
  if (c.animates()) graph_.step(at, "animation/stop", {{"animation", c.animation}});
  send_(std::move(at), c.node, t::isActive.slot, Graph::value(false));
}

void Clocks::enable(Graph::Flow at, NodeId n, const Graph::Value& value) {
  const Clock& c = clock(n);
  graph_.set(at, *c.enabled, value);
  auto [yes, no] = graph_.branch(std::move(at), value);
  if (no) halt(std::move(no), c);
  if (!yes) return;
  auto repeats = graph_.branch(std::move(yes), loop(c)).yes;
  if (repeats) begin(graph_.branch(std::move(repeats), stopped(c)).no, c);
}

void Clocks::repeat(Graph::Flow at, NodeId n, const Graph::Value& value) {
  const Clock& c = clock(n);
  graph_.set(at, *c.loop, value);
  std::vector<Graph::Part> parts;
  if (c.animates()) parts.push_back([&](Graph::Flow to) { change_end(std::move(to), c, value); });
  if (!value.is(false))
    parts.push_back([&](Graph::Flow to) {
      auto yes = graph_.branch(std::move(to), value).yes;
      if (yes) begin(graph_.branch(std::move(yes), stopped(c)).no, c);
    });
  graph_.in_turn(std::move(at), parts);
}

/// A clock that is no longer to repeat ends with its cycle; one that is to repeat again does not stop there.
void Clocks::change_end(Graph::Flow at, const Clock& c, const Graph::Value& repeats) {
  at = graph_.branch(std::move(at), graph_.read(c.active)).yes;
  if (!at) return;
  const auto number = [&](std::string_view operation, Graph::Inputs inputs) {
    return graph_.compute(operation, Type::number, std::move(inputs));
  };
  const auto never = number("math/Inf", {});
  if (repeats.is(true)) return stop_at(at, c, never);
  const std::string pointer = Graph::pointer_of(c.animation) + "/extensions/KHR_interactivity/virtualPlayhead";
  const auto cycle = Graph::value(c.cycle), place = graph_.property(pointer, Type::number);
  const auto begun = number("math/ceil", {{"a", number("math/div", {{"a", place}, {"b", cycle}})}});
  const auto whole = number("math/max", {{"a", begun}, {"b", Graph::value(1.0)}});
  const auto last = number("math/mul", {{"a", whole}, {"b", cycle}});
  if (repeats.is(false)) return stop_at(at, c, last);
  stop_at(at, c, number("math/select", {{"condition", repeats}, {"a", never}, {"b", last}}));
}

void Clocks::tick(Graph::Flow at, NodeId n) {
  const Clock& c = clock(n);
  at = graph_.branch(std::move(at), graph_.read(c.active)).yes;
  const auto number = [&](std::string_view operation, Graph::Inputs inputs) {
    return graph_.compute(operation, Type::number, std::move(inputs));
  };
  const auto passed = number("math/sub", {{"a", now()}, {"b", graph_.read(c.started)}});
  const auto rounds = number("math/div", {{"a", passed}, {"b", Graph::value(c.cycle)}});
  const auto repeats = loop(c);
  auto over = Graph::value(false);
  auto fraction = number("math/fract", {{"a", rounds}});
  if (!repeats.is(true)) {
    // Where loop changes, the cycle at hand is the one of the last tick.
    const auto whole = c.loop ? number("math/floor", {{"a", rounds}}) : rounds;
    const auto late = c.loop ? graph_.compute("math/gt", Type::boolean, {{"a", whole}, {"b", graph_.read(c.round)}})
                             : graph_.compute("math/ge", Type::boolean, {{"a", rounds}, {"b", Graph::value(1.0)}});
    const auto once = graph_.compute("math/not", Type::boolean, {{"a", repeats}});
    over = graph_.compute("math/and", Type::boolean, {{"a", late}, {"b", once}});
    fraction = number("math/select", {{"condition", over}, {"a", Graph::value(1.0)}, {"b", fraction}});
  }
  std::vector<Graph::Part> parts;
  if (animations_.events().any_from(n, t::fraction_changed.slot))
    parts.push_back([&](Graph::Flow to) { send_(std::move(to), n, t::fraction_changed.slot, fraction); });
  if (c.loop || animations_.events().any_from(n, t::cycleTime.slot))
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
