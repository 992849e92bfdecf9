// TimeSensors (ISO/IEC 14772-1, 6.50 and 4.6.9). What a clock moves is an animation of the file, which the graph starts
// and stops. A clock whose other events lead somewhere is counted at every tick as well. An event that is a time means
// now: without Scripts no other time reaches a clock.
#pragma once
#include <functional>
#include <map>
#include <optional>

#include "writers/gltf/animations.h"
#include "writers/gltf/interactivity/graph.h"

namespace wrlkit::gltf {

class Clocks {
 public:
  /// Goes on with what an event of a node leads to.
  using Send = std::function<void(Graph::Flow, NodeId, Events::Slot, const Graph::Value&)>;
  /// `tick`: the node event/onTick, which must be there when a clock ticks.
  Clocks(const Scene&, const Animations&, Graph&, std::optional<std::uint32_t> tick, Send);

  /// Do its events lead to more than animations?
  static bool ticks(const Events&, NodeId clock);
  /// Is it running when the world has been loaded?
  static bool runs_at_first(const Scene&, NodeId clock);

  /// What follows is at the start, when no tick has told the time.
  void set_starting(bool starting) { starting_ = starting; }
  /// Its startTime comes.
  void start(Graph::Flow, NodeId clock);
  void stop(Graph::Flow, NodeId clock);
  void enable(Graph::Flow, NodeId clock, const Graph::Value&);
  void repeat(Graph::Flow, NodeId clock, const Graph::Value&);
  /// What it does at each tick.
  void tick(Graph::Flow, NodeId clock);

 private:
  struct Clock {
    NodeId node;
    Graph::Value animation{};  // none: there is none
    double cycle = 1;
    bool ticks = false;
    Graph::Variable active{}, started{}, round{};
    std::optional<Graph::Variable> enabled{}, loop{}, stopped{};  // where events set them

    bool animates() const { return !animation.constant.empty(); }
  };
  Clock& clock(NodeId);
  Graph::Value enabled(const Clock&);
  Graph::Value loop(const Clock&);
  /// Is its stopTime later than its startTime?
  Graph::Value stopped(const Clock&);
  Graph::Value now();
  Graph::Value end(const Clock&);
  void begin(Graph::Flow, const Clock&);
  void halt(Graph::Flow, const Clock&);
  void play(Graph::Flow&, const Clock&);
  void stop_at(Graph::Flow&, const Clock&, const Graph::Value& time);
  void change_end(Graph::Flow, const Clock&, const Graph::Value& repeats);
  void end_cycle(Graph::Flow, const Clock&, const Graph::Value& over);
  void next_round(Graph::Flow, const Clock&, const Graph::Value& rounds, const Graph::Value& over);

  const Scene& scene_;
  const Animations& animations_;
  Graph& graph_;
  std::optional<std::uint32_t> tick_;
  Send send_;
  std::map<std::uint32_t, Clock> clocks_;
  bool starting_ = false;
};

}  // namespace wrlkit::gltf
