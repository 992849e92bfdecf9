// Fits of what has flat walls.
#include <algorithm>
#include <limits>

#include "geometry/forms/cut.h"
#include "geometry/polygon.h"
#include "geometry/recognise/fits.h"
#include "geometry/recognise/frame.h"

namespace wrlkit::recognising {
namespace {

using std::numbers::pi;
constexpr double crease = 0.5;  // radians: walls of a prism that are flatter to each other are smooth

double cross2(const Vec2& a, const Vec2& b) { return a[0] * b[1] - a[1] * b[0]; }
Vec2 minus(const Vec2& a, const Vec2& b) { return {a[0] - b[0], a[1] - b[1]}; }
double length2(const Vec2& a) { return std::hypot(a[0], a[1]); }

/// The walls of a prism: where its rings lie, and its profile in X and Z of a frame along Y.
struct Extruded {
  Matrix frame;
  double height = 0;
  std::vector<std::vector<Vec2>> profiles;  // by loop and column
  int turn = 1;                             // of the first loop: 1 when it runs anticlockwise around Y
  double residual = 0;
};

Vec2 in_frame(const Matrix& m, const Vec3& p) {
  const Vec3 q = p - Vec3{m(0, 3), m(1, 3), m(2, 3)};
  return {q[0] * m(0, 0) + q[1] * m(1, 0) + q[2] * m(2, 0), q[0] * m(0, 2) + q[1] * m(1, 2) + q[2] * m(2, 2)};
}

/// The area of a polygon, as a vector that its corners run around; its length is twice the area.
Vec3 area_of(const Ring& r) {
  Vec3 out{};
  for (std::size_t c = 0; c < r.at.size(); ++c)
    out = out + cross(r.at[c] - r.centre, r.at[(c + 1) % r.at.size()] - r.centre);
  return out;
}

Vec3 longest_edge(const Ring& r) {
  Vec3 best{};
  for (std::size_t c = 0; c < r.at.size(); ++c) {
    const Vec3 e = r.at[(c + 1) % r.at.size()] - r.at[c];
    if (dot(e, e) > dot(best, best) * 1.000001) best = e;
  }
  return best;
}

/// One direction from every low point to the high one, across the plane of the rings; between[i] lie on the walls.
std::optional<Extruded> extrude(std::span<const Ring> low, std::span<const Ring> high, std::span<const Ring> between,
                                double tolerance) {
  Extruded out;
  const Vec3 along = high[0].centre - low[0].centre;
  const Vec3 normals = area_of(low[0]) + area_of(high[0]);
  Vec3 y = unit(dot(normals, along) < 0 ? -1.0 * normals : normals);
  out.turn = dot(normals, along) < 0 ? -1 : 1;
  if (dot(along, along) * 4 > length(normals)) y = unit(along);
  out.height = dot(along, y);
  const Vec3 x = unit(perpendicular(longest_edge(low[0]), y));
  if (length(y) == 0 || length(x) == 0 || !(out.height > 0)) return std::nullopt;
  out.frame = frame_of(0.5 * (low[0].centre + high[0].centre), y, cross(x, y));
  for (std::size_t k = 0; k < low.size(); ++k) {
    auto& profile = out.profiles.emplace_back();
    if (low[k].at.size() != high[k].at.size()) return std::nullopt;
    for (std::size_t c = 0; c < low[k].at.size(); ++c) {
      const Vec2 a = in_frame(out.frame, low[k].at[c]), b = in_frame(out.frame, high[k].at[c]);
      profile.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2});
      for (bool top : {false, true}) {
        const Vec3 there = out.frame.point({profile[c][0], (top ? 0.5 : -0.5) * out.height, profile[c][1]});
        out.residual = std::max(out.residual, length(there - (top ? high : low)[k].at[c]));
      }
    }
  }
  for (const Ring& r : between)
    for (std::size_t c = 0; c < r.at.size(); ++c)
      out.residual = std::max(out.residual, length2(minus(in_frame(out.frame, r.at[c]), out.profiles[0][c])));
  if (out.residual > tolerance) return std::nullopt;
  return out;
}

/// Without the points in the middle of straight walls, anticlockwise seen from +Y (Z points down).
std::vector<Vec2> corners_of(std::vector<Vec2> p, bool reversed, double tolerance) {
  if (reversed) std::ranges::reverse(p);
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 &before = out.empty() ? p.back() : out.back(), &after = p[(i + 1) % p.size()];
    const Vec2 edge = minus(after, before), here = minus(p[i], before);
    const double l = length2(edge);
    const bool middle = l > 0 && std::abs(cross2(edge, here)) <= tolerance * l &&
                        edge[0] * here[0] + edge[1] * here[1] > 0 && length2(here) < l;
    if (!middle) out.push_back(p[i]);
  }
  return out;
}

/// The largest distance of points of rings from the points of a RingForm: outer low, outer high, inner low, inner high.
double farthest_point(const Form& form, std::span<const Ring> low, std::span<const Ring> high) {
  Mesh mesh;
  tessellate_form(form, {}, mesh);
  double worst = 0;
  const std::size_t n = low[0].at.size();
  for (std::size_t k = 0; k < 4; ++k)
    for (const Vec3& p : (k % 2 ? high : low)[k / 2].at) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = k * n; i < (k + 1) * n; ++i) {
        const double* q = mesh.positions.data() + 3 * i;
        nearest = std::min(nearest, length(p - Vec3{q[0], q[1], q[2]}));
      }
      worst = std::max(worst, nearest);
    }
  return worst;
}

std::optional<Fit> as_box(const Extruded& e, const std::vector<Vec2>& p, double tolerance) {
  if (p.size() != 4) return std::nullopt;
  const Vec2 a = minus(p[1], p[0]), b = minus(p[2], p[3]), c = minus(p[3], p[0]), d = minus(p[2], p[1]);
  const Vec2 first{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2}, second{(c[0] + d[0]) / 2, (c[1] + d[1]) / 2};
  const double w = length2(first), depth = length2(second);
  if (!(w > 0) || !(depth > 0)) return std::nullopt;
  const Vec2 u{first[0] / w, first[1] / w};
  Vec2 v{-u[1], u[0]};
  if (v[0] * second[0] + v[1] * second[1] < 0) v = {-v[0], -v[1]};
  Vec2 centre{};
  for (const Vec2& q : p) centre = {centre[0] + q[0] / 4, centre[1] + q[1] / 4};
  double worst = 0;
  const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    const double s = signs[i][0] * w / 2, t = signs[i][1] * depth / 2;
    const Vec2 there{centre[0] + s * u[0] + t * v[0], centre[1] + s * u[1] + t * v[1]};
    worst = std::max(worst, length2(minus(there, p[i])));
  }
  if (worst > tolerance) return std::nullopt;
  const Matrix& m = e.frame;
  const Vec3 y{m(0, 1), m(1, 1), m(2, 1)}, x3{m(0, 0), m(1, 0), m(2, 0)}, z3{m(0, 2), m(1, 2), m(2, 2)};
  Form form;
  const Vec3 x = u[0] * x3 + u[1] * z3;
  form.frame = frame_of(m.point({centre[0], 0, centre[1]}), y, cross(x, y));
  form.shape = BoxForm{{w, e.height, depth}};
  return Fit{std::move(form), e.residual + worst, e.turn > 0};
}

/// m + 1 points on an outer arc, and as many back on an inner one.
struct Sector {
  Vec2 centre{};
  double inner = 0, outer = 0, begin = 0, angle = 0, residual = 0;
  std::size_t n = 0;
};

std::optional<Sector> sector_at(const std::vector<Vec2>& p, std::size_t s, double tolerance) {
  const std::size_t half = p.size() / 2;
  auto out_at = [&](std::size_t k) { return p[(s + k) % p.size()]; };
  auto in_at = [&](std::size_t k) { return p[(s + p.size() - 1 - k) % p.size()]; };
  const Vec2 a = out_at(0), b = out_at(half / 2), c = out_at(half - 1);
  const Vec2 ab = minus(b, a), ac = minus(c, a);
  const double det = 2 * cross2(ab, ac), l1 = ab[0] * ab[0] + ab[1] * ab[1], l2 = ac[0] * ac[0] + ac[1] * ac[1];
  if (std::abs(det) < 1e-12 * (l1 + l2)) return std::nullopt;
  Sector f;
  f.centre = {a[0] + (ac[1] * l1 - ab[1] * l2) / det, a[1] + (ab[0] * l2 - ac[0] * l1) / det};
  f.n = half - 1;
  for (std::size_t k = 0; k < half; ++k) {
    f.outer += length2(minus(out_at(k), f.centre)) / static_cast<double>(half);
    f.inner += length2(minus(in_at(k), f.centre)) / static_cast<double>(half);
  }
  if (!(f.outer > f.inner)) return std::nullopt;
  const Vec2 first = minus(out_at(0), f.centre);
  f.begin = std::atan2(-first[1], first[0]);
  for (std::size_t k = 1; k < half; ++k) {
    const Vec2 q = minus(out_at(k - 1), f.centre), r = minus(out_at(k), f.centre);
    f.angle += std::atan2(-cross2(q, r), q[0] * r[0] + q[1] * r[1]);
  }
  if (!(f.angle > 0) || f.angle > 2 * pi + 1e-6) return std::nullopt;
  for (std::size_t k = 0; k < half; ++k) {
    const double t = f.begin + f.angle * static_cast<double>(k) / static_cast<double>(f.n);
    const Vec2 direction{std::cos(t), -std::sin(t)};
    for (bool outside : {true, false}) {
      const double r = outside ? f.outer : f.inner;
      const Vec2 there{f.centre[0] + r * direction[0], f.centre[1] + r * direction[1]};
      f.residual = std::max(f.residual, length2(minus(there, outside ? out_at(k) : in_at(k))));
      if (f.residual > tolerance) return std::nullopt;
    }
  }
  return f;
}

std::optional<Fit> as_sector(const Extruded& e, const std::vector<Vec2>& p, double tolerance, bool capped) {
  if (p.size() < 6 || p.size() % 2) return std::nullopt;
  for (std::size_t s = 0; s < p.size(); ++s) {
    const auto f = sector_at(p, s, tolerance);
    if (!f) continue;
    const Matrix& m = e.frame;
    const Vec3 y{m(0, 1), m(1, 1), m(2, 1)}, x3{m(0, 0), m(1, 0), m(2, 0)}, z3{m(0, 2), m(1, 2), m(2, 2)};
    const Vec3 x = std::cos(f->begin) * x3 - std::sin(f->begin) * z3;
    Form form;
    form.frame = frame_of(m.point({f->centre[0], 0, f->centre[1]}), y, cross(x, y));
    form.shape = RectangularTorusForm{f->inner, f->outer, e.height, f->angle};
    form.segments = static_cast<int>(f->n);
    form.bottom = form.top = capped;
    return Fit{std::move(form), e.residual + f->residual, e.turn > 0};
  }
  return std::nullopt;
}

/// Its caps could be cut in other ways than they were.
bool crosses_itself(const PrismForm& f) {
  PolygonCutter cutter;
  return cutter.cut(f.points, f.ring_ends).crossing;
}

}  // namespace

std::optional<Fit> fit_prism(std::span<const Ring> rings, const Tolerances& tolerances) {
  if (rings.front().apex || rings.back().apex) return std::nullopt;
  const double tolerance = tolerances.flat();
  const auto e = extrude(rings.first(1), rings.last(1), rings, tolerance);
  if (!e) return std::nullopt;
  auto profile = corners_of(e->profiles[0], e->turn < 0, tolerance / 2);
  if (profile.size() < 3) return std::nullopt;
  if (auto box = as_box(*e, profile, tolerance)) return box;
  if (auto sector = as_sector(*e, profile, tolerance, true)) return sector;
  const double left_out = e->profiles[0].size() > profile.size() ? tolerance / 2 : 0;
  Form form;
  form.frame = e->frame;
  PrismForm f{std::move(profile), {}, e->height, crease};
  f.ring_ends = {static_cast<std::uint32_t>(f.points.size())};
  if (crosses_itself(f)) return std::nullopt;
  form.shape = std::move(f);
  return Fit{std::move(form), e->residual + left_out, e->turn > 0};
}

bool become_square_bar(Form& form, const Vec3& axis, double tolerance) {
  const auto* box = std::get_if<BoxForm>(&form.shape);
  if (!box) return false;
  const Matrix& m = form.frame;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    auto direction = [&](std::size_t c) {
      const int column = static_cast<int>(c);
      return Vec3{m(0, column), m(1, column), m(2, column)};
    };
    if (std::abs(dot(direction(k), axis)) < 0.9 || std::abs(box->size[a] - box->size[b]) > tolerance) continue;
    const CylinderForm bar{(box->size[a] + box->size[b]) / 2 / std::numbers::sqrt2, box->size[k]};
    form.frame = frame_of({m(0, 3), m(1, 3), m(2, 3)}, direction(k), unit(direction(a) + direction(b)));
    form.shape = bar;
    form.segments = 4;
    return true;
  }
  return false;
}

std::optional<Fit> fit_pyramid(std::span<const Ring> rings, const Tolerances& tolerances) {
  if (rings.size() != 2 || rings[0].at.size() != 4 || rings[0].apex) return std::nullopt;
  const Ring &low = rings[0], &high = rings[1];
  const double tolerance = tolerances.flat();
  Vec3 y = unit(area_of(low) + (high.apex ? Vec3{} : area_of(high)));
  const int turn = dot(y, high.centre - low.centre) < 0 ? -1 : 1;
  if (turn < 0) y = -1.0 * y;
  const Vec3 x = unit(perpendicular(low.at[1] - low.at[0] + low.at[2] - low.at[3], y)), z = cross(x, y);
  const Vec3 between = high.centre - low.centre;
  PyramidForm f;
  f.height = dot(between, y);
  f.offset = {dot(between, x), dot(between, z)};
  if (!(f.height > 0)) return std::nullopt;
  double worst = 0;
  for (bool top : {false, true}) {
    const Ring& r = top ? high : low;
    Vec2& size = top ? f.top : f.bottom;
    size = {dot(r.at[1] - r.at[0] + r.at[2] - r.at[3], x) / 2, dot(r.at[3] - r.at[0] + r.at[2] - r.at[1], z) / 2};
    for (std::size_t c = 0; c < 4; ++c) {
      const double s = c == 1 || c == 2 ? 0.5 : -0.5, t = c >= 2 ? 0.5 : -0.5;
      worst = std::max(worst, length(r.at[c] - (r.centre + (s * size[0]) * x + (t * size[1]) * z)));
    }
    if (size[0] < -tolerance) return std::nullopt;
    size = {std::abs(size[0]), std::abs(size[1])};
  }
  if (worst > tolerance) return std::nullopt;
  Form form;
  form.frame = frame_of(0.5 * (low.centre + high.centre), y, z);
  form.shape = f;
  return Fit{std::move(form), worst, turn > 0};
}

std::optional<Fit> fit_hollow(std::span<const Ring> low, std::span<const Ring> high, const Tolerances& tolerances) {
  const double tolerance = low[0].round ? tolerances.round(low[0].radius, low[0].at.size()) : tolerances.flat();
  const auto e = extrude(low, high, {}, tolerance);
  if (!e) return std::nullopt;
  Form form;
  if (low.size() == 2 && low[0].at.size() > 4 && low[0].round && low[1].round && low[0].at.size() == low[1].at.size() &&
      length(perpendicular(low[0].centre - low[1].centre, low[0].normal)) <= tolerance) {
    const Matrix& m = e->frame;
    const Vec3 y{m(0, 1), m(1, 1), m(2, 1)};
    Vec3 firsts[2];
    for (std::size_t k = 0; k < 2; ++k) {
      Phase phase(y, dot(low[k].normal, y) > 0 ? 1 : -1);
      phase.add(low[k].at, low[k].centre);
      phase.add(high[k].at, high[k].centre);
      firsts[k] = phase.first();
    }
    // The inner ring may begin at another point: what counts is the place of the points, modulo one step.
    const double steps = std::atan2(dot(cross(firsts[0], firsts[1]), y), dot(firsts[0], firsts[1])) / (2 * pi) *
                         static_cast<double>(low[0].at.size());
    if (std::abs(steps - std::round(steps)) * 2 * pi / static_cast<double>(low[0].at.size()) * low[1].radius <=
        tolerance) {
      form.frame = frame_of(0.5 * (low[0].centre + high[0].centre), y, -1.0 * firsts[0]);
      form.shape = RingForm{(low[1].radius + high[1].radius) / 2, (low[0].radius + high[0].radius) / 2, e->height};
      form.segments = static_cast<int>(low[0].at.size());
      const double residual = farthest_point(form, low, high);
      if (residual <= tolerance) return Fit{std::move(form), residual, e->turn > 0};
    }
  }
  PrismForm f{{}, {}, e->height, crease};
  for (const auto& profile : e->profiles) {
    const auto corners = corners_of(profile, e->turn < 0, tolerances.flat() / 2);
    if (corners.size() < 3) return std::nullopt;
    f.points.insert(f.points.end(), corners.begin(), corners.end());
    f.ring_ends.push_back(static_cast<std::uint32_t>(f.points.size()));
  }
  if (crosses_itself(f)) return std::nullopt;
  form.frame = e->frame;
  form.shape = std::move(f);
  return Fit{std::move(form), e->residual, e->turn > 0};
}

}  // namespace wrlkit::recognising
