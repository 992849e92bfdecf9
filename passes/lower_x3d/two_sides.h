// Surfaces that look otherwise from behind.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// Whether a TwoSidedMaterial has another back than front.
bool back_differs(const Scene&, NodeId two_sided_material);

/// A Shape of faces that are seen from both sides, with a TwoSidedMaterial or an Appearance.backMaterial, becomes two
/// Shapes, one for each side; they share the points. False: the node is another one, or events change it.
bool split_sides(Scene&, NodeId, const std::vector<char>& driven);

/// By node: whether a ROUTE begins or ends there.
std::vector<char> routed_nodes(const Scene&);

}  // namespace wrlkit::x3d
