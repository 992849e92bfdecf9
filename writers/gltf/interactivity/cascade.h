// Event cascades (ISO/IEC 14772-1, 4.10): what follows from one event, along its ROUTEs, to what it changes. Each way
// is written out; a ROUTE is followed once in a cascade, as 4.10.4 has it.
#pragma once
#include <map>
#include <vector>

#include "writers/gltf/interactivity/clocks.h"
#include "writers/gltf/interactivity/scripts.h"
#include "writers/gltf/interactivity/targets.h"

namespace wrlkit::gltf {

class Cascade {
 public:
  static constexpr std::size_t max_length = 256;      // ROUTEs behind one another
  static constexpr std::size_t max_keys = 256;        // of a sequencer
  static constexpr std::size_t max_hops = 1'000'000;  // ROUTEs looked at: most ways add no node

  Cascade(const Scene&, const Document&, const Animations&, Graph&, std::optional<std::uint32_t> tick, Diagnostics&);

  /// Adds what follows from an event of a node.
  void send(Graph::Flow, NodeId, Events::Slot, const Graph::Value&);
  Clocks& clocks() { return clocks_; }
  Targets& targets() { return targets_; }
  const Scripts& scripts() const { return scripts_; }
  /// Adds what follows from the events that a Script sends.
  void script(NodeId);
  /// Whether a sensor listens.
  Graph::Value listens(NodeId sensor);

 private:
  /// Counts a ROUTE; reports the first one beyond the limit.
  bool one_too_many(NodeId from);
  void receive(Graph::Flow, const Events::Hop&, const Graph::Value&);
  void utility(Graph::Flow, const Events::Hop&, const Graph::Value&);
  void direct_output(NodeId script, Events::Slot field);
  void listen(Graph::Flow, NodeId sensor, const Graph::Value&);
  void filter(Graph::Flow, NodeId, const Graph::Value&);
  void toggle(Graph::Flow, NodeId);
  void set_toggle(Graph::Flow, NodeId, const Graph::Value&);
  void at_fraction(Graph::Flow, NodeId, const Graph::Value&);
  void step_key(Graph::Flow, NodeId, int by);
  void send_key(Graph::Flow, NodeId, const Graph::Value& index);
  Graph::Variable key_index(NodeId sequencer);
  std::size_t n_keys(NodeId sequencer);
  Graph::Value key_value(NodeId sequencer, std::size_t);
  /// What a node remembers.
  Graph::Variable memory(NodeId, const Graph::Value& initial);

  const Scene& scene_;
  const Events& events_;
  Graph& graph_;
  Diagnostics& diag_;
  Targets targets_;
  Scripts scripts_;
  Clocks clocks_;
  std::map<std::uint32_t, Graph::Variable> memory_;
  std::vector<const Route*> path_;
  std::size_t n_hops_ = 0;
  std::set<std::uint32_t> told_;
};

}  // namespace wrlkit::gltf
