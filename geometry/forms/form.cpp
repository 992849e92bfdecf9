#include "geometry/forms/form.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/math/affine.h"
#include "base/overloaded.h"
#include "geometry/forms/cut.h"

namespace wrlkit {
namespace {

using std::numbers::pi;
constexpr int most_segments = 1024;

/// The angle that a dish, a sphere or a bend spans from its first ring to its last.
double profile_angle(const DishForm& f) {
  return f.spherical ? pi / 2 - std::asin(std::clamp(1 - f.height / sphere_radius(f), -1.0, 1.0)) : pi / 2;
}

int chords(double radius, double angle, double tolerance) {
  const double half = std::asin(std::sqrt(std::clamp(tolerance / (2 * radius), 1e-9, 0.5)));
  return static_cast<int>(std::clamp(std::ceil(angle / (4 * half) - 1e-9), 1.0, double(most_segments)));
}

int around(double radius, double tolerance) { return std::max(3, chords(radius, 2 * pi, tolerance)); }

}  // namespace

double equal_area_factor(double angle) { return angle > 0 && angle < pi ? std::sqrt(angle / std::sin(angle)) : 1; }
double equal_area_factor(int segments) { return equal_area_factor(2 * pi / segments); }

bool is_whole(double angle) { return angle >= 2 * pi - 1e-9; }

double sphere_radius(const DishForm& f) { return (f.radius * f.radius + f.height * f.height) / (2 * f.height); }

std::vector<std::array<Vec3, 2>> prism_normals(const PrismForm& f) {
  std::vector<Vec3> flat;
  std::vector<std::array<Vec3, 2>> out;
  std::size_t begin = 0;
  for (std::size_t end : f.ring_ends) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec2 &a = f.points[i], &b = f.points[i + 1 == end ? begin : i + 1];
      flat.push_back(unit({a[1] - b[1], 0, b[0] - a[0]}));
    }
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 &before = flat[i == begin ? end - 1 : i - 1], &after = flat[i + 1 == end ? begin : i + 1];
      auto joined = [&](const Vec3& other) {
        return dot(flat[i], other) > std::cos(f.crease_angle) ? unit(flat[i] + other) : flat[i];
      };
      out.push_back({joined(before), joined(after)});
    }
    begin = end;
  }
  return out;
}

std::string_view kind_of(const Form& form) {
  return std::visit(
      Overloaded{[](const CylinderForm&) { return "cylinder"; },
                 [](const FrustumForm& f) { return f.bottom_radius > 0 && f.top_radius > 0 ? "frustum" : "cone"; },
                 [](const TorusForm&) { return "torus"; },
                 [](const RectangularTorusForm&) { return "rectangular-torus"; },
                 [](const SphereForm&) { return "sphere"; }, [](const DishForm&) { return "dish"; },
                 [](const BoxForm&) { return "box"; }, [](const PyramidForm&) { return "pyramid"; },
                 [](const PrismForm&) { return "prism"; }, [](const RingForm&) { return "ring"; }},
      form.shape);
}

FormCut completed(const Form& form, const FormCut& cut) {
  const bool bent = std::holds_alternative<RectangularTorusForm>(form.shape);
  const bool sphere = std::holds_alternative<SphereForm>(form.shape);
  auto choose = [](int given, int own, int otherwise, int least) {
    return std::clamp(given > 0 ? given : own > 0 ? own : otherwise, least, most_segments);
  };
  return {choose(cut.segments, form.segments, 24, bent ? 1 : 3), choose(cut.rings, form.rings, 8, sphere ? 2 : 1),
          cut.equal_area};
}

double reach_of(const Form& form) {
  return std::visit(Overloaded{[](const CylinderForm& f) { return f.radius; },
                               [](const FrustumForm& f) { return std::max(f.bottom_radius, f.top_radius); },
                               [](const TorusForm& f) { return f.bend_radius + f.radius; },
                               [](const RectangularTorusForm& f) { return f.outer_radius; },
                               [](const SphereForm& f) { return f.radius; },
                               [](const DishForm& f) { return std::max(f.radius, f.height); },
                               [](const RingForm& f) { return f.outer_radius; }, [](const auto&) { return 0.0; }},
                    form.shape);
}

FormCut cut_within(const Form& form, double tolerance) {
  // Two curvatures share the tolerance evenly.
  const double half = tolerance / 2;
  return std::visit(
      Overloaded{
          [&](const CylinderForm& f) {
            return FormCut{around(f.radius, tolerance), 0};
          },
          [&](const FrustumForm& f) {
            return FormCut{around(std::max(f.bottom_radius, f.top_radius), tolerance), 0};
          },
          [&](const TorusForm& f) {
            return FormCut{around(f.radius, half), chords(f.bend_radius + f.radius, f.angle, half)};
          },
          [&](const RectangularTorusForm& f) {
            return FormCut{chords(f.outer_radius, f.angle, tolerance), 0};
          },
          [&](const SphereForm& f) {
            return FormCut{around(f.radius, half), std::max(2, chords(f.radius, pi, half))};
          },
          [&](const DishForm& f) {
            const double r = f.spherical ? sphere_radius(f) : std::max(f.radius, f.height);
            return FormCut{around(std::max(f.radius, f.spherical ? r : 0.0), half), chords(r, profile_angle(f), half)};
          },
          [&](const RingForm& f) {
            return FormCut{around(f.outer_radius, tolerance), 0};
          },
          [&](const auto&) { return FormCut{}; }},
      form.shape);
}

std::size_t n_triangles(const Form& form, const FormCut& given) {
  const FormCut cut = completed(form, given);
  const auto n = static_cast<std::size_t>(cut.segments), m = static_cast<std::size_t>(cut.rings);
  const std::size_t caps = std::size_t{form.bottom} + std::size_t{form.top};
  return std::visit(
      Overloaded{[&](const CylinderForm&) { return 2 * n + caps * (n - 2); },
                 [&](const FrustumForm& f) {
                   std::size_t out = 0;
                   for (auto [r, cap] : {std::pair{f.bottom_radius, form.bottom}, std::pair{f.top_radius, form.top}})
                     if (r > 0) out += n + (cap ? n - 2 : 0);
                   return out;
                 },
                 [&](const TorusForm& f) { return 2 * n * m + (is_whole(f.angle) ? 0 : caps * (n - 2)); },
                 [&](const RectangularTorusForm& f) { return 8 * n + (is_whole(f.angle) ? 0 : caps * 2); },
                 [&](const SphereForm&) { return 2 * n * (m - 1); },
                 [&](const DishForm&) { return n * (2 * m - 1) + (form.bottom ? n - 2 : 0); },
                 [&](const BoxForm&) { return 8 + 2 * caps; },
                 [&](const PyramidForm& f) {
                   std::size_t out = 8;
                   for (const auto* end : {&f.bottom, &f.top}) {
                     const int flat = ((*end)[0] > 0 ? 0 : 1) + ((*end)[1] > 0 ? 0 : 1);
                     out -= static_cast<std::size_t>(2 * flat);
                     if (flat == 0 && (end == &f.top ? form.top : form.bottom)) out += 2;
                   }
                   return out;
                 },
                 [&](const PrismForm& f) {
                   return 2 * f.points.size() + caps * (f.points.size() + 2 * f.ring_ends.size() - 4);
                 },
                 [&](const RingForm&) { return 4 * n + caps * 2 * n; }},
      form.shape);
}

std::vector<FormEnd> round_ends(const Form& form) {
  const Matrix& m = form.frame;
  auto end = [&](const Vec3& centre, const Vec3& axis, const Vec3& first, double radius, bool top) {
    return FormEnd{m.point(centre), direction(m, axis), direction(m, first), radius, top};
  };
  auto straight = [&](double bottom, double top, double height, const Vec2& offset) {
    std::vector<FormEnd> out;
    const double x = offset[0] / 2, z = offset[1] / 2;
    if (bottom > 0) out.push_back(end({-x, -height / 2, -z}, {0, -1, 0}, {0, 0, -1}, bottom, false));
    if (top > 0) out.push_back(end({x, height / 2, z}, {0, 1, 0}, {0, 0, -1}, top, true));
    return out;
  };
  return std::visit(
      Overloaded{[&](const CylinderForm& f) { return straight(f.radius, f.radius, f.height, {}); },
                 [&](const FrustumForm& f) {
                   return f.bottom_slope == Vec2{} && f.top_slope == Vec2{}
                              ? straight(f.bottom_radius, f.top_radius, f.height, f.offset)
                              : std::vector<FormEnd>{};
                 },
                 [&](const RingForm& f) { return straight(f.outer_radius, f.outer_radius, f.height, {}); },
                 [&](const DishForm& f) {
                   return std::vector{end({}, {0, -1, 0}, {0, 0, -1}, f.radius, false)};
                 },
                 [&](const TorusForm& f) {
                   if (is_whole(f.angle)) return std::vector<FormEnd>{};
                   const double c = std::cos(f.angle), s = std::sin(f.angle), R = f.bend_radius;
                   const double a = std::cos(f.turn), b = std::sin(f.turn);
                   return std::vector{end({R, 0, 0}, {0, 0, 1}, {a, b, 0}, f.radius, false),
                                      end({R * c, 0, -R * s}, {-s, 0, -c}, {a * c, b, -a * s}, f.radius, true)};
                 },
                 [&](const auto&) { return std::vector<FormEnd>{}; }},
      form.shape);
}

}  // namespace wrlkit
