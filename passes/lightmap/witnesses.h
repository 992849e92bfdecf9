// Who would see the inner side of a closed surface, or light it: a viewer who is in there, a lamp, something that
// shines; and what is in there as in a room.
#pragma once
#include <vector>

#include "light/world.h"

namespace wrlkit::bake {

class Witnesses {
 public:
  /// Viewpoints, PointLights and SpotLights, the middles of emitters, and the boxes of all that is drawn. n log n. The
  /// world must live on.
  Witnesses(const Scene& scene, const light::LightWorld& world);

  /// Whether any of them stands within the box; those that belong to `use` do not count.
  bool within(const Box& box, std::uint32_t use) const;
  /// Whether the box holds the whole box of another use.
  bool holds_another(const Box& box, std::uint32_t use) const;

 private:
  struct Witness {
    drawing::V3 at;
    std::uint32_t use;
  };
  struct Thing {
    Box box;
    std::uint32_t use;
  };
  std::vector<Witness> all_;   // by x
  std::vector<Thing> things_;  // by the lowest x
};

}  // namespace wrlkit::bake
