// The transformation that the traversal of VRML 1.0 has gathered since the group around it, and the Transform for
// it. Any matrix is one: a rotation times a scale along turned axes (polar decomposition), which is what Transform can
// say.
#pragma once
#include <optional>

#include "scenegraph/transform.h"

namespace wrlkit::vrml1 {

class Placement {
 public:
  /// What follows is moved by this, and then by what was there before.
  void then(const TransformFields&);
  void then(const Matrix&);
  void then(const Placement&);

  bool identity() const { return matrix_ == Matrix{}; }
  const Matrix& matrix() const { return matrix_; }
  /// The fields as the file has them where they are those of one Transform, otherwise from the matrix.
  TransformFields fields() const;
  bool operator==(const Placement& o) const { return matrix_ == o.matrix_; }

 private:
  Matrix matrix_;
  std::optional<TransformFields> fields_ = TransformFields{};  // while they say it
};

}  // namespace wrlkit::vrml1
