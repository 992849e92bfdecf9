// A matrix as the fields of one Transform: a rotation times a scale along turned axes (polar decomposition).
#pragma once
#include "scenegraph/transform.h"

namespace wrlkit {

/// The Transform of a matrix: R V S V', where A V has columns square to each other (singular values). A mirrored matrix
/// has one negative scale; one that flattens still has a rotation; one that is not finite is the identity.
TransformFields decompose(const Matrix&);
/// Components that are nothing compared with the largest become 0.
void without_noise(Vec3&);

}  // namespace wrlkit
