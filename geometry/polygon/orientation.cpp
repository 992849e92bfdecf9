#include "geometry/polygon/orientation.h"

namespace wrlkit {
namespace {

/// A number as a sum of doubles that do not overlap, smallest first: rounding errors are kept as further terms.
class ExactSum {
 public:
  void add_product(double a, double b) {
    double p = a * b;
    add(std::fma(a, b, -p));
    add(p);
  }

  /// The largest term has the sign of the whole, and all but a rounding error of its value.
  double value() const { return n_ ? terms_[n_ - 1] : 0; }

 private:
  void add(double carry) {
    int kept = 0;
    for (int i = 0; i < n_; ++i) {
      double sum = carry + terms_[i], part = sum - carry;
      double error = (carry - (sum - part)) + (terms_[i] - part);
      if (error != 0) terms_[kept++] = error;
      carry = sum;
    }
    if (carry != 0) terms_[kept++] = carry;
    n_ = kept;
  }

  double terms_[12];
  int n_ = 0;
};

}  // namespace

double exact_orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  ExactSum sum;
  sum.add_product(a[0], b[1]);
  sum.add_product(-a[1], b[0]);
  sum.add_product(b[0], c[1]);
  sum.add_product(-b[1], c[0]);
  sum.add_product(c[0], a[1]);
  sum.add_product(-c[1], a[0]);
  return sum.value();
}

}  // namespace wrlkit
