// Charts: pieces of a surface, each laid flat in a plane of its own. What `unfold` gives and `pack` takes.
#pragma once
#include <cstdint>
#include <vector>

namespace wrlkit::unwrap {

struct Point2 {
  double x = 0, y = 0;

  friend Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }
  friend Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
  friend Point2 operator*(double s, Point2 a) { return {s * a.x, s * a.y}; }
};
inline double dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }
inline double cross(Point2 a, Point2 b) { return a.x * b.y - a.y * b.x; }

struct Point2f {
  float x = 0, y = 0;
};

/// In metres. A chart's box begins at (0, 0); it is turned so that the box is small. A triangle's corners run
/// counter-clockwise, as they do when one looks at its front.
struct Charts {
  std::vector<Point2f> places;           // of each corner, three a triangle
  std::vector<std::uint32_t> chart_of;   // of each triangle
  std::vector<std::uint32_t> triangles;  // those of chart 0, those of chart 1, ...
  std::vector<std::uint32_t> begin;      // where those of each chart begin, and the end
  std::vector<Point2f> sizes;            // of each chart's box

  std::size_t size() const { return sizes.size(); }
};

}  // namespace wrlkit::unwrap
