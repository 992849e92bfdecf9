#include "geometry/outline.h"

#include <catch2/catch.hpp>

#include "tests/unit/flat_fixture.h"

using namespace wrlkit;
using namespace wrlkit::flat_tests;

namespace {

/// An axis-parallel square, anticlockwise, or not.
void square(Outline& outline, double low, double high, bool clockwise) {
  outline.move_to({low, low});
  outline.line_to(clockwise ? Vec2{low, high} : Vec2{high, low});
  outline.line_to({high, high});
  outline.line_to(clockwise ? Vec2{high, low} : Vec2{low, high});
}

Flat cut(Outline& outline) {
  Flat f;
  outline.cut(f.points, f.triangles);
  return f;
}

}  // namespace

TEST_CASE("outlines against the outer one are holes, either way round", "[outline]") {
  for (bool clockwise : {false, true}) {
    Outline outline(0.1);
    square(outline, -3, 3, !clockwise);
    square(outline, -1, 1, clockwise);  // an island in the hole
    square(outline, -5, 5, clockwise);
    square(outline, 20, 21, clockwise);
    auto f = cut(outline);
    CHECK(area(f) == Approx(100 - 36 + 4 + 1));
    CHECK(all_face_up(f));
    CHECK(covered(f, {0.1, 0.2}) == 1);
    CHECK(covered(f, {2, 0.1}) == 0);
    CHECK(covered(f, {4, 0.1}) == 1);
  }
}

TEST_CASE("outlines with the outer one are no holes, and crossing ones are kept", "[outline]") {
  Outline nested(0.1);
  square(nested, 0, 10, false);
  square(nested, 2, 4, false);
  CHECK(area(cut(nested)) == Approx(100));
  Outline crossing(0.1);
  square(crossing, 0, 10, false);
  square(crossing, 5, 12, false);
  auto f = cut(crossing);
  CHECK(area(f) == Approx(100 + 49));
  CHECK(covered(f, {7.5, 7.6}) == 2);
  Outline nothing(0.1);
  nothing.move_to({1, 1});
  nothing.conic_to({1, 1}, {1, 1});
  nothing.move_to({2, 2});
  nothing.line_to({3, 3});
  CHECK(cut(nothing).triangles.empty());
}

TEST_CASE("a hole may touch the outline around it", "[outline]") {
  for (double x : {-5.0, 5.0}) {
    Outline outline(0.1);
    square(outline, -5, 5, false);
    outline.move_to({x, 0});
    outline.line_to({0.6 * x, x < 0 ? 1.0 : -1.0});
    outline.line_to({0.6 * x, x < 0 ? -1.0 : 1.0});
    CHECK(area(cut(outline)) == Approx(100 - 2));
  }
}

TEST_CASE("curves stay within the tolerance", "[outline]") {
  // y = x * (2 - x) as a conic and as the same cubic; half as many chords are too few.
  for (double tolerance : {0.1, 0.01, 0.001}) {
    Outline conic(tolerance), cubic(tolerance);
    conic.move_to({0, 0});
    conic.conic_to({1, 2}, {2, 0});
    cubic.move_to({0, 0});
    cubic.cubic_to({2.0 / 3, 4.0 / 3}, {4.0 / 3, 4.0 / 3}, {2, 0});
    for (auto& f : {cut(conic), cut(cubic)}) {
      double n = double(f.points.size()) - 1, exact = 4.0 / 3;
      CHECK(1 / (n * n) <= tolerance);  // the sagitta of each chord
      CHECK(1 / (n * n) > tolerance / 3);
      CHECK(area(f) == Approx(exact - exact / (n * n)));
    }
  }
}
