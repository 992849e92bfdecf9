// The output of interpolators in the course of one cycle of a clock (ISO/IEC 14772-1, 4.6.8 and 6.8), also behind one
// another.
//
// A curve tells for each fraction of the cycle how far along the keys an interpolator is: 2.25 is a quarter of the way
// from its third value to its fourth. Between two frames that goes evenly, so whatever goes evenly between values needs
// no more keys in glTF than frames. Two frames at one fraction are a jump. The first frame is at 0, the last at 1.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit::gltf {

/// A number, vector, color or quaternion: what there is of it, and zeros.
using Sample = std::array<double, 4>;

/// Between quaternions along the shorter arc.
Sample mix(const Sample& a, Sample b, double t, bool rotation);

struct Curve {
  enum class Side : std::uint8_t { before, behind };  // of a jump
  struct Frame {
    double at, place;
  };
  NodeId interpolator;  // none: the place is the value, an SFFloat
  std::vector<Frame> frames;

  double place(double at, Side) const;
};

/// An SFFloat in the course of a cycle: straight between these points.
struct Ramp {
  std::vector<std::array<double, 2>> points{{0, 0}, {1, 1}};  // fraction, value
};

bool is_interpolator(const Scene&, NodeId);
std::span<const double> keys(const Scene&, NodeId interpolator);
std::span<const double> key_values(const Scene&, NodeId interpolator);
/// Values that a key has of its own: one of a PositionInterpolator, all points of a CoordinateInterpolator. 0: no keys.
std::size_t values_per_key(const Scene&, NodeId interpolator);

/// Output of an interpolator whose set_fraction follows a ramp; none when it has no keys, or they do not ascend. More
/// than `most` frames are cut.
std::optional<Curve> follow(const Scene&, NodeId interpolator, const Ramp&, std::size_t most);
/// What a ScalarInterpolator that is on a curve sends out.
Ramp ramp_of(const Scene&, const Curve&);

/// The value of an interpolator of single values at a place among its keys. Colours go along lines of hue, saturation
/// and value (6.8), hue the shorter way round; a grey has the hue of the other end.
Sample value_at(const Scene&, NodeId interpolator, double place);

}  // namespace wrlkit::gltf
