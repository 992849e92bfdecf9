// Animations: what TimeSensors move through interpolators and ROUTEs, without a Script between them. Each TimeSensor is an
// animation as long as its cycleInterval; a PositionInterpolator or OrientationInterpolator that it drives is a channel for
// every Transform (translation, rotation, scale) and Viewpoint (position, orientation) that it moves.
//
// Both languages go along lines, and between rotations along the shorter arc, so keys become times and values stay what
// they are. Keys that are equal are a jump: two times that are neighbours in single precision. An animation of glTF ends
// with its last key, a cycle of VRML with fraction 1: there is always a key at either end. Between orientations that are
// nearly half a turn apart there is one more, so that no reader takes the other way round. Everything else that ROUTEs do
// (colours, points, Scripts) is kept in extras and lost.
#pragma once
#include <array>
#include <functional>
#include <map>

#include "scenegraph/diagnostics.h"
#include "scenegraph/scene.h"
#include "writers/gltf_store.h"
#include "writers/gltf_transform.h"
#include "writers/json.h"

namespace wrlkit::gltf {

enum class Path : std::uint8_t { translation, rotation, scale };

class Animations {
 public:
  Animations(const Scene&, bool wanted, Diagnostics&);

  /// Does anything move that property of the node?
  bool moves(NodeId n, Path p) const { return moved_.contains({n.value, p}); }
  bool moves(NodeId n) const { return moves(n, Path::translation) || moves(n, Path::rotation) || moves(n, Path::scale); }
  /// A clock or interpolator whose ROUTEs all have a counterpart.
  bool expressed(NodeId n) const;
  std::size_t n_expressed_routes() const { return n_routes_; }

  /// A node of glTF that has a property of a node of VRML.
  void add_target(NodeId source, Path, std::uint32_t node);

  struct Sampler {
    std::uint32_t input, output;
  };
  /// Puts the samples where accessors are. `offset`: of a node's translation, to be added to that of the field.
  void store(Store&, const std::function<Vec3(std::uint32_t node)>& offset);
  bool empty() const { return written_.empty(); }
  std::size_t count() const { return written_.size(); }
  void write(JsonOut&, std::size_t i, const std::function<std::uint32_t(std::uint32_t)>& accessor) const;

 private:
  struct Channel {
    NodeId interpolator, target;
    Path path;
  };
  struct WrittenChannel {
    std::uint32_t sampler, node;
    Path path;
  };
  struct Written {
    NodeId clock;
    std::vector<Sampler> samplers;
    std::vector<WrittenChannel> channels;
  };
  bool drives(const Route&, Path&) const;
  void add_channel(Written&, const Channel&, double cycle, Store&, const std::function<Vec3(std::uint32_t)>& offset);

  const Scene& scene_;
  Diagnostics& diag_;
  std::map<std::uint32_t, std::vector<Channel>> channels_;  // by clock
  std::map<std::pair<std::uint32_t, Path>, std::vector<std::uint32_t>> moved_;  // nodes of glTF
  std::map<std::uint32_t, std::pair<std::size_t, std::size_t>> routes_;         // of a clock or interpolator: all, expressed
  std::size_t n_routes_ = 0;
  std::vector<Written> written_;
};

}  // namespace wrlkit::gltf
