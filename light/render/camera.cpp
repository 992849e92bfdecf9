#include "light/render/camera.h"

#include <algorithm>
#include <utility>

namespace wrlkit::drawing {
namespace {

/// Any direction across the given one.
V3 across(const V3& v) { return unit(std::fabs(v.y) < 0.9 ? cross({0, 1, 0}, v) : cross({0, 0, 1}, v)); }

Camera with_lens(const Lens& lens) {
  Camera c;
  c.width = std::clamp(lens.width, 1, 32768);
  c.height = std::clamp(lens.height, 1, 32768);
  double half = std::tan(0.5 * (lens.field_of_view > 1e-6 ? std::min(lens.field_of_view, 3.1) : 0.785398));
  double shorter = std::min(c.width, c.height);
  c.half_x = half * c.width / shorter;
  c.half_y = half * c.height / shorter;
  return c;
}

}  // namespace

Camera camera_in(const Affine& frame, const Lens& lens) {
  Camera c = with_lens(lens);
  if (!finite(frame)) return c;
  c.eye = frame.t;
  V3 back = unit(frame.z);
  if (!(dot(back, back) > 0)) return c;
  V3 right = unit(cross(frame.y, back));
  c.back = back;
  c.right = dot(right, right) > 0 ? right : across(back);
  c.up = cross(c.back, c.right);
  return c;
}

Camera camera_at(const V3& eye, const V3& target, const V3& up, const Lens& lens) {
  V3 back = unit(eye - target);
  return camera_in({{1, 0, 0}, up, dot(back, back) > 0 ? back : V3(0, 0, 1), eye}, lens);
}

Camera camera_on(const Box& box, const Lens& lens) {
  if (box.empty()) return camera_at({0, 0, 10}, {0, 0, 0}, {0, 1, 0}, lens);
  V3 size = box.size(), centre = box.centre();
  bool flat = size.z <= 1e-3 * std::max(size.x, size.y);
  V3 towards = unit(flat ? V3(0, 0, 1) : V3(0.6, 0.5, 1));
  Camera c = camera_at(towards, {0, 0, 0}, {0, 1, 0}, lens);
  // A corner is inside when |corner - eye| across is at most its depth times k. For an eye at depth D behind the centre
  // that leaves an interval across, which shrinks with D: the nearest eye has one just left, in the middle of which it
  // stands.
  auto place = [&](const V3& axis, double k) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (int i = 0; i < 8; ++i) {
      V3 q = box.corner(i) - centre;
      most = std::max(most, dot(q, axis) + k * dot(q, c.back));
      least = std::min(least, dot(q, axis) - k * dot(q, c.back));
    }
    return std::pair{(most + least) / 2, (most - least) / (2 * k)};
  };
  constexpr double used = 0.9;
  auto [x, depth_x] = place(c.right, used * c.half_x);
  auto [y, depth_y] = place(c.up, used * c.half_y);
  double depth = std::max(depth_x, depth_y);
  c.eye = centre + x * c.right + y * c.up + (depth > 0 ? depth : 10) * c.back;
  return c;
}

}  // namespace wrlkit::drawing
