// Closed outlines, as fonts have them, as triangles. What is inside follows the nonzero rule: outlines that run against
// the one around them are holes, whichever way that is.
#pragma once
#include "base/math/box.h"
#include "geometry/polygon.h"

namespace wrlkit {

class Outline {
 public:
  /// Curves become chords no farther from them than that.
  explicit Outline(double tolerance) : tolerance_(tolerance) {}

  void move_to(const Vec2& p);
  void line_to(const Vec2& p);
  void conic_to(const Vec2& control, const Vec2& p);
  void cubic_to(const Vec2& control, const Vec2& control2, const Vec2& p);

  /// Appends triangles, anticlockwise, that cover the inside. Outlines that cross each other are covered each by
  /// itself.
  void cut(std::vector<Vec2>& points, std::vector<std::uint32_t>& triangles);

 private:
  struct Ring {
    std::vector<Vec2> points;
    Box2 box{};
    double area = 0;                  // positive: anticlockwise
    int winding = 0;                  // of what is around it
    const Ring* inside_of = nullptr;  // the smallest around it
    bool is_outer() const { return winding == 0; }
    bool is_hole() const { return winding != 0 && winding + (area > 0 ? 1 : -1) == 0; }
  };
  std::size_t chords(double bend) const;
  void measure(Ring&) const;
  static bool contains(const Ring& outer, const Ring& inner);

  double tolerance_;
  std::vector<Ring> rings_;
};

}  // namespace wrlkit
