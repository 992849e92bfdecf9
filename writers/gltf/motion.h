// What the ROUTEs of a scene move without a Script: from the fraction of a TimeSensor through interpolators, which may
// stand one behind the other, to fields of nodes, and from a field that is moved to others that follow it.
//
// Core glTF has translation, rotation and scale of a Transform, position and orientation of a Viewpoint, the location
// of a light, the points of a Coordinate and the vectors of a Normal (as morph targets). By KHR_animation_pointer:
// colours and numbers of materials and lights, fieldOfView, and TextureTransform. A number can be the fraction itself.
// What moves anything else is kept in extras and lost.
#pragma once
#include <map>
#include <set>

#include "base/diagnostics.h"
#include "writers/gltf/curves.h"

namespace wrlkit::gltf {

class Motion {
 public:
  static constexpr std::size_t max_frames =
      4'000'000;  // of all curves: interpolators behind one another multiply theirs

  /// Which fields count: none, those of core glTF, or those of KHR_animation_pointer as well.
  enum class Reach : std::uint8_t { nothing, core, pointers };
  Motion(const Scene&, Reach, Diagnostics&);

  struct Drive {
    NodeId clock;
    std::uint32_t curve;
  };
  /// What moves a field; of each clock one, the clocks in the order of their ids.
  std::span<const Drive> drives(NodeId, std::uint16_t slot) const;
  bool moves(NodeId n, std::uint16_t slot) const { return !drives(n, slot).empty(); }
  const Curve& curve(std::uint32_t i) const { return curves_[i]; }
  const std::set<std::uint32_t>& clocks() const { return clocks_; }
  using Field = std::pair<std::uint32_t, std::uint16_t>;  // node, slot
  const std::map<Field, std::vector<Drive>>& fields() const { return fields_; }

  /// A clock or interpolator whose ROUTEs all have a counterpart; of a clock only those that go out count.
  bool expressed(NodeId) const;
  std::size_t n_expressed_routes() const { return n_routes_; }
  bool says(const Route& r) const { return expressed_.contains(&r); }
  /// ROUTEs that something else expresses.
  void add_expressed(const std::set<const Route*>&);

 private:
  /// An event that goes on from a node: of an interpolator what it says, or a field that has been set.
  struct Step {
    NodeId node;
    std::uint16_t slot;
    std::uint32_t curve;  // none: the clock itself
    const Route* by;
    std::size_t before;  // into steps_
  };
  void run(NodeId clock);
  bool take(const Step&, const Route&);
  void arrive(const Step& at, NodeId clock);
  void count_routes();

  const Scene& scene_;
  Reach reach_;
  Diagnostics& diag_;
  std::multimap<std::uint32_t, const Route*> onward_;
  std::vector<Curve> curves_;
  std::map<Field, std::vector<Drive>> fields_;
  std::set<std::uint32_t> clocks_;
  std::set<const Route*> expressed_;
  std::vector<Step> steps_;
  std::set<Field> seen_;  // of one clock
  std::size_t n_frames_ = 0, n_routes_ = 0;
  std::map<std::uint32_t, std::pair<std::size_t, std::size_t>> routes_;  // of a clock or interpolator: all, expressed
  std::set<std::uint32_t> told_;                                         // interpolators
};

}  // namespace wrlkit::gltf
