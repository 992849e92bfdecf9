// What events change in a file: which child of a Switch is shown, where a Transform is, whether a light is on. What the
// viewer has to do itself, because no object of glTF is changed by it, is sent to it as an event: "viewpoint:NAME"
// with the name of the camera's node, "open:URL" for Anchors, "sound:4:startTime" where 4 is the node of the file that
// keeps the Sound in its extras (now, without a value; loop, pitch and intensity with theirs).
#pragma once
#include "writers/gltf/animations.h"
#include "writers/gltf/document/document.h"
#include "writers/gltf/interactivity/graph.h"

namespace wrlkit::gltf {

class Targets {
 public:
  Targets(const Scene&, const Document&, const Animations&, Graph&);

  void choose(Graph::Flow, NodeId switch_node, const Graph::Value& choice);
  void move(Graph::Flow, NodeId transform, std::uint16_t slot, const Graph::Value&);
  void shine(Graph::Flow, NodeId light, const Graph::Value& on);
  void bind(Graph::Flow, NodeId viewpoint, const Graph::Value& bound);
  void open(Graph::Flow, NodeId anchor);
  /// A field of a Sound, or of its AudioClip.
  void sound(Graph::Flow, NodeId, std::uint16_t slot, const Graph::Value&);
  /// Names what is only sent to the viewer, the first of each kind.
  void report(Diagnostics&) const;

 private:
  struct Sent {
    NodeId first;
    std::string_view field;
    std::string event;
  };
  void send(Graph::Flow&, NodeId from, std::string_view field, const std::string& event,
            std::optional<Graph::Value> = {});

  const Scene& scene_;
  const Document& document_;
  const Animations& animations_;
  Graph& graph_;
  std::vector<std::string_view> choice_;                        // properties of nodes by which a Switch chooses
  std::map<std::uint32_t, std::vector<std::uint32_t>> chosen_;  // children of Switches, by Switch
  std::map<std::uint32_t, std::vector<std::size_t>> lights_;    // of the document, by node
  std::map<std::uint32_t, std::vector<std::uint32_t>> sounds_;  // nodes of Sounds, by these and their AudioClips
  std::map<std::string_view, Sent> sent_;                       // by type
};

}  // namespace wrlkit::gltf
