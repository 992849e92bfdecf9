// Which triangle of the world each patch of a file lies on: by the file's own grouping where that is right, else by
// looking for a surface where the patch is. So files of other programs, of a scene that was changed since, or without
// any grouping serve as well.
#pragma once
#include <array>
#include <vector>

#include "light/world.h"
#include "scenegraph/patches.h"

namespace wrlkit::light {

/// A patch and where it lies.
struct PlacedPatch {
  std::uint32_t patch;         // into PatchSet::patches
  std::uint32_t use, element;  // of the world
  bool back;                   // it lies on the back of the triangle
};

struct PatchMatch {
  std::vector<PlacedPatch> placed;  // by use, then in the order of the file
  std::size_t n_orphans = 0;        // patches that lie on no surface, or have no area
};

/// Coordinates may be off by a thousandth of a patch and two millionths of the world, and by what the digits of the
/// file have rounded, up to half an edge. O(patches), and a ray for each that its triangle does not tell the place of.
PatchMatch match_patches(const PatchSet& set, const LightWorld& world);

/// The corners of a triangle of the world, in its own order.
std::array<V3, 3> triangle_of(const LightWorld& world, std::uint32_t use, std::uint32_t element);

/// What a patch on a triangle reflects and emits: means over it.
struct PatchColor {
  V3 albedo, emission;
};
PatchColor color_of(const LightWorld& world, std::uint32_t use, std::uint32_t element, bool back,
                    const std::array<V3, 3>& patch);

/// The weights of the corners of a triangle at a place in its plane.
std::array<double, 3> weights_in(const std::array<V3, 3>& triangle, const V3& place);

}  // namespace wrlkit::light
