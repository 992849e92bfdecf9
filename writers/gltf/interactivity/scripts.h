// Scripts. A graph of KHR_interactivity cannot run them, so the viewer is told of the events that come in and tells of
// those that go out, by custom events with a value: "to-script:4:press" and "from-script:4:choice", where 4 is the node
// of the file that keeps the Script in its extras; "from-script:4:ball.translation" for a node in its field `ball`. The
// viewer page runs them (viewer/src/behaviour/scripts.ts).
#pragma once
#include <map>

#include "writers/gltf/document/document.h"
#include "writers/gltf/interactivity/graph.h"

namespace wrlkit::gltf {

bool is_script(const Scene&, NodeId);
/// Those that every Script has; fields of its own come behind them.
std::size_t n_common_script_fields();
/// Is that a field of a Script's own, of a type that a graph can carry?
bool is_script_event(const Scene&, NodeId, std::uint16_t slot);

class Scripts {
 public:
  Scripts(const Scene&, const Document&, Graph&);

  /// Tells the viewer of an event for the Script. Nothing where the file does not keep it.
  void tell(Graph::Flow, NodeId script, std::uint16_t slot, const Graph::Value&);
  /// What follows when the viewer says that the Script has sent that event; no flow where the file does not keep it.
  struct Told {
    Graph::Flow flow;
    Graph::Value value;
  };
  Told told(NodeId script, std::uint16_t slot);
  /// The same of what it sets in a node that it holds, by a name such as "ball.translation".
  Told told(NodeId script, std::string_view name, FieldType);
  /// Names the first event of a Script.
  void report(Diagnostics&) const;

 private:
  std::optional<std::uint32_t> event(std::string_view way, NodeId script, std::string_view name, FieldType);

  const Scene& scene_;
  Graph& graph_;
  std::map<std::uint32_t, std::uint32_t> nodes_;  // of the file, by Script
  NodeId first_{};
  std::string first_event_;
};

}  // namespace wrlkit::gltf
