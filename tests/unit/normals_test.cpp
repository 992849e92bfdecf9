// Normals by creaseAngle.
#include "tests/unit/normals_fixture.h"

using namespace wrlkit;
using namespace wrlkit::normals_tests;

TEST_CASE("normals: a cube has 24, 24 and 8 at creaseAngle 0, 1 and 2") {
  Bench b;
  for (double crease : {0., 1.}) {
    b.set(cube_points(), cube_faces, crease);
    CHECK(b.run() == Outcome::changed);
    CHECK(b.pairs() == 24);
    CHECK(b.mesh.normal.count() == 6);
    for (std::size_t c = 0; c < 24; ++c) CHECK(b.normal(c) == cube_normals[c / 4]);
  }
  b.set(cube_points(), cube_faces, 2);
  b.run();
  CHECK(b.pairs() == 8);
  CHECK(b.mesh.normal.count() == 8);
  for (std::size_t c = 0; c < 24; ++c) check(b.normal(c), unit(cube_points()[b.mesh.corners[c]]));
}

TEST_CASE("normals: weights are angles, so that cutting a face changes nothing") {
  Bench b;
  b.set(cube_points(), triangulated(cube_faces), 2);
  b.mesh.face_begin.clear();  // triangles
  b.run();
  CHECK(b.pairs() == 8);
  for (std::size_t c = 0; c < 36; ++c) check(b.normal(c), unit(cube_points()[b.mesh.corners[c]]), 2e-5);

  b.set(cube_points(), triangulated(cube_faces), 1);
  b.run();
  CHECK(b.pairs() == 24);
  CHECK(b.mesh.normal.count() == 6);
  b.mesh.normal.clear();
  b.mesh.crease_angle = 0;
  b.run();
  CHECK(b.pairs() == 24);  // no vertex is split by a normal that is equal
}

TEST_CASE("normals: a cylinder is smooth around and flat on top") {
  constexpr int n = 16;
  std::vector<Point> points;
  std::vector<Face> faces(2);
  for (std::uint32_t i = 0; i < n; ++i) {
    double a = 2 * pi * i / n;
    for (double y : {-1., 1.}) points.push_back({std::cos(a), y, -std::sin(a)});
    std::uint32_t j = (i + 1) % n;
    faces.push_back({2 * i, 2 * j, 2 * j + 1, 2 * i + 1});
    faces[0].insert(faces[0].begin(), 2 * i);
    faces[1].push_back(2 * i + 1);
  }
  Bench b;
  b.set(points, faces, 0.5);
  b.run();
  CHECK(b.pairs() == 4 * n);
  for (std::size_t c = 0; c < n; ++c) CHECK(b.normal(0, c) == Point{0, -1, 0});
  for (std::size_t c = 0; c < n; ++c) CHECK(b.normal(1, c) == Point{0, 1, 0});
  for (std::size_t f = 2; f < 2 + n; ++f)
    for (std::size_t c = 0; c < 4; ++c) {
      Point p = points[b.mesh.corners[b.mesh.begin_of(f) + c]];
      check(b.normal(f, c), {p[0], 0, p[2]});
    }

  b.set(points, faces, 0.39);  // the sides differ by 0.3927
  b.run();
  CHECK(b.mesh.normal.count() == n + 2);
  for (std::size_t f = 2; f < 2 + n; ++f) {
    double a = 2 * pi * (f - 2 + 0.5) / n;
    check(b.normal(f, 0), {std::cos(a), 0, -std::sin(a)});
  }
}

TEST_CASE("normals: an edge is smooth below creaseAngle and only there") {
  Bench b;
  for (double angle : {0.001, 0.1, 0.5, 1.5, 3.0}) {
    CAPTURE(angle);
    b.set(hinge(angle), hinge_faces, angle + 1e-5);
    b.run();
    CHECK(b.pairs() == 6);
    for (std::size_t c : {0, 1}) check(b.normal(0, c), {std::sin(angle / 2), 0, std::cos(angle / 2)}, 2e-6);
    check(b.normal(0, 2), {0, 0, 1});
    check(b.normal(1, 1), {std::sin(angle), 0, std::cos(angle)});

    b.set(hinge(angle), hinge_faces, angle - 1e-5);
    b.run();
    CHECK(b.pairs() == 8);
    check(b.normal(0, 0), {0, 0, 1});
    check(b.normal(1, 0), {std::sin(angle), 0, std::cos(angle)});
  }
}

TEST_CASE("normals: faces that touch in one position only are not joined") {
  Bench b;
  b.set({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0.2}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}, 1);
  b.run();
  CHECK(b.pairs() == 6);
}

TEST_CASE("normals: a wall on a floor that is nearly flat") {
  Bench b;
  b.set({{0, 0, 0}, {0, 0, 1}, {-1, -0.1, 0}, {-1, -0.1, 1}, {1, -0.1, 0}, {1, -0.1, 1}, {0, 1, 0}, {0, 1, 1}},
        {{0, 2, 3, 1}, {0, 1, 7, 6}, {0, 1, 5, 4}}, 0.5);
  b.run();
  check(b.normal(0, 0), {0, 1, 0});
  check(b.normal(0, 3), {0, 1, 0});
  check(b.normal(2, 0), {0, 1, 0});
  check(b.normal(2, 1), {0, 1, 0});
  for (std::size_t c = 0; c < 4; ++c) check(b.normal(1, c), {-1, 0, 0});
  CHECK(b.pairs() == 2 * 1 + 4 + 4);
}

TEST_CASE("normals: a sheet that is given for both sides is two smooth sheets") {
  Bench b;
  std::vector<Face> faces = hinge_faces;
  for (const Face& f : hinge_faces) faces.push_back({f.rbegin(), f.rend()});
  faces.push_back(hinge_faces[0]);  // and once more
  b.set(hinge(0.2), faces, 1);
  b.run();
  CHECK(b.pairs() == 2 * 6);
  Point up = unit({std::sin(0.1), 0, std::cos(0.1)});
  check(b.normal(2, 3), {-b.normal(0, 0)[0], 0, -b.normal(0, 0)[2]}, 0.1);
  CHECK(b.normal(0, 0) == b.normal(1, 0));
  CHECK(b.normal(0, 0) == b.normal(4, 0));
  CHECK(b.normal(2, 3) == b.normal(3, 3));
  check(b.normal(2, 3), {-up[0], 0, -up[2]});
}

TEST_CASE("normals: neighbours that are wound against each other meet in a crease") {
  Bench b;
  std::vector<Face> faces{hinge_faces[0], {1, 5, 4, 0}};
  b.set(hinge(0), faces, 3.1415);
  b.run();
  for (std::size_t c = 0; c < 4; ++c) CHECK(b.normal(0, c) == Point{0, 0, 1});
  for (std::size_t c = 0; c < 4; ++c) CHECK(b.normal(1, c) == Point{0, 0, -1});

  b.set(hinge(0), faces, 4);  // smooth, but the sum cancels out: a normal it is all the same
  b.run();
  b.check_unit();
  CHECK(b.pairs() == 6);
  CHECK(b.normal(1, 0) == Point{0, 0, 1});
}

TEST_CASE("normals: a strip of Moebius is smooth but for one crease") {
  constexpr std::uint32_t n = 60;
  std::vector<Point> points;
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    double a = 2 * pi * i / n, r = 0.3;
    for (double s : {-r, r})
      points.push_back(
          {(1 + s * std::cos(a / 2)) * std::cos(a), (1 + s * std::cos(a / 2)) * std::sin(a), s * std::sin(a / 2)});
    if (i + 1 < n) faces.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  }
  faces.push_back({2 * n - 2, 1, 0, 2 * n - 1});
  Bench b;
  b.set(points, faces, 1);
  b.run();
  b.check_unit();
  CHECK(b.pairs() == 2 * n + 2);
  Point before = b.normal(n - 1, 1), after = b.normal(0, 3);  // both at point 1
  double dot = 0;
  for (int i = 0; i < 3; ++i) dot += before[i] * after[i];
  CHECK(dot < -0.98);
}

TEST_CASE("normals: ccw FALSE turns them round, concave corners included") {
  std::vector<Point> points{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.5, 0}, {0, 2, 0}, {1, 0.5, -1}, {0, 2, -1}};
  std::vector<Face> faces{{0, 1, 2, 3, 4}, {4, 3, 5, 6}};
  Bench b;
  b.set(points, faces, 2);
  b.run();
  std::vector<Point> front;
  for (std::size_t c = 0; c < b.mesh.corners.size(); ++c) front.push_back(b.normal(c));
  check(front[0], {0, 0, 1});
  // At point 3 the floor turns by 2 pi - 2 atan(2/3), the wall by pi / 2.
  double reflex = 2 * pi - 2 * std::atan2(1, 1.5), l = std::hypot(1, 1.5);
  check(front[3], unit({1.5 / l * (pi / 2), 1 / l * (pi / 2), reflex}), 1e-4);

  b.set(points, faces, 2);
  b.mesh.ccw = false;
  b.run();
  for (std::size_t c = 0; c < front.size(); ++c) check(b.normal(c), {-front[c][0], -front[c][1], -front[c][2]}, 1e-7);
}

TEST_CASE("normals: faces without area") {
  Bench b;
  SECTION("take the normal of a neighbour, and do not smooth a crease") {
    // The edge 0 1 of a hinge is opened by a triangle 0 8 1 whose corners are in one line.
    std::vector<Point> points = hinge(1);
    points.push_back({0, 0.5, 0});
    b.set(points, {{0, 1, 3, 2}, {0, 4, 5, 1, 6}, {0, 6, 1}}, 0.5);
    b.run();
    b.check_unit();
    for (std::size_t c = 0; c < 4; ++c) check(b.normal(0, c), {0, 0, 1});
    for (std::size_t c = 0; c < 5; ++c) check(b.normal(1, c), {std::sin(1), 0, std::cos(1)});
    CHECK((b.normal(2, 0) == b.normal(0, 0) || b.normal(2, 0) == b.normal(1, 0)));
  }
  SECTION("but for rounding") {
    b.set({{0.1, 0.3, 0.7}, {0.2, 0.6, 1.4}, {0.3, 0.9, 2.1}, {0.7, 2.1, 4.9}}, {{0, 1, 2}, {0, 2, 3}, {3, 1, 0}}, 0.5);
    b.run();
    for (std::size_t c = 0; c < 9; ++c) CHECK(b.normal(c) == Point{0, 0, 1});
  }
  SECTION("have no weight") {
    std::vector<Point> points = hinge(0.4);
    points.push_back({0, 0.5, 0});
    std::vector<Face> faces{{0, 1, 3, 2}, {0, 4, 5, 1, 6}, {0, 6, 1}, {1, 0, 6}, {6, 1, 0}};
    b.set(points, faces, 0.5);
    b.run();
    for (std::size_t c : {0, 1}) check(b.normal(0, c), {std::sin(0.2), 0, std::cos(0.2)}, 2e-6);
    check(b.normal(1, 4), {std::sin(0.4), 0, std::cos(0.4)});
  }
  SECTION("alone have the default") {
    for (double crease : {0., 0.5, 4.}) {
      b.set({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}}, {{0, 1, 2}, {0, 0, 0}, {0, 3, 0, 3}, {0, 1}, {}, {1}},
            crease);
      b.run();
      for (std::size_t c = 0; c < b.mesh.corners.size(); ++c) CHECK(b.normal(c) == Point{0, 0, 1});
    }
  }
  SECTION("numbers that are not finite, or whose squares are not") {
    double nan = std::nan(""), inf = HUGE_VAL;
    for (double crease : {0., 0.5, 4.})
      for (double bad : {nan, inf, -inf, 1e300, 1e-300, 1e160}) {
        std::vector<Point> points = hinge(0.3);
        points[4][1] = bad;
        b.set(points, hinge_faces, crease);
        b.run();
        b.check_unit();
        points = hinge(0.3);
        points[0][2] = bad;
        points[5][2] = -bad;
        b.set(points, hinge_faces, crease);
        b.run();
        b.check_unit();
      }
  }
}

TEST_CASE("normals: the pole of a sphere, whose quadrilaterals have an edge without length") {
  constexpr std::uint32_t n = 12;
  for (bool one_pole : {true, false}) {
    std::vector<Point> points;
    std::vector<Face> faces;
    for (std::uint32_t i = 0; i < n; ++i) {
      double a = 2 * pi * i / n;
      points.push_back({0, 1, 0});
      points.push_back({0.3 * std::cos(a), 0.95, -0.3 * std::sin(a)});
      std::uint32_t j = (i + 1) % n, pole = one_pole ? 0 : 2 * i, next_pole = one_pole ? 0 : 2 * j;
      faces.push_back({pole, 2 * i + 1, 2 * j + 1, next_pole});
    }
    Bench b;
    b.set(points, faces, 1);
    b.run();
    b.check_unit();
    for (std::size_t f = 0; one_pole && f < n; ++f) {
      check(b.normal(f, 0), {0, 1, 0}, 1e-5);
      CHECK(b.normal(f, 0) == b.normal(f, 3));
    }
    Point side = b.normal(0, 2);
    double a = 2 * pi / n;
    CHECK(std::atan2(-side[2], side[0]) == Approx(a).margin(1e-5));
  }
}

TEST_CASE("normals: Newell's of a face that is not planar") {
  Bench b;
  b.set({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}}, {{0, 1, 2, 3}}, 0.5);
  b.run();
  check(b.normal(0), unit({-1, -1, 2}));
  CHECK(b.mesh.normal.count() == 1);
  // The corners of a regular pentagon, lifted: the projected area counts, and the heights cancel out.
  std::vector<Point> points;
  for (int i = 0; i < 5; ++i)
    points.push_back({std::cos(2 * pi * i / 5), std::sin(2 * pi * i / 5), std::cos(4 * pi * i / 5)});
  b.set(points, {{0, 1, 2, 3, 4}}, 0.5);
  b.run();
  check(b.normal(0), {0, 0, 1});
}

TEST_CASE("normals: large coordinates") {
  Bench b;
  Point far{5'000'000.123, -4'000'000.456, 3'000'000.789};
  b.set(cube_points(far, 0.01), cube_faces, 2);
  b.run();
  CHECK(b.pairs() == 8);
  for (std::size_t c = 0; c < 24; ++c) check(b.normal(c), unit(cube_points()[b.mesh.corners[c]]), 1e-6);
}
