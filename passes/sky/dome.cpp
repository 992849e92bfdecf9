#include "passes/sky/dome.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wrlkit {
namespace {

using std::numbers::pi;
constexpr int segments = 48;
constexpr double widest = pi / 30;  // between two rings: glTF blends linear light, VRML what the screen shows

/// A ring of vertices of one colour, at an angle from straight up. Two at one angle are a sharp edge.
struct Ring {
  double angle;
  Vec3 color;
};

Vec3 color_at(const Gradient& g, std::size_t i) { return {g.color[3 * i], g.color[3 * i + 1], g.color[3 * i + 2]}; }

/// Angles of a gradient between two limits, both of them included, none of them far from the next.
std::vector<double> angles_between(const Gradient& g, double from, double to) {
  std::vector<double> out{from};
  const auto reach = [&](double next) {
    const double start = out.back();
    const int steps = std::max(1, static_cast<int>(std::ceil((next - start) / widest)));
    for (int i = 1; i <= steps; ++i) out.push_back(start + (next - start) * i / steps);
  };
  for (std::size_t i = 0; i + 1 < g.size(); ++i)
    if (g.angle[i] > out.back() && g.angle[i] < to) reach(g.angle[i]);
  if (to > out.back()) reach(to);
  return out;
}

std::vector<Ring> rings(const Gradient& sky, const Gradient& ground) {
  const double ground_top = pi - (ground.empty() ? 0 : ground.last_angle());
  std::vector<Ring> out;
  for (double a : angles_between(sky, 0, ground_top)) out.push_back({a, sky.at(a)});
  if (ground_top == pi) return out;
  auto up = angles_between(ground, 0, pi - ground_top);
  std::ranges::reverse(up);
  for (double a : up) out.push_back({pi - a, ground.at(a)});
  return out;
}

void add_ring(const Ring& ring, Dome& out) {
  for (int i = 0; i < segments; ++i) {
    const double turn = 2 * pi * i / segments, across = std::sin(ring.angle);
    for (double v : {across * std::sin(turn), std::cos(ring.angle), across * std::cos(turn)}) out.points.push_back(v);
    out.colors.insert(out.colors.end(), ring.color.begin(), ring.color.end());
  }
}

void add_triangle(Dome& out, int a, int b, int c) {
  for (int corner : {a, b, c, -1}) out.corners.push_back(corner);
}

}  // namespace

std::size_t Gradient::size() const { return empty() ? 0 : std::min(color.size() / 3, angle.size() + 1); }

double Gradient::last_angle() const { return size() > 1 ? std::clamp(angle[size() - 2], 0.0, pi) : 0; }

Vec3 Gradient::at(double a) const {
  if (empty()) return {0, 0, 0};
  std::size_t i = 0;
  while (i + 1 < size() && angle[i] <= a) ++i;
  if (i + 1 == size()) return color_at(*this, i);
  const double from = i == 0 ? 0 : angle[i - 1];
  const double part = angle[i] > from ? std::clamp((a - from) / (angle[i] - from), 0.0, 1.0) : 1;
  const Vec3 low = color_at(*this, i), high = color_at(*this, i + 1);
  Vec3 out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = low[k] + part * (high[k] - low[k]);
  return out;
}

Dome make_dome(const Gradient& sky, const Gradient& ground) {
  Dome out;
  const auto all = rings(sky, ground);
  for (const Ring& r : all) add_ring(r, out);
  for (int r = 0; r + 1 < static_cast<int>(all.size()); ++r) {
    if (all[r].angle == all[r + 1].angle) continue;
    for (int i = 0; i < segments; ++i) {
      const int next = (i + 1) % segments, upper = r * segments, lower = upper + segments;
      if (all[r].angle > 0) add_triangle(out, upper + i, upper + next, lower + i);
      if (all[r + 1].angle < pi) add_triangle(out, upper + next, lower + next, lower + i);
    }
  }
  return out;
}

}  // namespace wrlkit
