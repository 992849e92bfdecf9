// Fits of what has round sections.
#include <algorithm>

#include "geometry/forms/cut.h"
#include "geometry/recognise/fits.h"
#include "geometry/recognise/frame.h"

namespace wrlkit::recognising {
namespace {

using std::numbers::pi;

/// Points of a form as tessellate_form makes them, ring by ring.
class Points {
 public:
  explicit Points(const Form& form) { tessellate_form(form, {}, mesh_); }
  Vec3 operator[](std::size_t i) const {
    const double* p = mesh_.positions.data() + 3 * i;
    return {p[0], p[1], p[2]};
  }
  std::size_t size() const { return mesh_.n_positions(); }

 private:
  Mesh mesh_;
};

/// Where column c is in a form whose columns run the other way.
std::size_t column(std::size_t c, int turn, std::size_t n) { return turn > 0 ? c : (n - c) % n; }

struct Axis {
  Vec3 y{};
  int turn = 1;
};

/// The axis of rings around it: from the first to the last of them. Long runs by their middles, short ones by their
/// planes.
Axis axis_of(std::span<const Ring> rings) {
  const Vec3 along = rings.back().centre - rings.front().centre;
  Vec3 normals{};
  double radius = 0;
  for (const Ring& r : rings) {
    normals = normals + (r.radius * r.radius) * r.normal;
    radius = std::max(radius, r.radius);
  }
  normals = unit(normals);
  const bool against = dot(normals, along) < 0;
  const Vec3 planes = against ? -1.0 * normals : normals;
  const Vec3 y = length(along) > 2 * radius ? unit(along) : planes;
  return {y, against ? -1 : 1};
}

double mean_radius(const Ring& r, const Vec3& y) {
  double sum = 0;
  for (const Vec3& p : r.at) sum += length(perpendicular(p - r.centre, y));
  return sum / static_cast<double>(r.at.size());
}

double worst_radius(std::span<const Ring> rings) {
  double out = 0;
  for (const Ring& r : rings) out = std::max(out, r.radius);
  return out;
}

bool all_round(std::span<const Ring> rings) {
  return std::ranges::all_of(rings, [](const Ring& r) { return r.round; });
}

/// The residual of rings that lie between the ends of straight walls.
std::optional<double> straight_residual(const Form& form, std::span<const Ring> rings, int turn, double tolerance) {
  const Points points(form);
  const std::size_t n = rings[0].at.size();
  const bool below = rings.front().apex, above = rings.back().apex;
  auto low = [&](std::size_t c) { return below ? points[0] : points[column(c, turn, n)]; };
  auto high = [&](std::size_t c) {
    return above ? points[points.size() - 1] : points[(below ? 1 : n) + column(c, turn, n)];
  };
  double worst = 0;
  for (const Ring& ring : rings)
    for (std::size_t c = 0; c < n; ++c) {
      const Vec3 a = low(c), edge = high(c) - a;
      double t = dot(ring.at[c] - a, edge) / std::max(dot(edge, edge), 1e-300);
      t = &ring == &rings.front() ? 0 : &ring == &rings.back() ? 1 : std::clamp(t, 0.0, 1.0);
      worst = std::max(worst, length(ring.at[c] - (a + t * edge)));
      if (worst > tolerance) return std::nullopt;
    }
  return worst;
}

std::optional<Fit> straight_fit(Form form, std::span<const Ring> rings, int turn, double tolerance) {
  const auto residual = straight_residual(form, rings, turn, tolerance);
  if (!residual) return std::nullopt;
  return Fit{std::move(form), *residual, turn > 0};
}

/// Every ring against that of the form with the same number.
std::optional<double> ring_residual(const Form& form, std::span<const Ring> rings, int turn, std::size_t points_before,
                                    double tolerance) {
  const Points points(form);
  const std::size_t n = rings[0].at.size();
  double worst = 0;
  std::size_t at = points_before;
  for (const Ring& ring : rings) {
    for (std::size_t c = 0; c < (ring.apex ? 1 : n); ++c) {
      const std::size_t i = ring.apex ? at : at + column(c, turn, n);
      if (i >= points.size()) return std::nullopt;
      worst = std::max(worst, length(ring.at[c] - points[i]));
      if (worst > tolerance) return std::nullopt;
    }
    at += ring.apex ? 1 : n;
  }
  return worst;
}

bool is_same_size(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }

/// The point from which the middles of rings are equally far, and to which their planes lead.
bool bend_centre(std::span<const Ring> rings, const Vec3& u, const Vec3& w, Vec3& out) {
  double a = 0, b = 0, c = 0, d = 0, e = 0;
  const Vec3& origin = rings[0].centre;
  auto equation = [&](const Vec3& direction, double value) {
    const double x = dot(direction, u), y = dot(direction, w);
    a += x * x;
    b += x * y;
    c += y * y;
    d += x * value;
    e += y * value;
  };
  const Ring &first = rings.front(), &last = rings.back(), &middle = rings[rings.size() / 2];
  const double chord = length(last.centre - first.centre);
  for (const Ring* r : {&first, &last, &middle})
    equation(chord * r->normal, chord * dot(r->normal, r->centre - origin));
  for (auto [p, q] : {std::pair{&first, &last}, std::pair{&first, &middle}, std::pair{&middle, &last}}) {
    const Vec3 along = q->centre - p->centre;
    equation(along, dot(along, 0.5 * (p->centre + q->centre) - origin));
  }
  const double det = a * c - b * b;
  if (!(std::abs(det) > 1e-12 * (a + c) * (a + c))) return false;
  out = origin + ((d * c - e * b) / det) * u + ((a * e - b * d) / det) * w;
  return true;
}

}  // namespace

double Tolerances::round(double radius, std::size_t n) const {
  if (given > 0) return given;
  const double chord = 2 * radius * std::pow(std::sin(pi / (2 * static_cast<double>(n))), 2);
  return std::max(2.5 * step, std::min(0.25 * chord, 0.002 * radius)) + 1e-6 * size;
}

double Tolerances::flat() const { return given > 0 ? given : 2.5 * step + 1e-6 * size; }

Ring apex_of(const Vec3& point, std::size_t n) {
  Ring out;
  out.at.assign(n, point);
  out.centre = point;
  out.apex = out.round = true;
  return out;
}

Ring ring_of(std::vector<Vec3> points, const Tolerances& tolerances) {
  Ring out;
  out.at = std::move(points);
  const std::size_t n = out.at.size();
  for (const Vec3& p : out.at) out.centre = out.centre + (1.0 / static_cast<double>(n)) * p;
  for (std::size_t c = 0; c < n; ++c)
    out.normal = out.normal + cross(out.at[c] - out.centre, out.at[(c + 1) % n] - out.centre);
  out.normal = unit(out.normal);
  out.radius = mean_radius(out, out.normal);
  Phase phase(out.normal, 1);
  phase.add(out.at, out.centre);
  const Vec3 u = phase.first(), w = cross(out.normal, u);
  const double tolerance = tolerances.round(out.radius, n);
  out.round = out.radius > 0;
  for (std::size_t c = 0; c < n && out.round; ++c) {
    const double a = 2 * pi * static_cast<double>(c) / static_cast<double>(n);
    const Vec3 there = out.centre + out.radius * (std::cos(a) * u + std::sin(a) * w);
    out.round = length(out.at[c] - there) <= tolerance;
  }
  return out;
}

std::optional<Fit> fit_straight(std::span<const Ring> rings, const Tolerances& tolerances) {
  if (!all_round(rings)) return std::nullopt;
  const auto [y, turn] = axis_of(rings);
  const Ring &low = rings.front(), &high = rings.back();
  const double tolerance = tolerances.round(worst_radius(rings), low.at.size());
  Phase phase(y, turn);
  for (const Ring* r : {&low, &high}) phase.add(r->at, r->centre);
  const Vec3 between = high.centre - low.centre;
  Form form;
  form.frame = frame_of(0.5 * (low.centre + high.centre), y, -1.0 * phase.first());
  form.segments = static_cast<int>(low.at.size());
  const double height = dot(between, y), a = low.apex ? 0 : mean_radius(low, y),
               b = high.apex ? 0 : mean_radius(high, y);
  if (a + b == 0) return std::nullopt;
  if (is_same_size(a, b, std::max(tolerances.step, 1e-6 * tolerances.size)) && height > 0)
    form.shape = CylinderForm{(a + b) / 2, height};
  else
    form.shape = FrustumForm{a, b, std::abs(height) < tolerances.step ? 0 : height, {}, {}, {}};
  return straight_fit(std::move(form), rings, turn, tolerance);
}

std::optional<Fit> fit_slanted(std::span<const Ring> rings, const Tolerances& tolerances) {
  const Ring &low = rings.front(), &high = rings.back();
  if (low.apex || high.apex) return std::nullopt;
  const std::size_t n = low.at.size();
  const Vec3 y = unit(high.centre - low.centre);
  if (length(y) == 0) return std::nullopt;
  std::vector<Vec3> flat;
  for (std::size_t c = 0; c < n; ++c) flat.push_back(perpendicular(low.at[c] - low.centre, y));
  const Ring across = ring_of(flat, tolerances);
  if (!across.round) return std::nullopt;
  const int turn = dot(across.normal, y) > 0 ? 1 : -1;
  Phase phase(y, turn);
  phase.add(across.at, across.centre);
  Form form;
  form.frame = frame_of(0.5 * (low.centre + high.centre), y, -1.0 * phase.first());
  form.segments = static_cast<int>(n);
  const Vec3 z = -1.0 * phase.first(), x = cross(y, z);
  FrustumForm f{across.radius, across.radius, dot(high.centre - low.centre, y), {}, {}, {}};
  for (int end = 0; end < 2; ++end) {
    const Vec3& normal = (end ? high : low).normal;
    const double up = dot(normal, y);
    if (std::abs(up) < 0.05) return std::nullopt;
    (end ? f.top_slope : f.bottom_slope) = {-dot(normal, x) / up, -dot(normal, z) / up};
  }
  form.shape = f;
  return straight_fit(std::move(form), rings, turn, tolerances.round(across.radius, n));
}

std::optional<Fit> fit_eccentric(std::span<const Ring> rings, const Tolerances& tolerances) {
  if (!all_round(rings)) return std::nullopt;
  const Ring &low = rings.front(), &high = rings.back();
  Vec3 y = unit((low.radius * low.radius) * low.normal + (high.radius * high.radius) * high.normal);
  int turn = 1;
  if (dot(y, high.centre - low.centre) < 0) {
    y = -1.0 * y;
    turn = -1;
  }
  Phase phase(y, turn);
  for (const Ring* r : {&low, &high}) phase.add(r->at, r->centre);
  Form form;
  const Vec3 z = -1.0 * phase.first(), x = cross(y, z), between = high.centre - low.centre;
  form.frame = frame_of(0.5 * (low.centre + high.centre), y, z);
  form.segments = static_cast<int>(low.at.size());
  form.shape = FrustumForm{low.apex ? 0 : mean_radius(low, y),
                           high.apex ? 0 : mean_radius(high, y),
                           dot(between, y),
                           {dot(between, x), dot(between, z)},
                           {},
                           {}};
  return straight_fit(std::move(form), rings, turn, tolerances.round(worst_radius(rings), low.at.size()));
}

std::optional<Fit> fit_torus(std::span<const Ring> rings, bool whole, const Tolerances& tolerances) {
  if (rings.size() < 2 || !all_round(rings) || rings.front().apex || rings.back().apex) return std::nullopt;
  const std::size_t n = rings[0].at.size();
  Vec3 y{};
  double radius = 0;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    radius += rings[k].radius / static_cast<double>(rings.size());
    if (k > 0) y = y + cross(rings[k - 1].normal, rings[k].normal);
  }
  if (length(y) < 1e-6) return std::nullopt;
  y = unit(y);
  Vec3 centre;
  const Vec3 u = any_perpendicular(y), w = cross(y, u);
  if (!bend_centre(rings, u, w, centre)) return std::nullopt;
  double height = 0, bend = 0;
  for (const Ring& r : rings) height += dot(r.centre - centre, y) / static_cast<double>(rings.size());
  centre = centre + height * y;
  for (const Ring& r : rings) bend += length(perpendicular(r.centre - centre, y)) / static_cast<double>(rings.size());
  double angle = 0;
  for (std::size_t k = 1; k < rings.size(); ++k) {
    const Vec3 a = rings[k - 1].centre - centre, b = rings[k].centre - centre;
    angle += std::atan2(dot(cross(a, b), y), dot(a, b));
  }
  if (angle < 0) return std::nullopt;
  if (whole) angle *= static_cast<double>(rings.size()) / static_cast<double>(rings.size() - 1);
  const Vec3 x = unit(perpendicular(rings[0].centre - centre, y));
  // On the section of ring 0 the angle runs from X to Y, which is around -Z.
  const int turn = dot(rings[0].normal, cross(x, y)) > 0 ? 1 : -1;
  Phase phase(cross(x, y), turn);
  phase.add(rings[0].at, rings[0].centre);
  Form form;
  form.frame = frame_of(centre, y, cross(x, y));
  form.segments = static_cast<int>(n);
  form.rings = static_cast<int>(rings.size()) - (whole ? 0 : 1);
  const Vec3 first = phase.first();
  form.shape = TorusForm{bend, radius, whole ? 2 * pi : angle, std::atan2(dot(first, y), dot(first, x))};
  const double tolerance =
      tolerances.round(radius, n) +
      tolerances.round(bend, static_cast<std::size_t>(std::max(3.0, 2 * pi / angle * form.rings))) / 4;
  const auto residual = ring_residual(form, rings, turn, 0, tolerance);
  if (!residual) return std::nullopt;
  return Fit{std::move(form), *residual, turn < 0};
}

std::optional<Fit> fit_dish(std::span<const Ring> rings, const Tolerances& tolerances) {
  if (rings.size() < 3 || !all_round(rings) || !rings.back().apex || rings.front().apex) return std::nullopt;
  const auto [y, turn] = axis_of(rings);
  const Ring& rim = rings.front();
  Phase phase(y, turn);
  for (const Ring& r : rings) phase.add(r.at, r.centre);
  Form form;
  form.frame = frame_of(rim.centre, y, -1.0 * phase.first());
  form.segments = static_cast<int>(rim.at.size());
  form.rings = static_cast<int>(rings.size()) - 1;
  const double height = dot(rings.back().centre - rim.centre, y);
  if (!(height > 0)) return std::nullopt;
  std::optional<Fit> best;
  for (bool spherical : {false, true}) {
    const DishForm f{mean_radius(rim, y), height, spherical};
    form.shape = f;
    const double tolerance = tolerances.round(spherical ? sphere_radius(f) : f.radius, rim.at.size());
    const auto residual = ring_residual(form, rings, turn, 0, tolerance);
    if (residual && (!best || *residual < 0.9 * best->residual)) best = Fit{form, *residual, turn > 0};
  }
  return best;
}

std::optional<Fit> fit_sphere(std::span<const Ring> rings, const Tolerances& tolerances) {
  if (rings.size() < 3 || !all_round(rings) || !rings.front().apex || !rings.back().apex) return std::nullopt;
  const auto [y, turn] = axis_of(rings);
  Phase phase(y, turn);
  for (const Ring& r : rings) phase.add(r.at, r.centre);
  Form form;
  form.frame = frame_of(0.5 * (rings.front().centre + rings.back().centre), y, -1.0 * phase.first());
  form.segments = static_cast<int>(rings[1].at.size());
  form.rings = static_cast<int>(rings.size()) - 1;
  const double radius = dot(rings.back().centre - rings.front().centre, y) / 2;
  if (!(radius > 0)) return std::nullopt;
  form.shape = SphereForm{radius};
  const auto residual = ring_residual(form, rings, turn, 0, tolerances.round(radius, rings[1].at.size()));
  if (!residual) return std::nullopt;
  return Fit{std::move(form), *residual, turn > 0};
}

std::optional<Fit> fit_closed_ring(std::span<const Ring> rings, const Tolerances& tolerances) {
  if (rings.size() != 4) return std::nullopt;
  std::size_t first = 0;  // of the two outer rings, the one from which the walk goes on to the other
  for (std::size_t k = 0; k < 4; ++k)
    if (rings[k].radius >= rings[first].radius - tolerances.flat() &&
        rings[(k + 1) % 4].radius >= rings[first].radius - tolerances.flat())
      first = k;
  const Ring low[] = {rings[first], rings[(first + 3) % 4]}, high[] = {rings[(first + 1) % 4], rings[(first + 2) % 4]};
  return fit_hollow(low, high, tolerances);
}

}  // namespace wrlkit::recognising
