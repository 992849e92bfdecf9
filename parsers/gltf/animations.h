// Animations of glTF as TimeSensor, interpolators and ROUTEs; one TimeSensor each, of which the first runs.
//
// LINEAR is what interpolators do: along lines, and rotations along the shorter arc. STEP becomes two keys at one
// place. CUBICSPLINE is cut into straight pieces that stay within 1e-3 of the largest value, up to 64 between two keys.
// Weights of morph targets move points: a CoordinateInterpolator. What KHR_animation_pointer says of colours, light and
// cameras (pointers.h) is Color- and ScalarInterpolators; between colours stand seven more, because glTF mixes them as
// light.
#pragma once
#include <set>

#include "parsers/gltf/pointers.h"

namespace wrlkit::gltf_reader {

class Animations {
 public:
  static constexpr std::uint64_t max_numbers = 50'000'000;  // of keyValues of CoordinateInterpolators

  Animations(const Context& c, const Hierarchy& h, const Meshes& m, const Extras& e)
      : c_(c), hierarchy_(h), meshes_(m), extras_(e) {}

  /// Adds what moves to the roots of the scene.
  void build();

 private:
  struct Track {
    std::vector<double> time;
    std::vector<std::vector<double>> value;  // at each time
  };
  void animation(Json, bool runs);
  bool came_back(Json) const;
  void channel(Json channel, Json animation, NodeId clock, double duration);
  void move(Json sampler, std::uint32_t node, std::string_view path, NodeId clock, double duration, Json at);
  void pointer(Json sampler, std::string_view pointer, NodeId clock, double duration, Json at);
  void follow(const Track&, const Follower&, NodeId clock, double duration, Json at);
  std::optional<Track> track(Json sampler, std::size_t width);
  Track spline(const Numbers& in, const Numbers& out, std::size_t width) const;
  void connect(NodeId clock, NodeId interpolator, NodeId to, std::string_view event);
  void morph(Json sampler, std::uint32_t node, NodeId clock, double duration, Json at);
  double duration(Json animation);

  Context c_;
  const Hierarchy& hierarchy_;
  const Meshes& meshes_;
  const Extras& extras_;
  std::vector<NodeId> made_;
  std::set<std::uint32_t> morphed_;
  std::uint64_t n_numbers_ = 0;
};

/// Nodes that animations move: those must be Transforms.
std::set<std::uint32_t> moved_nodes(File&);

}  // namespace wrlkit::gltf_reader
