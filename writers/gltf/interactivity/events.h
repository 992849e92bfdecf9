// What the ROUTEs of a scene do when something happens; what Scripts do is the viewer's (scripts.h). From sensors and
// clocks through the nodes of X3D's component EventUtilities to fields of other nodes. KHR_interactivity can say what
// is in the tables of events.cpp; everything else stays in extras and is reported, each kind once.
//
// A ROUTE counts when its event can happen and leads to something: a BooleanFilter that nothing listens to is left out,
// and so is a TimeSensor that only drives a Script. A Script with directOutput counts as one with a ROUTE to each field
// of the nodes that it holds: "ball.translation" is what it sets as the translation of the node in its field `ball`.
#pragma once
#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <string>

#include "base/diagnostics.h"
#include "scenegraph/scene.h"
#include "writers/gltf/motion.h"

namespace wrlkit::gltf {

/// What a node does with an event that comes in.
enum class Act : std::uint8_t {
  start,        // TimeSensor.startTime
  stop,         // TimeSensor.stopTime
  run_or_halt,  // TimeSensor.enabled
  repeat,       // TimeSensor.loop
  choose,       // Switch.whichChoice
  move,         // translation, rotation, scale of a Transform
  shine,        // on of a light
  bind,         // Viewpoint.set_bind
  sound,        // startTime, stopTime, loop and pitch of an AudioClip, intensity of a Sound
  listen,       // enabled of other sensors
  filter,
  toggle,
  set_toggle,
  trigger_true,
  trigger_integer,
  trigger_time,
  at_fraction,  // of a sequencer
  next,
  previous,
  tell_script
};

class Events {
 public:
  using Slot = std::uint16_t;
  struct Hop {
    const Route* route;
    NodeId to;
    Slot slot;
    Act act;
  };

  /// None without `on`. `motion`: which clocks have animations.
  Events(const Scene&, const Motion&, bool on);

  /// The ROUTEs that lead on from there, in the order of the file.
  std::span<const Hop> from(NodeId, Slot) const;
  bool any_from(NodeId n, Slot s) const { return !from(n, s).empty(); }
  /// Does an event reach that field?
  bool sets(NodeId n, Slot s) const { return set_.contains({n.value, s}); }
  bool sets(NodeId n, std::string_view field) const;
  bool says(const Route& r) const { return said_.contains(&r); }
  const std::set<const Route*>& said() const { return said_; }
  /// Sensors, clocks and Anchors that begin something, in the order of their ids.
  const std::vector<NodeId>& sources() const { return sources_; }
  bool begins(NodeId n) const { return std::ranges::binary_search(sources_, n.value, {}, &NodeId::value); }
  /// Are there any that a file has to have a graph for? Also when only clocks run.
  bool any() const { return !sources_.empty(); }
  /// What is lost, by kind, with the place of the first of each.
  void report(const Scene&, const Motion&, Diagnostics&) const;

 private:
  using Key = std::pair<std::uint32_t, Slot>;
  void add_routes();
  void add_direct_output(NodeId script);
  void add_direct_output(NodeId script, Slot field, NodeId held, const std::string& name);
  void add(const Route&, Slot out, Slot in);
  void find_useful(const Motion&);
  void collect();
  void spread(NodeId);
  bool is_of_scene(const Route&) const;

  const Scene& scene_;
  bool on_;
  struct Possible {
    Slot out;
    Hop hop;
  };
  std::deque<Route> direct_;  // as if there were such ROUTEs
  std::deque<std::string> names_;
  std::multimap<std::uint32_t, Possible> possible_;  // by the node that sends, in the order of the file
  std::set<std::uint32_t> useful_;
  std::map<Key, std::vector<Hop>> hops_;
  std::set<Key> set_;
  std::set<const Route*> said_, said_directly_;
  std::vector<NodeId> sources_;
};

}  // namespace wrlkit::gltf
