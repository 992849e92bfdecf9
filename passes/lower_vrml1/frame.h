// A group under construction: what it draws, where, and which lights begin to shine in between.
#pragma once
#include <vector>

#include "passes/lower_vrml1/placement.h"

namespace wrlkit::vrml1 {

struct Frame {
  /// Nodes one after the other at one place.
  struct Run {
    Placement at;
    std::vector<NodeId> nodes;
    bool lights_rest = false;  // begins with a DirectionalLight that does not reach what is before it
  };
  struct Light {
    NodeId source;
    Matrix at;
  };

  Placement at;  // of what comes next, since the group began
  std::vector<Run> runs;
  std::vector<Light> lights;  // DirectionalLights that shine on, if the group does not end the state
  bool drawn = false;         // something that light falls on is in it

  void add(NodeId n) {
    if (runs.empty() || !(runs.back().at == at)) runs.push_back({at, {}, false});
    runs.back().nodes.push_back(n);
    drawn = true;
  }
  /// A DirectionalLight in the axes of the group: below a Transform it would light only that.
  void add_light(NodeId n) { runs.push_back({{}, {n}, drawn}); }
};

/// The contents of a frame as children of a group.
std::vector<NodeId> children(Scene&, const Frame&);
/// The frame as one node: a Transform when everything is at one place, otherwise a Group. None when it is empty.
NodeId group(Scene&, const Frame&, Span where, std::string_view name);
/// Nodes at a place: below a Transform, or as they are.
NodeId placed(Scene&, const Placement&, const std::vector<NodeId>& nodes, Span where);

}  // namespace wrlkit::vrml1
