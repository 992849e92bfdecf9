// Scenes that passes have left without anything to draw: a weld by metres of what is in millimetres, a cull of all.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Remembers whether there was certainly something to draw; reports where afterwards there is certainly nothing.
/// Prototypes, Inlines and nodes that are not known are neither. Faces without area draw nothing.
class EmptiedScene {
 public:
  /// Until there is something: O(nodes + faces without area).
  explicit EmptiedScene(const Scene&);

  /// The same.
  void report(const Scene&, Diagnostics&) const;

 private:
  bool had_any_;
};

}  // namespace wrlkit
