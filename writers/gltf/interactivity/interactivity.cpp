#include "writers/gltf/interactivity/interactivity.h"

#include <algorithm>

#include "scenegraph/nodes.h"
#include "writers/gltf/interactivity/sensors.h"

namespace wrlkit::gltf {
namespace {

bool looks_at_the_camera(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::ProximitySensor) || scene.is(n, nodes::VisibilitySensor);
}

class Maker {
 public:
  Maker(const Scene& scene, const Document& document, const Animations& animations, Diagnostics& diag)
      : scene_(scene),
        events_(animations.events()),
        diag_(diag),
        tick_(add_tick()),
        cascade_(scene, document, animations, graph_, tick_ ? std::optional(tick_->node) : std::nullopt, diag),
        sensors_(scene, document, events_, graph_, cascade_) {}

  Graph make() {
    start();
    for (NodeId n : events_.sources()) {
      if (graph_.full()) break;
      if (scene_.is(n, nodes::TouchSensor)) sensors_.touch(n);
      if (scene_.is(n, nodes::Anchor)) sensors_.anchor(n);
      if (scene_.type(n).name == "Script") cascade_.script(n);
    }
    if (tick_) tick();
    cascade_.targets().report(diag_);
    cascade_.scripts().report(diag_);
    return std::move(graph_);
  }

 private:
  bool ticks(NodeId n) const {
    return looks_at_the_camera(scene_, n) || (scene_.is(n, nodes::TimeSensor) && Clocks::ticks(events_, n));
  }

  /// The time stands at this node, so that it comes before all others.
  std::optional<Graph::Event> add_tick() {
    if (std::ranges::none_of(events_.sources(), [&](NodeId n) { return ticks(n); })) return std::nullopt;
    return graph_.event("event/onTick");
  }

  /// Clocks that run when the world has been loaded.
  void start() {
    std::vector<Graph::Part> parts;
    for (NodeId n : events_.sources())
      if (scene_.is(n, nodes::TimeSensor) && Clocks::runs_at_first(scene_, n))
        parts.push_back([this, n](Graph::Flow to) { cascade_.clocks().start(std::move(to), n); });
    if (parts.empty()) return;
    cascade_.clocks().set_starting(true);
    graph_.in_turn(graph_.event("event/onStart").flow, parts);
    cascade_.clocks().set_starting(false);
  }

  void tick() {
    std::vector<Graph::Part> parts;
    for (NodeId n : events_.sources()) {
      if (!ticks(n)) continue;
      parts.push_back([this, n](Graph::Flow to) {
        if (scene_.is(n, nodes::TimeSensor)) return cascade_.clocks().tick(std::move(to), n);
        if (scene_.is(n, nodes::ProximitySensor)) return sensors_.proximity(std::move(to), n);
        sensors_.visibility(std::move(to), n);
      });
    }
    graph_.in_turn(tick_->flow, parts);
  }

  const Scene& scene_;
  const Events& events_;
  Diagnostics& diag_;
  Graph graph_;
  std::optional<Graph::Event> tick_;
  Cascade cascade_;
  Sensors sensors_;
};

}  // namespace

Graph make_interactivity(const Scene& scene, const Document& document, const Animations& animations,
                         Diagnostics& diag) {
  if (!animations.events().any()) return {};
  Graph graph = Maker(scene, document, animations, diag).make();
  if (graph.full()) diag.report(Diag::expansion_limit, {}, Graph::max_nodes, "nodes of KHR_interactivity");
  return graph;
}

}  // namespace wrlkit::gltf
