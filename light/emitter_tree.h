// Which emitter to look at from a place: a tree over the emitters whose nodes know what they give at most, so that of
// thousands those are chosen that matter there. Samples go down the tree together and part at each node.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "light/flux.h"
#include "light/world.h"

namespace wrlkit::light {

class EmitterTree {
 public:
  /// A choice: `u` in [0, 1) chooses the emitter.
  struct Choice {
    double u;
    std::uint32_t emitter = none;
    double probability = 0;
    std::uint32_t index = 0;  // for the caller
  };
  static constexpr std::uint32_t none = 0xffffffff;

  /// n log n.
  explicit EmitterTree(std::span<const Emitter> emitters);

  bool empty() const { return nodes_.empty(); }
  /// Fills in emitter and probability, none where nothing can shine there. The order of the choices changes.
  void choose(const Receiver& at, std::span<Choice> choices) const;
  /// How probable it is that an emitter is chosen from there. O(log n).
  double probability(const Receiver& at, std::uint32_t emitter) const;

 private:
  struct Node {
    V3 middle, axis;
    double radius = 0, cos_spread = 1, sin_spread = 0;  // all normals lie within the spread around the axis
    double power = 0;
    bool wide = false;  // normals everywhere: the axis says nothing
    std::uint32_t parent = none, left = none, right = none, emitter = none;
  };
  std::uint32_t build(std::span<const Emitter> emitters, std::span<std::uint32_t> order, std::uint32_t parent);
  Node leaf(const Emitter& e) const;
  static Node join(const Node& a, const Node& b);
  static double importance(const Node& n, const Receiver& at);
  double share_of_left(const Node& n, const Receiver& at) const;
  void choose_below(std::uint32_t node, double probability, const Receiver& at, std::span<Choice> choices) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaf_of_;
};

}  // namespace wrlkit::light
