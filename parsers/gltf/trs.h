// Where a node of glTF is: translation, rotation and scale, or a matrix, as the fields of a Transform.
#pragma once
#include "base/math/quaternion.h"
#include "base/text/json_reader.h"
#include "scenegraph/transform.h"

namespace wrlkit::gltf_reader {

/// Axis and angle from 0 to pi, to 15 digits, so that what was a short number is one again; 0 0 1 0 for none.
Vec4 rotation_of(const Quaternion&);
Vec3 rotate(const Vec4& axis_angle, const Vec3&);

/// For a node: its matrix taken apart, or translation, rotation and scale. Numbers that are none, or not finite, are
/// left out.
TransformFields place_of(Json node);
/// A Transform can express every matrix: T R SR S -SR is the polar decomposition, whatever its shear and mirroring.
TransformFields place_of(const Matrix&);

}  // namespace wrlkit::gltf_reader
