#include "geometry/forms/upright.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/forms/cut.h"

namespace wrlkit {
namespace {

constexpr double noise = 1e-3;  // what two directions may differ by and still count as equally near

Matrix turn_about_y(double angle) { return rotation_matrix({0, 1, 0, angle}); }

/// Whether a direction points along the positive half of the first axis that it has a part in: Y before X before Z.
bool points_up(const Vec3& v) {
  for (std::size_t k : {std::size_t{1}, std::size_t{0}, std::size_t{2}})
    if (std::abs(v[k]) > noise) return v[k] > 0;
  return true;
}

double trace(const Matrix& m) { return m(0, 0) + m(1, 1) + m(2, 2); }

/// By whole segments, to the largest trace: the smallest rotation that is left.
void turn_segments(Form& form, int segments) {
  if (segments < 2) return;
  const Matrix& m = form.frame;
  const double step = 2 * std::numbers::pi / segments;
  const double best = std::atan2(m(2, 0) - m(0, 2), m(0, 0) + m(2, 2));
  const double whole = std::round(best / step);
  if (whole != 0) form.frame = form.frame * turn_about_y(whole * step);
}

/// Half a turn about an axis across Y, which the first point of a section stays on.
void put_head_up(Form& form, const Vec4& half_turn) {
  if (points_up(form.frame.column(1))) return;
  form.frame = form.frame * rotation_matrix(half_turn);
  std::swap(form.bottom, form.top);
}

/// Every way to stand a box on one of its faces.
void turn_box(Form& form, BoxForm& box) {
  const Form start = form;
  const Vec3 size = box.size;
  double best = trace(start.frame);
  constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int o = 0; o < 6; ++o)
    for (int signs = 0; signs < 4; ++signs) {
      Matrix turned = start.frame;
      const double sign[3] = {signs & 1 ? -1.0 : 1.0, signs & 2 ? -1.0 : 1.0, 0};
      const double last = sign[0] * sign[1] * (o < 3 ? 1 : -1);  // a rotation
      for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) turned(r, c) = (c < 2 ? sign[c] : last) * start.frame(r, orders[o][c]);
      if (trace(turned) <= best + noise) continue;
      best = trace(turned);
      form.frame = turned;
      for (std::size_t c = 0; c < 3; ++c) box.size[c] = size[static_cast<std::size_t>(orders[o][c])];
    }
}

void turn_torus(Form& form, const TorusForm& torus) {
  if (is_whole(torus.angle)) return turn_segments(form, form.rings);
  if (torus.turn != 0) return;
  put_head_up(form, {std::cos(torus.angle / 2), 0, -std::sin(torus.angle / 2), std::numbers::pi});
}

/// -1, 0 or 1, as the first of two points differs from the second.
int compare(const Vec2& a, const Vec2& b, double slack) {
  for (std::size_t k = 0; k < 2; ++k)
    if (std::abs(a[k] - b[k]) > slack) return a[k] < b[k] ? -1 : 1;
  return 0;
}

/// Each ring from its least point on.
void start_rings(PrismForm& f, double slack) {
  std::size_t begin = 0;
  for (std::size_t end : f.ring_ends) {
    const auto first = f.points.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = f.points.begin() + static_cast<std::ptrdiff_t>(end);
    auto least = first;
    for (auto p = first; p != last; ++p)
      if (compare(*p, *least, slack) < 0) least = p;
    std::rotate(first, least, last);
    begin = end;
  }
}

/// Half a turn about Z. Rings go on running the same way around.
void turn_over(Form& form, PrismForm& f) {
  form.frame = form.frame * rotation_matrix({0, 0, 1, std::numbers::pi});
  std::swap(form.bottom, form.top);
  for (Vec2& p : f.points) p[0] = 0 - p[0];
  std::size_t begin = 0;
  for (std::size_t end : f.ring_ends) {
    std::reverse(f.points.begin() + static_cast<std::ptrdiff_t>(begin),
                 f.points.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
  }
}

void quarter_turn(Form& form, PrismForm& f) {
  form.frame = form.frame * turn_about_y(std::numbers::pi / 2);
  for (Vec2& p : f.points) p = {0 - p[1], p[0]};
}

/// By quarters and over, to the profile whose points come first; of equal profiles to the smallest rotation.
void turn_prism(Form& form) {
  Form best = form, turned = form;
  auto& f = std::get<PrismForm>(turned.shape);
  double size = 0;
  for (const Vec2& p : f.points) size = std::max({size, std::abs(p[0]), std::abs(p[1])});
  const double slack = noise * size;
  start_rings(std::get<PrismForm>(best.shape), slack);
  for (int i = 1; i < 8; ++i) {
    quarter_turn(turned, f);
    if (i == 4) turn_over(turned, f);
    start_rings(f, slack);
    const auto& known = std::get<PrismForm>(best.shape).points;
    int order = 0;
    for (std::size_t k = 0; k < known.size() && order == 0; ++k) order = compare(f.points[k], known[k], slack);
    if (order < 0 || (order == 0 && trace(turned.frame) > trace(best.frame) + noise)) best = turned;
  }
  form = std::move(best);
}

}  // namespace

void turn_upright(Form& form) {
  constexpr Vec4 about_z{0, 0, 1, std::numbers::pi};
  auto* box = std::get_if<BoxForm>(&form.shape);
  if (box && form.bottom && form.top) return turn_box(form, *box);
  if (const auto* torus = std::get_if<TorusForm>(&form.shape)) return turn_torus(form, *torus);
  if (std::holds_alternative<PrismForm>(form.shape)) return turn_prism(form);
  const auto* frustum = std::get_if<FrustumForm>(&form.shape);
  const bool even = std::holds_alternative<CylinderForm>(form.shape) || std::holds_alternative<RingForm>(form.shape) ||
                    std::holds_alternative<SphereForm>(form.shape);
  if (even) put_head_up(form, about_z);
  if (even || std::holds_alternative<DishForm>(form.shape) || (frustum && frustum->is_straight()))
    turn_segments(form, form.segments);
}

}  // namespace wrlkit
