// Triangles in the plane.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/polygon/orientation.h"

namespace wrlkit::flat_tests {

struct Flat {
  std::vector<Vec2> points;
  std::vector<std::uint32_t> triangles;
};

inline double area(const Flat& f) {
  double sum = 0;
  for (std::size_t t = 0; t < f.triangles.size(); t += 3)
    sum += orientation(f.points[f.triangles[t]], f.points[f.triangles[t + 1]], f.points[f.triangles[t + 2]]) / 2;
  return sum;
}

/// The number of triangles that the point is inside of.
inline int covered(const Flat& f, const Vec2& p) {
  int n = 0;
  for (std::size_t t = 0; t < f.triangles.size(); t += 3) {
    const Vec2 &a = f.points[f.triangles[t]], &b = f.points[f.triangles[t + 1]], &c = f.points[f.triangles[t + 2]];
    n += orientation(a, b, p) > 0 && orientation(b, c, p) > 0 && orientation(c, a, p) > 0;
  }
  return n;
}

inline bool all_face_up(const Flat& f) {
  for (std::size_t t = 0; t < f.triangles.size(); t += 3)
    if (orientation(f.points[f.triangles[t]], f.points[f.triangles[t + 1]], f.points[f.triangles[t + 2]]) <= 0)
      return false;
  return true;
}

}  // namespace wrlkit::flat_tests
