// Where in the world the Shapes of a scene stand. A Shape stands in as many places as it is used.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "geometry/simplify/surfaces.h"
#include "scenegraph/transform.h"

namespace wrlkit {

constexpr std::size_t most_visits = 4'000'000;  // of nodes, when every USE is followed

enum class Shown : bool { all, now };  // every child of Switch and LOD, or the chosen and the first

/// Calls f(Shape, matrix from it to the world) for each place, in the order of the file; in prototypes too, as their
/// bodies are. False when there were more than most_visits, the rest of which were left out.
bool for_each_place(const Scene& scene, Shown shown, const std::function<void(NodeId, const Matrix&)>& f);

/// The largest factor by which lengths grow, for matrices without shear.
double scale_of(const Matrix& m);

/// Of each surface the largest over its places: metres of the world for a unit of the geometry. 1 where it stands
/// nowhere, or is scaled to nothing.
std::vector<double> largest_scales(const Scene& scene, std::span<const ShapeSurface> surfaces);

/// By Shape: the number of its surface among these, from 1; 0: of none.
std::vector<std::uint32_t> surface_numbers(const Scene& scene, std::span<const ShapeSurface> surfaces);

}  // namespace wrlkit
