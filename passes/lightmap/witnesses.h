// Who would see the inner side of a closed surface, or light it: a viewer who stands in there, a lamp, something that shines.
#pragma once
#include <vector>

#include "passes/light/world.h"

namespace wrlkit::bake {

class Witnesses {
 public:
  /// Viewpoints, PointLights and SpotLights, and the middles of emitters. n log n.
  Witnesses(const Scene& scene, const light::LightWorld& world);

  /// Whether any of them stands within the box; those that belong to `use` do not count.
  bool within(const drawing::Box& box, std::uint32_t use) const;

 private:
  struct Witness {
    drawing::V3 at;
    std::uint32_t use;
  };
  std::vector<Witness> all_;         // by x
};

}  // namespace wrlkit::bake
