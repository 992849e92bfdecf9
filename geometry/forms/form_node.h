// Forms as geometry nodes: Box, Cone, Cylinder, Sphere and Extrusion where VRML97 has the form, or nodes of our own
// (scenegraph/nodes/wrlkit.nodes).
#pragma once
#include <optional>

#include "geometry/forms/form.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// The form that a geometry node is, in the frame of its Shape. None of other nodes, of Extrusions that are not a prism
/// along Y, of parts without their side, and where a size is not finite or leaves nothing.
std::optional<Form> read_form(const Scene& scene, NodeId geometry);

/// Whether only the outside of a geometry node is visible: true for nodes without that field.
bool is_solid(const Scene& scene, NodeId geometry);

/// Adds the node of a form; its frame goes into a Transform of the caller's (decompose).
NodeId add_form(Scene& scene, const Form& form, bool solid, Span where = {});

}  // namespace wrlkit
