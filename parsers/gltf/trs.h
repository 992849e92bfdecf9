// Where a node of glTF is: translation, rotation and scale, or a matrix, as the fields of a Transform.
#pragma once
#include "base/math/quaternion.h"
#include "base/text/json_reader.h"
#include "scenegraph/transform.h"

namespace wrlkit::gltf_reader {

/// Axis and angle from 0 to pi, to 15 digits, so that what was a short number is one again; 0 0 1 0 for none.
Vec4 axis_angle(Quaternion);
Vec3 rotate(const Vec4& axis_angle, const Vec3&);

/// The fields of a Transform (ISO/IEC 14772-1, 6.52) without center.
struct Place {
  Vec3 translation{0, 0, 0}, scale{1, 1, 1};
  Vec4 rotation{0, 0, 1, 0}, scale_orientation{0, 0, 1, 0};

  bool identity() const { return translation == Vec3{0, 0, 0} && scale == Vec3{1, 1, 1} && rotation[3] == 0; }
  bool scaled() const { return scale != Vec3{1, 1, 1}; }
  Matrix matrix() const;
};

/// For a node: its matrix taken apart, or translation, rotation and scale. Numbers that are none, or not finite, are
/// left out.
Place place_of(Json node);
/// A Transform can express every matrix: T R SR S -SR is the polar decomposition, whatever its shear and mirroring.
Place place_of(const Matrix&);

}  // namespace wrlkit::gltf_reader
