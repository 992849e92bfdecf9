#include "passes/lower_vrml1/placement.h"

#include "base/math/digits.h"
#include "scenegraph/decompose.h"

namespace wrlkit::vrml1 {
namespace {

/// One after the other in one Transform; none where it takes two.
std::optional<TransformFields> sum(const TransformFields& a, const TransformFields& b) {
  const TransformFields none;
  if (a == none) return b;
  if (b == none) return a;
  const bool unturned = a.rotation[3] == 0, unscaled = a.scale == none.scale;
  if (unturned && unscaled) {
    auto out = b;
    for (std::size_t i = 0; i < 3; ++i) out.translation[i] = to_15_digits(a.translation[i] + b.translation[i]);
    return out;
  }
  if (unscaled && a.center == none.center && b == TransformFields{.translation = b.translation}) {
    auto out = a;
    const Vec3 turned = rotation_matrix(a.rotation).point(b.translation);
    for (std::size_t i = 0; i < 3; ++i) out.translation[i] = to_15_digits(a.translation[i] + turned[i]);
    without_noise(out.translation);
    return out;
  }
  const bool b_only_scales = b.translation == none.translation && b.rotation[3] == 0 && b.center == none.center;
  if (!unscaled || a.center != none.center || !b_only_scales) return std::nullopt;
  auto out = a;
  out.scale = b.scale;
  out.scale_orientation = b.scale_orientation;
  return out;
}

}  // namespace

void Placement::then(const TransformFields& next) {
  matrix_ = matrix_ * matrix_of(next);
  if (fields_) fields_ = sum(*fields_, next);
}

void Placement::then(const Matrix& next) {
  matrix_ = matrix_ * next;
  fields_.reset();
}

void Placement::then(const Placement& next) {
  if (next.fields_) return then(*next.fields_);
  then(next.matrix_);
}

TransformFields Placement::fields() const { return fields_ ? *fields_ : decompose(matrix_); }

}  // namespace wrlkit::vrml1
