// What the Switches of all standards show: that of VRML97 and X3D, and that of VRML 1.0.
#pragma once
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit {

bool is_switch(const Scene&, NodeId);
/// All children of a Switch, in order.
std::vector<NodeId> switch_children(const Scene&, NodeId);
/// Those that it shows, as its field says: in VRML 1.0, -3 stands for all of them, and -2, of Inventor, for what the
/// Switch around it shows, which may be any of them; no child has the number: none.
std::vector<NodeId> shown_of_switch(const Scene&, NodeId);
/// Whether it is a Switch that shows nothing.
bool is_switched_off(const Scene&, NodeId);

}  // namespace wrlkit
