// Symmetric 3 by 3 matrices: what the squared distances from planes and lines add up to.
#pragma once
#include "base/math/vec.h"

namespace wrlkit::simplify {

/// In the order xx xy xz yy yz zz.
struct SymmetricMatrix {
  double a[6] = {};

  Vec3 operator*(const Vec3& v) const {
    return {a[0] * v[0] + a[1] * v[1] + a[2] * v[2], a[1] * v[0] + a[3] * v[1] + a[4] * v[2],
            a[2] * v[0] + a[4] * v[1] + a[5] * v[2]};
  }
  double trace() const { return a[0] + a[3] + a[5]; }
  void add(const SymmetricMatrix& m, double s) {
    for (int i = 0; i < 6; ++i) a[i] += s * m.a[i];
  }
  /// s v v^T.
  void add_outer(const Vec3& v, double s) {
    a[0] += s * v[0] * v[0];
    a[1] += s * v[0] * v[1];
    a[2] += s * v[0] * v[2];
    a[3] += s * v[1] * v[1];
    a[4] += s * v[1] * v[2];
    a[5] += s * v[2] * v[2];
  }
  void add_identity(double s) {
    a[0] += s;
    a[3] += s;
    a[5] += s;
  }
  /// Times the determinant.
  SymmetricMatrix adjugate() const {
    return {{a[3] * a[5] - a[4] * a[4], a[2] * a[4] - a[1] * a[5], a[1] * a[4] - a[2] * a[3], a[0] * a[5] - a[2] * a[2],
             a[1] * a[2] - a[0] * a[4], a[0] * a[3] - a[1] * a[1]}};
  }
};

/// Squared distance from the line along e, by its squared length, times a weight.
inline SymmetricMatrix line_matrix(const Vec3& e, double weight) {
  SymmetricMatrix m;
  m.add_identity(weight * dot(e, e));
  m.add_outer(e, -weight);
  return m;
}

/// Where x A x - 2 b x is least, drawn very slightly to `middle`, which decides along what is flat.
struct Minimum {
  bool exists = false;
  Vec3 x{};
  SymmetricMatrix inverse;  // of A, times a positive number

  Minimum(const SymmetricMatrix& a, const Vec3& b, const Vec3& middle) {
    const double pull = 1e-7 * a.trace();
    SymmetricMatrix m = a;
    m.add_identity(pull);
    inverse = m.adjugate();
    const double determinant = m.a[0] * inverse.a[0] + m.a[1] * inverse.a[1] + m.a[2] * inverse.a[2];
    exists = determinant > 0;
    if (exists) x = 1 / determinant * (inverse * (b + pull * middle));
  }
};

}  // namespace wrlkit::simplify
