// Animations: each TimeSensor that moves something (motion.h) is one, as long as its cycleInterval.
//
// Both languages go along lines, and between rotations along the shorter arc, so keys become times and values stay what
// they are. Keys that are equal are a jump: two times that are neighbours in single precision. An animation of glTF
// ends with its last key, a cycle of VRML with fraction 1: there is always a key at either end. Between orientations
// that are nearly half a turn apart there is one more, so that no reader takes the other way round. Where the ways
// differ, as for colours, which VRML mixes by hue and glTF as light, pieces are cut in up to 64 so that they stay
// within 1e-3.
//
// glTF knows neither loops nor what starts an animation: {"loop": ..., "trigger": ["Button.touchTime TO
// Clock.startTime"]} is in the extras. One that waits for an event has a name in any case.
#pragma once
#include <functional>

#include "base/text/json.h"
#include "writers/gltf/extras.h"
#include "writers/gltf/interactivity/events.h"
#include "writers/gltf/motion.h"
#include "writers/gltf/store.h"
#include "writers/gltf/transform.h"

namespace wrlkit::gltf {

enum class Path : std::uint8_t { translation, rotation, scale };
std::string_view name_of(Path);

/// A property of glTF that follows fields of VRML.
struct Property {
  /// A field as it is at a time: on a curve, or as it stands.
  struct At {
    const Scene* scene;
    const Curve* curve;
    double place;
    Sample value(const Sample& as_it_stands) const {
      return curve ? value_at(*scene, curve->interpolator, place) : as_it_stands;
    }
  };
  using Evaluate = std::function<void(std::span<const At> inputs, std::vector<double>& out)>;

  std::vector<std::uint32_t> nodes;  // that have it; none: it has a pointer
  std::string path;                  // translation, rotation, scale, weights; or a JSON pointer
  std::size_t width;
  std::vector<Motion::Field> inputs;
  Evaluate evaluate;
  bool straight = true;  // goes evenly where its inputs do
};

class Animations {
 public:
  /// `interactive`: what events do is written, too.
  Animations(const Scene&, Motion::Reach, bool interactive, Diagnostics&);

  const Motion& motion() const { return motion_; }
  const Events& events() const { return events_; }
  /// Does anything move that property of the node, or set it?
  bool moves(NodeId, Path) const;
  bool moves(NodeId n) const {
    return moves(n, Path::translation) || moves(n, Path::rotation) || moves(n, Path::scale);
  }

  /// A node of glTF that has a property of a node of VRML.
  void add_target(NodeId source, Path, std::uint32_t node);
  /// The nodes that were added so.
  std::span<const std::uint32_t> targets(NodeId source, Path) const;
  /// Marks the nodes of glTF that are moved.
  void mark_targets(std::vector<char>& marks) const {
    for (const auto& [property, nodes] : moved_)
      for (auto node : nodes) marks[node] = 1;
  }
  /// Nodes have moved up, from index i to became[i].
  void renumber(std::span<const std::uint32_t> became);
  void add(Property p) { properties_.push_back(std::move(p)); }

  struct Sampler {
    std::uint32_t input, output;
  };
  /// Puts the samples where accessors are. `offset`: of a node's translation, to be added to that of the field.
  void store(Store&, const std::function<Vec3(std::uint32_t node)>& offset);
  bool empty() const { return written_.empty(); }
  std::size_t count() const { return written_.size(); }
  /// The animation that a clock has become; none: it moves nothing.
  std::optional<std::uint32_t> index_of(NodeId clock) const;
  /// Seconds.
  double cycle_of(NodeId clock) const;
  bool uses_pointers() const { return pointers_; }
  void write(JsonOut&, std::size_t i, const Extras*, const std::function<std::uint32_t(std::uint32_t)>& accessor) const;

 private:
  struct Channel {
    std::uint32_t sampler, node;
    std::uint32_t property;
  };
  struct Written {
    NodeId clock;
    std::vector<Sampler> samplers;
    std::vector<Channel> channels;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;  // samplers
  };
  struct Frame {
    double at;
    std::vector<double> value;
  };
  void report_clocks_at_odds(const Property&) const;
  void add_transforms(const std::function<Vec3(std::uint32_t)>& offset);
  void add_channel(Written&, std::uint32_t property, double cycle, Store&);
  std::vector<Frame> frames(const Property&, std::span<const Curve* const>) const;
  void cut(std::vector<Frame>&, const Frame& to, const std::function<std::vector<double>(double, Curve::Side)>&) const;
  bool waits_for_more(NodeId clock) const;
  void write_target(JsonOut&, const Channel&) const;

  const Scene& scene_;
  Diagnostics& diag_;
  Motion motion_;
  Events events_;
  std::map<std::pair<std::uint32_t, Path>, std::vector<std::uint32_t>> moved_;  // nodes of glTF
  std::vector<Property> properties_;
  std::vector<Written> written_;
  std::map<std::uint32_t, std::vector<const Route*>> triggers_;  // ROUTEs that start, stop or change a clock
  bool pointers_ = false;
};

}  // namespace wrlkit::gltf
