// A form as faces. Rings run anticlockwise seen from +Y, from -Z towards -X (see form.h).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/math/vec.h"
#include "geometry/forms/cut.h"
#include "geometry/forms/form_mesh.h"
#include "geometry/polygon.h"
#include "geometry/shapes/circle.h"

namespace wrlkit {
namespace {

using std::numbers::pi;

/// The unit circle and the radius by which a polygon of n sides stands for it.
struct Circle {
  std::vector<double> x, z;
  double grow = 1;
  std::size_t n = 0;

  Circle(int segments, bool equal_area) : n(static_cast<std::size_t>(segments)) {
    unit_circle(segments, x, z);
    if (equal_area) grow = equal_area_factor(segments);
  }
};

class Maker {
 public:
  Maker(const Form& form, const FormCut& cut, Mesh& mesh)
      : form_(form), cut_(completed(form, cut)), out_(form.frame, mesh) {}

  void operator()(const CylinderForm& f) { wall({f.radius, f.radius, f.height, {}, {}, {}}); }
  void operator()(const FrustumForm& f) { wall(f); }
  void operator()(const TorusForm& f);
  void operator()(const RectangularTorusForm& f);
  void operator()(const SphereForm& f) { dome(f.radius, f.radius, -pi / 2, pi, false); }
  void operator()(const DishForm& f);
  void operator()(const BoxForm& f) { hexahedron({f.size[0], f.size[2]}, {f.size[0], f.size[2]}, f.size[1], {}); }
  void operator()(const PyramidForm& f) { hexahedron(f.bottom, f.top, f.height, f.offset); }
  void operator()(const PrismForm& f);
  void operator()(const RingForm& f);
  void finish() { out_.finish(); }

 private:
  using Ring = FormMesh::Ring;

  void wall(const FrustumForm& f);
  void dome(double radius, double height, double from, double angle, bool closed);
  void hexahedron(const Vec2& bottom, const Vec2& top, double height, const Vec2& offset);
  void annulus(const Ring& outer, const Ring& inner, const Vec3& normal);
  void prism_caps(const PrismForm& f, const std::vector<std::uint32_t>& low, const std::vector<std::uint32_t>& high);

  const Form& form_;
  FormCut cut_;
  FormMesh out_;
};

void Maker::wall(const FrustumForm& f) {
  const Circle c(cut_.segments, cut_.equal_area);
  Ring rings[2];
  for (int end = 0; end < 2; ++end) {
    const double side = end ? 0.5 : -0.5, r = (end ? f.top_radius : f.bottom_radius) * c.grow;
    const Vec2& slope = end ? f.top_slope : f.bottom_slope;
    for (std::size_t i = 0; i < c.n; ++i) {
      const double x = r * c.x[i], z = r * c.z[i];
      if (i == 0 || r > 0)
        rings[end].positions.push_back(out_.position(
            {side * f.offset[0] + x, side * f.height + slope[0] * x + slope[1] * z, side * f.offset[1] + z}));
      else
        rings[end].positions.push_back(rings[end].positions[0]);
      // The wall leans by as much as the radius shrinks and as the offset leads away.
      const double lean = f.bottom_radius - f.top_radius - f.offset[0] * c.x[i] - f.offset[1] * c.z[i];
      rings[end].normals.push_back(out_.normal({f.height * c.x[i], lean, f.height * c.z[i]}));
    }
  }
  out_.band(rings[0], rings[1]);
  if (form_.bottom && f.bottom_radius > 0)
    out_.cap(rings[0].positions, {f.bottom_slope[0], -1, f.bottom_slope[1]}, true);
  if (form_.top && f.top_radius > 0) out_.cap(rings[1].positions, {-f.top_slope[0], 1, -f.top_slope[1]}, false);
}

void Maker::operator()(const TorusForm& f) {
  const auto n = static_cast<std::size_t>(cut_.segments);
  const bool whole = is_whole(f.angle);
  const double r = f.radius * (cut_.equal_area ? equal_area_factor(cut_.segments) : 1);
  std::vector<Ring> rings(static_cast<std::size_t>(cut_.rings) + 1);
  for (std::size_t k = 0; k < rings.size(); ++k) {
    if (whole && k + 1 == rings.size()) {
      rings[k] = rings[0];
      break;
    }
    const double t = f.angle * static_cast<double>(k) / cut_.rings, c = std::cos(t), s = std::sin(t);
    for (std::size_t i = 0; i < n; ++i) {
      const double a = f.turn + 2 * pi * static_cast<double>(i) / cut_.segments;
      const double d = f.bend_radius + r * std::cos(a);
      rings[k].positions.push_back(out_.position({d * c, r * std::sin(a), -d * s}));
      rings[k].normals.push_back(out_.normal({std::cos(a) * c, std::sin(a), -std::cos(a) * s}));
    }
  }
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) out_.band(rings[k + 1], rings[k]);
  if (whole) return;
  if (form_.bottom) out_.cap(rings.front().positions, {0, 0, 1}, false);
  if (form_.top) out_.cap(rings.back().positions, {-std::sin(f.angle), 0, -std::cos(f.angle)}, true);
}

void Maker::operator()(const RectangularTorusForm& f) {
  const bool whole = is_whole(f.angle);
  const auto m = static_cast<std::size_t>(cut_.segments);
  const double grow = cut_.equal_area ? equal_area_factor(f.angle / cut_.segments) : 1;
  const Vec2 corners[] = {{f.inner_radius * grow, -f.height / 2},
                          {f.outer_radius * grow, -f.height / 2},
                          {f.outer_radius * grow, f.height / 2},
                          {f.inner_radius * grow, f.height / 2}};
  std::vector<std::uint32_t> at[4];
  for (std::size_t k = 0; k < m + (whole ? 0 : 1); ++k) {
    const double t = f.angle * static_cast<double>(k) / cut_.segments;
    for (int i = 0; i < 4; ++i)
      at[i].push_back(out_.position({corners[i][0] * std::cos(t), corners[i][1], -corners[i][0] * std::sin(t)}));
  }
  auto strip = [&](int a, int b, auto normal_of) {
    Ring low, high;
    for (std::size_t k = 0; k <= m; ++k) {
      const double t = f.angle * static_cast<double>(k) / cut_.segments;
      low.positions.push_back(at[a][k % at[a].size()]);
      high.positions.push_back(at[b][k % at[b].size()]);
      low.normals.push_back(out_.normal(normal_of(t)));
      high.normals.push_back(low.normals.back());
    }
    out_.band(low, high, false);
  };
  strip(0, 1, [](double) { return Vec3{0, -1, 0}; });
  strip(1, 2, [](double t) { return Vec3{std::cos(t), 0, -std::sin(t)}; });
  strip(2, 3, [](double) { return Vec3{0, 1, 0}; });
  strip(3, 0, [](double t) { return Vec3{-std::cos(t), 0, std::sin(t)}; });
  if (whole) return;
  std::vector<std::uint32_t> first, last;
  for (const auto& a : at) {
    first.push_back(a.front());
    last.push_back(a.back());
  }
  if (form_.bottom) out_.cap(first, {0, 0, 1}, false);
  if (form_.top) out_.cap(last, {-std::sin(f.angle), 0, -std::cos(f.angle)}, true);
}

/// Rings around Y from the angle `from` (of an ellipse, -pi / 2: the pole below) up to the pole above.
void Maker::dome(double radius, double height, double from, double angle, bool closed) {
  const Circle c(cut_.segments, cut_.equal_area);
  std::vector<Ring> rings;
  for (int k = 0; k <= cut_.rings; ++k) {
    const double t = from + angle * k / cut_.rings;
    const bool pole = k == cut_.rings || (k == 0 && from <= -pi / 2);
    const double r = pole ? 0 : radius * std::cos(t) * c.grow, y = height * std::sin(t);
    Ring& ring = rings.emplace_back();
    for (std::size_t i = 0; i < c.n; ++i) {
      if (i == 0 || !pole)
        ring.positions.push_back(out_.position({r * c.x[i], y - height * (closed ? std::sin(from) : 0), r * c.z[i]}));
      else
        ring.positions.push_back(ring.positions[0]);
      const double flat = pole ? 0 : std::cos(t) / radius;
      ring.normals.push_back(out_.normal({flat * c.x[i], std::sin(t) / height, flat * c.z[i]}));
    }
  }
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) out_.band(rings[k], rings[k + 1]);
  if (closed && form_.bottom) out_.cap(rings[0].positions, {0, -1, 0}, true);
}

void Maker::operator()(const DishForm& f) {
  if (!f.spherical) return dome(f.radius, f.height, 0, pi / 2, true);
  const double whole = sphere_radius(f), from = std::asin(std::clamp(1 - f.height / whole, -1.0, 1.0));
  dome(whole, whole, from, pi / 2 - from, true);
}

void Maker::hexahedron(const Vec2& bottom, const Vec2& top, double height, const Vec2& offset) {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> at;
  for (int end = 0; end < 2; ++end) {
    const Vec2& size = end ? top : bottom;
    const double side = end ? 0.5 : -0.5;
    for (const Vec2& corner : {Vec2{-1, -1}, Vec2{-1, 1}, Vec2{1, 1}, Vec2{1, -1}})
      points.push_back(
          {side * offset[0] + corner[0] * size[0] / 2, side * height, side * offset[1] + corner[1] * size[1] / 2});
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const auto first = std::ranges::find(points, points[i]); first == points.begin() + std::ptrdiff_t(i))
      at.push_back(out_.position(points[i]));
    else
      at.push_back(at[static_cast<std::size_t>(first - points.begin())]);
  auto face = [&](const std::array<std::size_t, 4>& corners) {
    std::vector<std::uint32_t> kept;
    Vec3 normal{};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t a = corners[i], b = corners[(i + 1) % 4];
      normal = normal + cross(points[a], points[b]);
      if (at[a] != at[b]) kept.push_back(at[a]);
    }
    if (kept.size() > 2) out_.cap(kept, normal, false);
  };
  face({0, 1, 5, 4});
  face({1, 2, 6, 5});
  face({2, 3, 7, 6});
  face({3, 0, 4, 7});
  if (form_.top) face({4, 5, 6, 7});
  if (form_.bottom) face({3, 2, 1, 0});
}

void Maker::prism_caps(const PrismForm& f, const std::vector<std::uint32_t>& low,
                       const std::vector<std::uint32_t>& high) {
  if (f.ring_ends.size() < 2) {
    if (form_.bottom) out_.cap(low, {0, -1, 0}, true);
    if (form_.top) out_.cap(high, {0, 1, 0}, false);
    return;
  }
  PolygonCutter cutter;
  std::vector<Vec2> flat;  // seen from above X runs right and Z down
  for (const Vec2& p : f.points) flat.push_back({p[0], -p[1]});
  cutter.cut(flat, f.ring_ends);
  const auto cut = cutter.corners();
  for (std::size_t i = 0; i < cut.size(); i += 3) {
    if (form_.bottom) out_.cap({low[cut[i]], low[cut[i + 1]], low[cut[i + 2]]}, {0, -1, 0}, true);
    if (form_.top) out_.cap({high[cut[i]], high[cut[i + 1]], high[cut[i + 2]]}, {0, 1, 0}, false);
  }
}

void Maker::operator()(const PrismForm& f) {
  std::vector<std::uint32_t> low, high;
  for (auto* at : {&low, &high})
    for (const Vec2& p : f.points) at->push_back(out_.position({p[0], (at == &high ? 0.5 : -0.5) * f.height, p[1]}));
  const auto walls = prism_normals(f);
  std::size_t begin = 0;
  for (std::size_t end : f.ring_ends) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t k = i + 1 == end ? begin : i + 1;
      const auto a = out_.normal(walls[i][0]), b = out_.normal(walls[i][1]);
      out_.corner(low[i], a);
      out_.corner(low[k], b);
      out_.corner(high[k], b);
      out_.corner(high[i], a);
      out_.end_face();
    }
    begin = end;
  }
  prism_caps(f, low, high);
}

void Maker::annulus(const Ring& outer, const Ring& inner, const Vec3& normal) {
  const auto number = out_.normal(normal);
  const std::size_t n = outer.positions.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = (i + 1) % n;
    for (auto p : {outer.positions[i], outer.positions[k], inner.positions[k], inner.positions[i]})
      out_.corner(p, number);
    out_.end_face();
  }
}

void Maker::operator()(const RingForm& f) {
  const Circle c(cut_.segments, cut_.equal_area);
  Ring rings[4];  // outer below and above, inner below and above
  for (int k = 0; k < 4; ++k) {
    const double r = (k < 2 ? f.outer_radius : f.inner_radius) * c.grow, turn = k < 2 ? 1 : -1;
    for (std::size_t i = 0; i < c.n; ++i) {
      rings[k].positions.push_back(out_.position({r * c.x[i], k % 2 ? f.height / 2 : -f.height / 2, r * c.z[i]}));
      rings[k].normals.push_back(out_.normal({turn * c.x[i], 0, turn * c.z[i]}));
    }
  }
  out_.band(rings[0], rings[1]);
  out_.band(rings[3], rings[2]);
  if (form_.top) annulus(rings[1], rings[3], {0, 1, 0});
  if (form_.bottom) annulus(rings[2], rings[0], {0, -1, 0});
}

}  // namespace

void tessellate_form(const Form& form, const FormCut& cut, Mesh& mesh) {
  mesh.clear();
  Maker maker(form, cut, mesh);
  std::visit(maker, form.shape);
  maker.finish();
}

}  // namespace wrlkit
