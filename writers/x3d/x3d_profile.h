// Which profile and components of X3D a scene needs.
#pragma once
#include <map>
#include <string>
#include <string_view>

#include "scenegraph/scene.h"

namespace wrlkit {

struct X3dProfile {
  std::string_view name;                   // Interchange or Immersive
  std::map<std::string_view, int> beyond;  // components that it lacks, or lacks on that level
};

/// By the component and level of each node type in the node table. O(nodes).
X3dProfile x3d_profile(const Scene&);

}  // namespace wrlkit
