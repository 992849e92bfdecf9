// The motion that takes points to others as nearly as can be, and how a Transform expresses it in few digits.
#pragma once
#include <span>

#include "passes/instance/form.h"

namespace wrlkit::instancing {

/// Least squares (Horn): rotation, one factor if `scaling` is uniform, and for `axis` any linear map. `mirrored`:
/// through a point, then turned. The points are around their means already; the result has no translation. O(points).
Matrix fit(std::span<const Vec3> from, std::span<const Vec3> to, Scaling scaling, bool mirrored);

/// Fields of a Transform for x -> linear (x - from) + to, with no more digits than keep every point within `step` of
/// where it was, as long as it is within `reach` of the origin.
TransformFields in_few_digits(const Matrix& linear, const Vec3& from, const Vec3& to, double reach, double step);

}  // namespace wrlkit::instancing
