// Levels of detail while light is computed: a world is lit as it looks with the first level of each LOD, then with the second, and so
// on; what was lit before keeps the light that it has.
#pragma once
#include <cstddef>
#include <unordered_set>
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit::bake {

class Levels {
 public:
  static constexpr std::size_t most = 8;  // levels of a LOD that are looked at

  explicit Levels(Scene& scene);
  Levels(const Levels&) = delete;
  /// All LODs are as they were.
  ~Levels() { show(0); }

  /// Of the LOD that has most of them; 1 without any.
  std::size_t count() const { return count_; }
  /// Of each LOD that level, or its last one, is what a browser shows from now on: it stands in front.
  void show(std::size_t level);

  /// What is shown and has no light yet gets an Appearance and a geometry of its own, where it shares them with what has.
  void own_what_is_lit();
  /// Shapes that have light.
  void add(NodeId shape);
  bool is_lit(NodeId shape) const { return lit_.contains(shape.value); }

 private:
  Scene& scene_;
  std::vector<NodeId> lods_;
  std::size_t count_ = 1, shown_ = 0;
  std::unordered_set<std::uint32_t> lit_, taken_;  // Shapes; Appearances and geometry of these
};

}  // namespace wrlkit::bake
