// ROUTEs, IMPORTs and EXPORTs of nodes that are not in the scene any more.
#pragma once
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit {

struct DanglingLinks {
  std::vector<Route> routes;
  bool any = false;  // IMPORTs and EXPORTs count, too
};

/// Removes those of the main scope, and returns them. O(nodes + links); O(1) where there are no links.
DanglingLinks drop_dangling_links(Scene&);

}  // namespace wrlkit
