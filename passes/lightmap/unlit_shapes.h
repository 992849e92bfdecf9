// Shapes that VRML calls unlit, as they have no Material, though they are surfaces: walls and furniture that show a
// picture.
#pragma once
#include <cstddef>
#include <string_view>
#include <vector>

#include "light/world.h"
#include "passes/lightmap/parts.h"

namespace wrlkit::bake {

/// Which of them get light. In a scene with lamps they have it as what they are for reflected light anyway: surfaces
/// whose albedo is their picture or colour. Never those that shine by themselves (UnlitMaterial; in glTF all, by
/// KHR_materials_unlit), that show films or what events change, or that hang before the viewer: below a Billboard that
/// faces the screen, or a Transform that a ProximitySensor moves.
class UnlitShapes {
 public:
  /// Of the nodes that are there now. `wanted`: they are to be lit. O(nodes).
  UnlitShapes(const Scene& scene, bool wanted);
  /// Decides by the world as it is seen first, and reports that, with the number of such Shapes. O(Shapes).
  void look_at(const light::LightWorld& world, Diagnostics& diag);
  /// Reports that they stay as they are, with the number of such Shapes. O(Shapes).
  void report_kept(const light::LightWorld& world, std::string_view why, Diagnostics& diag) const;
  bool are_lit() const { return lit_; }
  /// Of a Shape with such an Appearance, or without one.
  bool is_one(NodeId shape, NodeId appearance) const;
  /// Gives those of the parts a white Material, so that whatever comes later takes them for what they are now: they
  /// look the same, but for the light. Other Shapes keep an Appearance that they had in common. O(nodes).
  void give_material(Scene& scene, const std::vector<Part>& parts, const drawing::Stage& stage);

 private:
  struct Found {
    std::size_t n = 0;
    NodeId first;
  };
  Found find(const light::LightWorld& world) const;

  const Scene& scene_;
  bool wanted_, decided_ = false, lit_ = false;
  std::vector<char> before_viewer_, driven_;  // by node
  NodeId white_;
};

}  // namespace wrlkit::bake
