// What holds a node and what touches it: what a pass may merge, move or remove without visible effect.
#pragma once
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit {

class Usage {
 public:
  /// Covers all scopes. O(nodes).
  explicit Usage(const Scene& scene);

  /// An end of a ROUTE, exported, held by a Script or by an instance of a prototype, or below one that a Script with
  /// directOutput holds: events may come here that this file does not show.
  bool touched(NodeId n) const { return touched_[n.value]; }
  /// Held in one place, as a child, in a field or at the top of a scope.
  bool once(NodeId n) const { return uses_[n.value] == 1; }
  std::uint32_t uses(NodeId n) const { return uses_[n.value]; }

 private:
  void add(const Scope&);

  std::vector<std::uint32_t> uses_;
  std::vector<char> touched_;
};

/// True of a type that is built in, with known fields only, and nothing that events or prototypes may change.
bool is_plain(const Scene& scene, const Usage& usage, NodeId n);

/// True unless a group only puts things together: something in it or of it goes for what is below, and for nothing
/// else.
bool holds_together(const Scene& scene, const Usage& usage, NodeId group);

}  // namespace wrlkit
