// LOD nodes over whole groups, or the whole scene: their further levels are the group with simpler surfaces.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/choice.h"
#include "base/math/box.h"
#include "geometry/simplify/lod_nodes.h"

namespace wrlkit {

enum class LodScope : std::uint8_t { part, group, world };
template <>
inline constexpr auto choices<LodScope> =
    choice_row({{"part", "each Shape"},
                {"group", "the innermost groups that hold several Shapes, and other Shapes by themselves"},
                {"world", "one LOD for all that is drawn"}});

/// A surface at one of the levels.
struct SurfaceLevel {
  NodeId geometry;   // none: it has left
  double error = 0;  // in its own units
  std::size_t n_faces = 0;
};

/// A surface, and what stands for it at each level. The first is the surface itself; all have as many.
struct LeveledSurface {
  ShapeSurface surface;
  Box bounds;
  std::vector<SurfaceLevel> levels;
};

struct ScopedLodOptions {
  LodScope scope = LodScope::group;  // or world
  ScreenBudget budget{};
  double min_saving = 0;        // share of the triangles of the level before that a level has to save
  std::uint64_t min_faces = 0;  // triangles of a group below which it stays as it is
};

struct ScopedLods {
  std::size_t n_lods = 0, n_levels = 0, n_too_small = 0;
};

/// Puts LODs around groups, with the group as it is as the first level. Further levels are copies, without names, of
/// what differs in them; the rest is shared with the first, but for nodes that are bound (Viewpoint), which the first
/// alone has. A node that a ROUTE reaches, and a LOD, is not copied: what lies below it has LODs of its own, or stays
/// as it is where there is one for the world. O(nodes * levels).
ScopedLods add_scoped_lods(Scene& scene, std::span<const LeveledSurface> surfaces, const ScopedLodOptions& options);

}  // namespace wrlkit
