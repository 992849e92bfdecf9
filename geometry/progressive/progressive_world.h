// A scene for a viewer that shows it while it comes in (docs/progressive.md): for each surface where it stands and in
// what color, then the progressive meshes of all surfaces, cut in pieces that take turns, so that the whole scene gets
// better at once.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh_job.h"
#include "geometry/progressive/progressive_stream.h"
#include "scenegraph/transform.h"

namespace wrlkit {

/// One of the places of a surface.
struct ProgressivePlace {
  std::string name;  // of the Shape; empty when it has none
  Matrix matrix;     // from the surface to the world
  std::array<std::uint8_t, 4>
      color;  // red, green, blue as in VRML, and opacity: the Material's diffuse and emissive color
};

struct ProgressiveSurface {
  std::vector<ProgressivePlace> places;
  ProgressiveStream stream;
};

/// For what is shown of a scene without prototypes and Inlines: the chosen children of Switch, the first levels of LOD.
/// Left out are lines and points. The meshes are in memory all together. `criterion` is one that keeps a record.
std::vector<ProgressiveSurface> progressive_surfaces(const Scene& scene, Criterion criterion, Task& ctx);

/// Pieces of larger error, as it is in the world, come first; each surface's in their order.
std::string write_progressive_world(std::span<const ProgressiveSurface> surfaces);

struct ProgressiveWorldRead {
  std::vector<ProgressiveSurface> surfaces;  // with the bytes of their streams as far as there are any; without cuts
  std::string error;                         // empty when the bytes are good, or good as far as they go
};

/// Any bytes may come in, as for read_progressive.
ProgressiveWorldRead read_progressive_world(std::string_view bytes);

}  // namespace wrlkit
