// Where the Shapes of a scene are. A Shape has as many places as it has uses.
#pragma once
#include <functional>

#include "scenegraph/places/ways.h"
#include "scenegraph/transform.h"

namespace wrlkit {

enum class Shown : bool { all, now };  // every child of Switch and LOD, or the chosen and the first

/// Calls f(Shape, matrix from it to the world) for each place, in the order of the file; in prototypes too, as their
/// bodies are. False when there were more ways than may be followed (most_visits), the rest of which were left out.
bool for_each_place(const Scene& scene, Shown shown, const std::function<void(NodeId, const Matrix&)>& f);

/// The largest factor by which lengths grow, for matrices without shear.
double scale_of(const Matrix& m);

}  // namespace wrlkit
