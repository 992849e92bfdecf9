#include "passes/lower_x3d/nurbs.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/math/vec.h"

namespace wrlkit::x3d {
namespace {

constexpr std::size_t most_lines = 4096, most_points = 1 << 20;
constexpr int most_per_span = 256;

/// Many intervals are cut less each, so that the time is that of a few.
int most_chords(std::size_t intervals) {
  return std::clamp(static_cast<int>(most_lines / std::max<std::size_t>(intervals, 1)), 4, most_per_span);
}

bool usable(std::span<const double> knots, int order, std::size_t count) {
  return knots.size() == count + static_cast<std::size_t>(order) && std::ranges::is_sorted(knots) &&
         std::ranges::all_of(knots, [](double k) { return std::isfinite(k); }) &&
         knots[static_cast<std::size_t>(order) - 1] < knots[count];
}

/// The knot interval of a parameter: the last one that begins at or before it, and ends behind.
std::size_t interval(const Basis& b, double t) {
  const auto begin = b.knots.begin() + b.order - 1, end = b.knots.begin() + static_cast<std::ptrdiff_t>(b.count);
  auto i = std::upper_bound(begin, end + 1, t);
  if (t >= b.last()) i = std::lower_bound(begin, end + 1, b.last());
  return static_cast<std::size_t>(std::max(i, begin + 1) - b.knots.begin()) - 1;
}

double weight(std::span<const double> weights, std::size_t i) { return weights.empty() ? 1 : weights[i]; }

/// What is summed up: coordinates times weight, and weight.
struct Sum {
  Vec3 point{0, 0, 0};
  double weight = 0;
  void add(std::span<const double> points, std::size_t arity, std::size_t i, double w) {
    for (std::size_t k = 0; k < arity; ++k) point[k] += w * points[i * arity + k];
    weight += w;
  }
  Vec3 projected() const { return (1 / weight) * point; }
};

/// The intervals between different knots.
std::vector<double> breaks(const Basis& b) {
  std::vector<double> out;
  for (std::size_t i = static_cast<std::size_t>(b.order) - 1; i <= b.count; ++i)
    if (out.empty() || b.knots[i] > out.back()) out.push_back(b.knots[i]);
  return out;
}

/// Distance of a point from a line segment.
double away(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double l = dot(ab, ab), t = l > 0 ? std::clamp(dot(p - a, ab) / l, 0.0, 1.0) : 0;
  return length(p - (a + t * ab));
}

using Line = std::function<Vec3(double)>;

/// How far the curve is from n chords between two parameters.
double deviation(const Line& at, double from, double to, int n) {
  double most = 0;
  Vec3 a = at(from);
  for (int i = 0; i < n; ++i) {
    const double s = from + (to - from) * i / n, step = (to - from) / n;
    const Vec3 b = at(s + step);
    for (double part : {0.25, 0.5, 0.75}) most = std::max(most, away(at(s + part * step), a, b));
    a = b;
  }
  return most;
}

int chords(const Line& at, double from, double to, double tolerance, int most) {
  int n = 1;
  while (n < most && !(deviation(at, from, to, n) <= tolerance)) n *= 2;
  return n;
}

std::vector<double> spread(const std::vector<double>& ends, const std::vector<int>& parts) {
  std::vector<double> out{ends[0]};
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    for (int k = 1; k <= parts[i]; ++k)
      out.push_back(k == parts[i] ? ends[i + 1] : ends[i] + (ends[i + 1] - ends[i]) * k / parts[i]);
  return out;
}

/// As the author wants it: a number of pieces, or a number between two control points.
std::vector<double> asked_for(const Basis& b, int tessellation, std::size_t most) {
  const auto wanted = tessellation > 0
                          ? static_cast<std::size_t>(tessellation)
                          : static_cast<std::size_t>(-static_cast<std::int64_t>(tessellation)) * (b.count - 1);
  return spread({b.first(), b.last()}, {static_cast<int>(std::clamp<std::size_t>(wanted, 1, most))});
}

/// Not more than `most` pieces in all.
void limit(std::vector<int>& parts, std::size_t most) {
  auto sum = [&] {
    std::size_t n = 0;
    for (int p : parts) n += static_cast<std::size_t>(p);
    return n;
  };
  while (sum() > most && std::ranges::any_of(parts, [](int p) { return p > 1; }))
    for (int& p : parts) p = std::max(1, p / 2);
}

/// Parameters of the other direction at which a surface is looked at: the middles of its intervals and their ends, not
/// too many.
std::vector<double> probes(const Basis& b) {
  const auto ends = breaks(b);
  constexpr std::size_t most = 16;
  const std::size_t step = (ends.size() + most - 1) / most;
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < ends.size(); i += step) {
    out.push_back(ends[i]);
    out.push_back((ends[i] + ends[i + 1]) / 2);
  }
  out.push_back(ends.back());
  return out;
}

/// A surface along one parameter, at a value of the other.
Line line_of(const Surface& s, bool along_u, const BasisValues& other) {
  return [&s, along_u, &other](double t) {
    return along_u ? s.at(values_at(s.u, t), other) : s.at(other, values_at(s.v, t));
  };
}

std::vector<int> parts_along(const Surface& s, bool along_u, double tolerance) {
  const Basis &own = along_u ? s.u : s.v, &other = along_u ? s.v : s.u;
  const auto ends = breaks(own);
  std::vector<int> parts(ends.size() - 1, 1);
  for (double t : probes(other)) {
    const auto across = values_at(other, t);
    const Line line = line_of(s, along_u, across);
    for (std::size_t i = 0; i < parts.size(); ++i)
      parts[i] = std::max(parts[i], chords(line, ends[i], ends[i + 1], tolerance, most_chords(parts.size())));
  }
  return parts;
}

/// How far the two triangles of a cell are from what is between its four lines.
double twist(const Surface& s, const std::vector<double>& u, const std::vector<double>& v) {
  double most = 0;
  std::vector<Vec3> before, row(u.size());
  std::vector<BasisValues> along;
  along.reserve(u.size());
  for (double t : u) along.push_back(values_at(s.u, t));
  for (double t : v) {
    const auto across = values_at(s.v, t);
    for (std::size_t i = 0; i < u.size(); ++i) row[i] = s.at(along[i], across);
    for (std::size_t i = 1; i < u.size() && !before.empty(); ++i)
      most = std::max(most, length((before[i - 1] + row[i]) - (before[i] + row[i - 1])) / 4);
    before = row;
  }
  return most;
}

}  // namespace

std::optional<Basis> make_basis(int order, std::span<const double> knots, std::size_t count, bool& replaced) {
  if (order < 2 || order > highest_order || count < static_cast<std::size_t>(order)) return std::nullopt;
  Basis b{order, count, {knots.begin(), knots.end()}};
  if (usable(knots, order, count)) return b;
  replaced = true;
  b.knots.assign(static_cast<std::size_t>(order), 0);
  const std::size_t steps = count - static_cast<std::size_t>(order) + 1;
  for (std::size_t i = 1; i < steps; ++i) b.knots.push_back(static_cast<double>(i) / static_cast<double>(steps));
  b.knots.insert(b.knots.end(), static_cast<std::size_t>(order), 1);
  return b;
}

BasisValues values_at(const Basis& b, double t) {
  const auto order = static_cast<std::size_t>(b.order);
  t = std::clamp(t, b.first(), b.last());
  const std::size_t span = interval(b, t);
  BasisValues out{span + 1 - order, std::vector<double>(order, 0), std::vector<double>(order, 0)};
  auto& n = out.value;
  n[0] = 1;
  for (std::size_t k = 1; k < order; ++k) {
    const std::vector<double> lower = k + 1 == order ? n : std::vector<double>{};
    double saved = 0;
    for (std::size_t r = 0; r < k; ++r) {
      const double right = b.knots[span + r + 1], left = b.knots[span + 1 - k + r], part = n[r] / (right - left);
      n[r] = saved + (right - t) * part;
      saved = (t - left) * part;
    }
    n[k] = saved;
    if (lower.empty()) continue;
    for (std::size_t r = 0; r < k; ++r) {
      const double d = static_cast<double>(k) * lower[r] / (b.knots[span + r + 1] - b.knots[span + 1 - k + r]);
      out.slope[r] -= d;
      out.slope[r + 1] += d;
    }
  }
  return out;
}

Vec3 Curve::at(double t) const {
  const auto b = values_at(basis, t);
  Sum sum;
  for (std::size_t i = 0; i < b.value.size(); ++i)
    sum.add(points, arity, b.first + i, b.value[i] * weight(weights, b.first + i));
  return sum.projected();
}

Vec3 Surface::at(const BasisValues& a, const BasisValues& b) const {
  Sum sum;
  for (std::size_t j = 0; j < b.value.size(); ++j)
    for (std::size_t i = 0; i < a.value.size(); ++i) {
      const std::size_t k = (b.first + j) * u.count + a.first + i;
      sum.add(points, arity, k, a.value[i] * b.value[j] * weight(weights, k));
    }
  return sum.projected();
}

Vec3 Surface::across(double s, double t) const {
  const auto a = values_at(u, s), b = values_at(v, t);
  Sum point, along_u, along_v;
  for (std::size_t j = 0; j < b.value.size(); ++j)
    for (std::size_t i = 0; i < a.value.size(); ++i) {
      const std::size_t k = (b.first + j) * u.count + a.first + i;
      const double w = weight(weights, k);
      point.add(points, arity, k, a.value[i] * b.value[j] * w);
      along_u.add(points, arity, k, a.slope[i] * b.value[j] * w);
      along_v.add(points, arity, k, a.value[i] * b.slope[j] * w);
    }
  const Vec3 p = point.projected();
  return cross(along_u.point - along_u.weight * p, along_v.point - along_v.weight * p);
}

std::vector<double> cuts(const Curve& c, double tolerance, int tessellation) {
  if (tessellation != 0) return asked_for(c.basis, tessellation, most_lines);
  const auto ends = breaks(c.basis);
  std::vector<int> parts;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    parts.push_back(
        chords([&](double t) { return c.at(t); }, ends[i], ends[i + 1], tolerance, most_chords(ends.size() - 1)));
  limit(parts, std::max(most_lines, parts.size()));
  return spread(ends, parts);
}

Grid cuts(const Surface& s, double tolerance, int u_tessellation, int v_tessellation) {
  constexpr std::size_t most = 1024;
  auto u = parts_along(s, true, tolerance / 2), v = parts_along(s, false, tolerance / 2);
  for (;;) {
    Grid g{u_tessellation != 0 ? asked_for(s.u, u_tessellation, most) : spread(breaks(s.u), u),
           v_tessellation != 0 ? asked_for(s.v, v_tessellation, most) : spread(breaks(s.v), v)};
    const bool room = 4 * g.u.size() * g.v.size() <= most_points && *std::ranges::max_element(u) < most_per_span &&
                      *std::ranges::max_element(v) < most_per_span;
    if (g.u.size() * g.v.size() > most_points &&
        (std::ranges::any_of(u, [](int p) { return p > 1; }) || std::ranges::any_of(v, [](int p) { return p > 1; }))) {
      limit(u, g.u.size() / 2);
      limit(v, g.v.size() / 2);
      continue;
    }
    if (!room || (u_tessellation != 0 && v_tessellation != 0) || twist(s, g.u, g.v) <= tolerance / 2) return g;
    for (auto* parts : {&u, &v})
      for (int& p : *parts) p *= 2;
  }
}

}  // namespace wrlkit::x3d
