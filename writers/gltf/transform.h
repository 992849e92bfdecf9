// The transforms of glTF nodes: translation, rotation, scale, and nothing else. A VRML Transform can do more, a scale
// along turned axes; that becomes two nodes, one below the other. (A matrix would be no way out: glTF allows only
// matrices that decompose into translation, rotation and scale again.)
#pragma once
#include <optional>

#include "base/math/quaternion.h"
#include "scenegraph/transform.h"

namespace wrlkit::gltf {

/// About an axis of any length; none when the axis is zero or a number is too large for glTF.
Quaternion quaternion(const Vec4& axis_angle);
/// Turns -Z, where lights and cameras of glTF look, into a direction of any length; none when that is zero.
Quaternion looking_along(const Vec3& direction);
Vec3 rotate(const Quaternion&, const Vec3&);

struct Trs {
  Vec3 translation{0, 0, 0};
  Quaternion rotation{};
  Vec3 scale{1, 1, 1};
  bool identity() const { return translation == Vec3{0, 0, 0} && rotation.identity() && scale == Vec3{1, 1, 1}; }
};

/// At the origin when the position is too large for glTF, or no number.
Trs placed_at(const Vec3& position, const Quaternion& rotation);
Matrix matrix(const Trs&);
/// Nothing when the axes are not at right angles, or make a mirror image, or one has no length.
std::optional<Trs> trs_of(const Matrix&);
/// How much lengths grow, on average: cube root of the volume of what was a unit cube.
double mean_scale(const Matrix&);
/// How much any length grows, at most; exact where axes stay at right angles, otherwise not below it.
double largest_scale(const Matrix&);

/// What makes metres of positions that are stored as whole numbers.
struct Dequantization {
  Vec3 origin{0, 0, 0};
  double step = 1;
};

/// A node of type Transform as one or two glTF nodes.
struct NodeTransform {
  Trs outer;
  std::optional<Trs> inner;  // of a child that takes the children
  bool plain = true;         // `outer` is what the fields say; otherwise center or scaleOrientation are in it
};

/// The standard's T C R SR S -SR -C (ISO/IEC 14772-1, 6.52), in double. Vectors with a number that is too large for
/// glTF, or none, read as the default.
NodeTransform node_transform(const Scene&, NodeId transform);

}  // namespace wrlkit::gltf
