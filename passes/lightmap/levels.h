// Levels of detail while light is computed: a scene is lit in views, first with the first level of each LOD, then with
// what has not been seen yet; what was lit before keeps the light that it has.
#pragma once
#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "light/world.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scene.h"

namespace wrlkit::bake {

class Levels {
 public:
  static constexpr std::size_t most = 64;  // views

  /// Shapes have been given places of their own, in all levels (own_shapes.h).
  explicit Levels(Scene& scene) : scene_(scene), shown_(scene.node_count()) {}

  /// Chooses the next view. The first shows the first levels; each further one, of each LOD, the first level that holds
  /// a Shape which none has shown, or the last level. So a scene takes as many views as the longest way through its
  /// levels: LODs next to one another go on together, and of LODs within a level all are through before the level
  /// behind it has its turn. What stands around lamps keeps its first level until all else is through; then it is the
  /// other way round. False when there is no view that shows more, or there have been enough of them. O(nodes).
  bool next();
  /// How many views it takes, but for what stands around lamps. O(nodes) a view.
  static std::size_t count(Scene& scene);
  /// The number of the view, from 0.
  std::size_t view() const { return n_views_ - 1; }
  /// How far from the first levels those are that have their turn in this view.
  std::size_t depth() const { return depth_; }
  /// Small things around the PointLights and SpotLights of the first view. A lamp often stands just below the glass of
  /// its bulb, or where a simpler shade hides more or less of it: at another level all the world would be lit
  /// otherwise. O(Shapes * lamps).
  void find_shades(const light::LightWorld& world);
  /// Which level a LOD shows in this view.
  drawing::LevelOf level_of() const;
  /// Notes what is shown, and what of it has no light yet gets an Appearance and a geometry of its own where it shares
  /// them with what has.
  void own_what_is_lit();
  /// Shapes that have light.
  void add(NodeId shape);
  bool is_lit(NodeId shape) const { return lit_.contains(shape.value); }
  /// Shapes with geometry that no view has shown, after the last one.
  std::size_t n_unseen() const { return n_unseen_; }

 private:
  std::vector<char> holders_of_unseen();
  bool choose_unseen();
  std::uint32_t choose(NodeId lod, const std::vector<char>& holders_of_unseen) const;
  bool is_shade(NodeId n) const { return n.value < shades_.size() && shades_[n.value] && scene_.is(n, nodes::LOD); }

  Scene& scene_;
  std::size_t n_views_ = 0, depth_ = 0, n_unseen_ = 0;
  std::vector<char> shades_;          // by node: a lamp is in what it shows first, or in what that holds
  bool in_shades_ = false;            // they have their turn
  bool saw_more_ = true;              // the last view did
  std::vector<std::uint32_t> shown_;  // by node, of the LODs
  std::unordered_set<std::uint32_t> seen_, lit_, taken_;  // Shapes; and Appearances and geometry of those that are lit
};

}  // namespace wrlkit::bake
