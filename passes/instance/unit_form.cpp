#include "passes/instance/unit_form.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/hashing.h"

namespace wrlkit::instancing {
namespace {

Vec2 scaled(const Vec2& v, double by) { return {v[0] / by, v[1] / by}; }

class Maker {
 public:
  explicit Maker(UnitForm& out) : out_(out) {}

  void operator()(const CylinderForm& f) { give(CylinderForm{1, 1}, {f.radius, f.height, f.radius}, {}); }
  void operator()(const FrustumForm& f) {
    const double s = std::max(f.bottom_radius, f.top_radius);
    const FrustumForm one{f.bottom_radius / s, f.top_radius / s, f.height / s,
                          scaled(f.offset, s), f.bottom_slope,   f.top_slope};
    give(one, {s, s, s},
         {one.bottom_radius, one.top_radius, one.height, one.offset[0], one.offset[1], f.bottom_slope[0],
          f.bottom_slope[1], f.top_slope[0], f.top_slope[1]});
  }
  void operator()(const TorusForm& f) {
    const double s = f.bend_radius + f.radius;
    const TorusForm one{f.bend_radius / s, f.radius / s, f.angle, f.turn};
    give(one, {s, s, s}, {one.radius, f.angle, f.turn});
  }
  void operator()(const RectangularTorusForm& f) {
    const double s = f.outer_radius;
    const RectangularTorusForm one{f.inner_radius / s, 1, 1, f.angle};
    give(one, {s, f.height, s}, {one.inner_radius, f.angle});
  }
  void operator()(const SphereForm& f) { give(SphereForm{1}, {f.radius, f.radius, f.radius}, {}); }
  void operator()(const DishForm& f) {
    const DishForm one{1, f.height / f.radius, f.spherical};
    exact(f.spherical);
    give(one, {f.radius, f.radius, f.radius}, {one.height});
  }
  void operator()(const BoxForm& f) { give(BoxForm{{1, 1, 1}}, f.size, {}); }
  void operator()(const PyramidForm& f) {
    const double s = std::max({f.bottom[0], f.bottom[1], f.top[0], f.top[1]});
    const PyramidForm one{scaled(f.bottom, s), scaled(f.top, s), f.height / s, scaled(f.offset, s)};
    give(one, {s, s, s},
         {one.bottom[0], one.bottom[1], one.top[0], one.top[1], one.height, one.offset[0], one.offset[1]});
  }
  void operator()(const PrismForm& f) {
    double s = 0;
    for (const Vec2& p : f.points) s = std::max({s, std::abs(p[0]), std::abs(p[1])});
    PrismForm one = f;
    one.height = 1;
    std::vector<double> ratios;
    for (Vec2& p : one.points) {
      p = scaled(p, s);
      ratios.insert(ratios.end(), p.begin(), p.end());
    }
    for (auto e : f.ring_ends) exact(e);
    exact(std::bit_cast<std::uint64_t>(f.crease_angle));
    give(std::move(one), {s, f.height, s}, std::move(ratios));
  }
  void operator()(const RingForm& f) {
    const double s = f.outer_radius;
    const RingForm one{f.inner_radius / s, 1, 1};
    give(one, {s, f.height, s}, {one.inner_radius});
  }

 private:
  void give(Form::Shape shape, const Vec3& scale, std::vector<double> ratios) {
    out_.form.shape = std::move(shape);
    out_.scale = scale;
    out_.ratios = std::move(ratios);
    exact(out_.form.shape.index());
    exact(out_.ratios.size());
  }
  void exact(std::uint64_t v) { out_.key = mixed(out_.key, v); }

  UnitForm& out_;
};

bool is_flat(const Form& form) {
  return std::holds_alternative<BoxForm>(form.shape) || std::holds_alternative<PyramidForm>(form.shape) ||
         std::holds_alternative<PrismForm>(form.shape);
}

}  // namespace

std::optional<UnitForm> unit_form(const Form& form, bool solid) {
  if (form.segments == 0 && !is_flat(form)) return std::nullopt;
  UnitForm out;
  out.form = form;
  out.form.frame = {};
  out.key = mixed(static_cast<std::uint64_t>(form.segments) * 4096 + static_cast<std::uint64_t>(form.rings),
                  form.bottom * 4 + form.top * 2 + solid);
  std::visit(Maker(out), form.shape);
  const bool sized = std::ranges::all_of(out.scale, [](double s) { return s > 0 && std::isfinite(s); });
  return sized ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace wrlkit::instancing
