// Sensors as events of KHR_interactivity and its companions. A TouchSensor listens at the node that holds it: a click
// (event/onSelect of KHR_node_selectability) is isActive TRUE and FALSE, then touchTime; isOver is event/onHoverIn and
// event/onHoverOut (KHR_node_hoverability). Environmental sensors look at the active camera at every tick: is it in the
// box; is the ball about the box in its view.
#pragma once
#include "writers/gltf/interactivity/cascade.h"

namespace wrlkit::gltf {

class Sensors {
 public:
  Sensors(const Scene&, const Document&, const Events&, Graph&, Cascade&);

  void touch(NodeId sensor);
  void anchor(NodeId);
  void proximity(Graph::Flow tick, NodeId sensor);
  void visibility(Graph::Flow tick, NodeId sensor);

 private:
  /// The nodes of glTF that show what a sensor is about.
  std::vector<std::uint32_t> held_by(NodeId sensor) const;
  std::vector<std::uint32_t> nodes_of(NodeId) const;
  Matrix frame(NodeId sensor) const;
  Graph::Flow any_event(std::string_view operation, std::span<const std::uint32_t> nodes,
                        const Graph::Value& enabled = Graph::value(true));
  struct Says {
    Events::Slot active, enter, leave;
  };
  void when_changed(Graph::Flow, NodeId sensor, const Graph::Value& state, const Says&);
  Graph::Value number(std::string_view operation, const Graph::Value& a, const Graph::Value& b);
  void follow(Graph::Flow, NodeId sensor, const Graph::Value& state, const std::array<Graph::Value, 3>& place);

  const Scene& scene_;
  const Document& document_;
  const Events& events_;
  Graph& graph_;
  Cascade& cascade_;
  Family family_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_source_;
  std::vector<char> shows_;  // a mesh, or holds what does
};

}  // namespace wrlkit::gltf
