#include "geometry/forms/form_node.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

namespace cylinder_node = nodes::cylinder_form;
namespace frustum_node = nodes::frustum_form;
namespace torus_node = nodes::torus_form;
namespace rectangular_torus_node = nodes::rectangular_torus_form;
namespace sphere_node = nodes::sphere_form;
namespace dish_node = nodes::dish_form;
namespace box_node = nodes::box_form;
namespace pyramid_node = nodes::pyramid_form;
namespace prism_node = nodes::prism_form;
namespace ring_node = nodes::ring_form;

bool is_size(double v) { return v > 0 && std::isfinite(v); }
template <class... T>
bool are_sizes(T... v) {
  return (is_size(v) && ...);
}

std::vector<Vec2> pairs(std::span<const double> numbers) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) out.push_back({numbers[i], numbers[i + 1]});
  return out;
}

class Reader {
 public:
  Reader(const Scene& scene, NodeId node) : scene_(scene), n_(node) {}

  std::optional<Form> read() {
    const bool found = standard() || own();
    return found ? std::optional(form_) : std::nullopt;
  }

 private:
  template <class K>
  auto get(K key) const {
    return scene_.get(n_, key);
  }
  bool is(TypeId t) const { return scene_.is(n_, t); }

  bool standard() {
    if (is(nodes::Cylinder)) return cylinder();
    if (is(nodes::Cone)) return cone();
    if (is(nodes::Sphere)) {
      const double r = get(nodes::sphere::radius);
      form_.shape = SphereForm{r};
      return is_size(r);
    }
    if (is(nodes::Box)) {
      const Vec3 size = get(nodes::box::size);
      form_.shape = BoxForm{size};
      return are_sizes(size[0], size[1], size[2]);
    }
    return is(nodes::Extrusion) && extrusion();
  }
  bool own() {
    if (is(nodes::CylinderForm)) return own_cylinder();
    if (is(nodes::FrustumForm)) return frustum();
    if (is(nodes::TorusForm)) return torus();
    if (is(nodes::RectangularTorusForm)) return rectangular_torus();
    if (is(nodes::SphereForm)) return sphere();
    if (is(nodes::DishForm)) return dish();
    if (is(nodes::BoxForm)) return box();
    if (is(nodes::PyramidForm)) return pyramid();
    if (is(nodes::PrismForm)) return prism();
    return is(nodes::RingForm) && ring();
  }

  template <class Bottom, class Top>
  void caps(Bottom bottom, Top top) {
    form_.bottom = get(bottom);
    form_.top = get(top);
  }

  bool cylinder() {
    namespace f = nodes::cylinder;
    const CylinderForm c{get(f::radius), get(f::height)};
    form_.shape = c;
    caps(f::bottom, f::top);
    form_.segments = get(f::segments);
    return get(f::side) && are_sizes(c.radius, c.height);
  }
  bool cone() {
    namespace f = nodes::cone;
    const FrustumForm c{get(f::bottomRadius), 0, get(f::height), {}, {}, {}};
    form_.shape = c;
    form_.bottom = get(f::bottom);
    form_.segments = get(f::segments);
    return get(f::side) && are_sizes(c.bottom_radius, c.height);
  }
  bool extrusion();
  bool own_cylinder() {
    const CylinderForm c{get(cylinder_node::radius), get(cylinder_node::height)};
    form_.shape = c;
    caps(cylinder_node::bottom, cylinder_node::top);
    form_.segments = get(cylinder_node::segments);
    return are_sizes(c.radius, c.height);
  }
  bool frustum() {
    namespace f = frustum_node;
    const FrustumForm c{get(f::bottomRadius), get(f::topRadius),   get(f::height),
                        get(f::offset),       get(f::bottomSlope), get(f::topSlope)};
    form_.shape = c;
    caps(f::bottom, f::top);
    form_.segments = get(f::segments);
    return c.bottom_radius >= 0 && c.top_radius >= 0 && is_size(c.bottom_radius + c.top_radius) &&
           std::isfinite(c.height);
  }
  bool torus() {
    namespace f = torus_node;
    const TorusForm c{get(f::bendRadius), get(f::radius), get(f::angle), get(f::turn)};
    form_.shape = c;
    caps(f::bottom, f::top);
    form_.segments = get(f::segments);
    form_.rings = get(f::rings);
    return are_sizes(c.bend_radius, c.radius, c.angle) && std::isfinite(c.turn);
  }
  bool rectangular_torus() {
    namespace f = rectangular_torus_node;
    const RectangularTorusForm c{get(f::innerRadius), get(f::outerRadius), get(f::height), get(f::angle)};
    form_.shape = c;
    caps(f::bottom, f::top);
    form_.segments = get(f::segments);
    return c.inner_radius >= 0 && are_sizes(c.outer_radius, c.height, c.angle);
  }
  bool sphere() {
    const double r = get(sphere_node::radius);
    form_.shape = SphereForm{r};
    form_.segments = get(sphere_node::segments);
    form_.rings = get(sphere_node::rings);
    return is_size(r);
  }
  bool dish() {
    namespace f = dish_node;
    const DishForm c{get(f::radius), get(f::height), get(f::spherical)};
    form_.shape = c;
    form_.bottom = get(f::bottom);
    form_.segments = get(f::segments);
    form_.rings = get(f::rings);
    return are_sizes(c.radius, c.height);
  }
  bool box() {
    const Vec3 size = get(box_node::size);
    form_.shape = BoxForm{size};
    caps(box_node::bottom, box_node::top);
    return are_sizes(size[0], size[1], size[2]);
  }
  bool pyramid() {
    namespace f = pyramid_node;
    const PyramidForm c{get(f::bottomSize), get(f::topSize), get(f::height), get(f::offset)};
    form_.shape = c;
    caps(f::bottom, f::top);
    return is_size(c.height);
  }
  bool prism() {
    namespace f = prism_node;
    PrismForm c{pairs(get(f::points)), {}, get(f::height), get(f::creaseAngle)};
    std::size_t end = 0;
    for (auto e : get(f::ringEnds)) {
      if (e < 0 || static_cast<std::size_t>(e) < end + 3 || static_cast<std::size_t>(e) > c.points.size()) return false;
      end = static_cast<std::size_t>(e);
      c.ring_ends.push_back(static_cast<std::uint32_t>(e));
    }
    caps(f::bottom, f::top);
    const bool whole = end > 0 && end == c.points.size() && is_size(c.height);
    form_.shape = std::move(c);
    return whole;
  }
  bool ring() {
    namespace f = ring_node;
    const RingForm c{get(f::innerRadius), get(f::outerRadius), get(f::height)};
    form_.shape = c;
    caps(f::bottom, f::top);
    form_.segments = get(f::segments);
    return are_sizes(c.inner_radius, c.outer_radius, c.height);
  }

  const Scene& scene_;
  NodeId n_;
  Form form_;
};

/// A prism: a spine along Y, upwards, around the origin, and a closed curve.
bool Reader::extrusion() {
  namespace f = nodes::extrusion;
  const auto spine = get(f::spine), scale = get(f::scale), turn = get(f::orientation);
  if (spine.size() != 6 || spine[0] != 0 || spine[2] != 0 || spine[3] != 0 || spine[5] != 0) return false;
  if (!(spine[4] > spine[1]) || spine[4] + spine[1] != 0) return false;
  if (!std::ranges::all_of(scale, [](double v) { return v == 1; }) || !get(f::ccw)) return false;
  for (std::size_t i = 3; i < turn.size(); i += 4)
    if (turn[i] != 0) return false;
  PrismForm c{pairs(get(f::crossSection)), {}, spine[4] - spine[1], get(f::creaseAngle)};
  if (c.points.size() < 4 || c.points.front() != c.points.back()) return false;
  c.points.pop_back();
  c.ring_ends = {static_cast<std::uint32_t>(c.points.size())};
  form_.shape = std::move(c);
  caps(f::beginCap, f::endCap);
  return true;
}

bool is_convex(const PrismForm& f) {
  const std::size_t n = f.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = f.points[i], &b = f.points[(i + 1) % n], &c = f.points[(i + 2) % n];
    if ((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) > 0) return false;  // Z points down
  }
  return true;
}

class Adder {
 public:
  Adder(Scene& scene, const Form& form, bool solid, Span where)
      : scene_(scene), form_(form), solid_(solid), where_(where) {}

  NodeId operator()(const CylinderForm& f) {
    if (solid_) {
      const NodeId n = node(nodes::Cylinder);
      fill(n, f, nodes::cylinder::radius, nodes::cylinder::height);
      caps(n, nodes::cylinder::bottom, nodes::cylinder::top);
      scene_.set(n, nodes::cylinder::segments, form_.segments);
      return n;
    }
    const NodeId n = node(nodes::CylinderForm);
    fill(n, f, cylinder_node::radius, cylinder_node::height);
    caps(n, cylinder_node::bottom, cylinder_node::top);
    return rest(n, cylinder_node::segments, cylinder_node::solid);
  }
  NodeId operator()(const FrustumForm& f) {
    namespace k = frustum_node;
    if (solid_ && f.top_radius == 0 && f.offset == Vec2{} && f.bottom_slope == Vec2{}) return cone(f);
    const NodeId n = node(nodes::FrustumForm);
    scene_.set(n, k::bottomRadius, f.bottom_radius, k::topRadius, f.top_radius, k::height, f.height);
    if (f.offset != Vec2{}) scene_.set(n, k::offset, f.offset);
    if (f.bottom_slope != Vec2{}) scene_.set(n, k::bottomSlope, f.bottom_slope);
    if (f.top_slope != Vec2{}) scene_.set(n, k::topSlope, f.top_slope);
    caps(n, k::bottom, k::top);
    return rest(n, k::segments, k::solid);
  }
  NodeId operator()(const TorusForm& f) {
    namespace k = torus_node;
    const NodeId n = node(nodes::TorusForm);
    scene_.set(n, k::bendRadius, f.bend_radius, k::radius, f.radius, k::angle, f.angle);
    if (f.turn != 0) scene_.set(n, k::turn, f.turn);
    scene_.set(n, k::rings, form_.rings);
    caps(n, k::bottom, k::top);
    return rest(n, k::segments, k::solid);
  }
  NodeId operator()(const RectangularTorusForm& f) {
    namespace k = rectangular_torus_node;
    const NodeId n = node(nodes::RectangularTorusForm);
    scene_.set(n, k::innerRadius, f.inner_radius, k::outerRadius, f.outer_radius, k::height, f.height, k::angle,
               f.angle);
    caps(n, k::bottom, k::top);
    return rest(n, k::segments, k::solid);
  }
  NodeId operator()(const SphereForm& f) {
    namespace k = sphere_node;
    const NodeId n = node(nodes::SphereForm);
    scene_.set(n, k::radius, f.radius, k::rings, form_.rings);
    return rest(n, k::segments, k::solid);
  }
  NodeId operator()(const DishForm& f) {
    namespace k = dish_node;
    const NodeId n = node(nodes::DishForm);
    fill(n, f, k::radius, k::height);
    if (f.spherical) scene_.set(n, k::spherical, true);
    if (!form_.bottom) scene_.set(n, k::bottom, false);
    scene_.set(n, k::rings, form_.rings);
    return rest(n, k::segments, k::solid);
  }
  NodeId operator()(const BoxForm& f) {
    const bool plain = solid_ && form_.bottom && form_.top;
    const NodeId n = node(plain ? nodes::Box : nodes::BoxForm);
    if (plain) {
      scene_.set(n, nodes::box::size, f.size);
      return n;
    }
    scene_.set(n, box_node::size, f.size);
    caps(n, box_node::bottom, box_node::top);
    return set_solid(n, box_node::solid);
  }
  NodeId operator()(const PyramidForm& f) {
    namespace k = pyramid_node;
    const NodeId n = node(nodes::PyramidForm);
    scene_.set(n, k::bottomSize, f.bottom, k::topSize, f.top, k::height, f.height);
    if (f.offset != Vec2{}) scene_.set(n, k::offset, f.offset);
    caps(n, k::bottom, k::top);
    return set_solid(n, k::solid);
  }
  NodeId operator()(const PrismForm& f) {
    namespace k = prism_node;
    if (f.ring_ends.size() == 1) return extrusion(f);
    const NodeId n = node(nodes::PrismForm);
    scene_.set(n, k::points, flat(f.points), k::ringEnds,
               std::vector<std::int32_t>(f.ring_ends.begin(), f.ring_ends.end()), k::height, f.height);
    if (f.crease_angle != 0) scene_.set(n, k::creaseAngle, f.crease_angle);
    caps(n, k::bottom, k::top);
    return set_solid(n, k::solid);
  }
  NodeId operator()(const RingForm& f) {
    namespace k = ring_node;
    const NodeId n = node(nodes::RingForm);
    scene_.set(n, k::innerRadius, f.inner_radius, k::outerRadius, f.outer_radius, k::height, f.height);
    caps(n, k::bottom, k::top);
    return rest(n, k::segments, k::solid);
  }

 private:
  NodeId node(TypeId type) { return scene_.add(type, where_); }
  template <class F, class R, class H>
  void fill(NodeId n, const F& f, R radius, H height) {
    scene_.set(n, radius, f.radius);
    scene_.set(n, height, f.height);
  }
  template <class B, class T>
  void caps(NodeId n, B bottom, T top) {
    if (!form_.bottom) scene_.set(n, bottom, false);
    if (!form_.top) scene_.set(n, top, false);
  }
  template <class S>
  NodeId set_solid(NodeId n, S solid) {
    if (!solid_) scene_.set(n, solid, false);
    return n;
  }
  template <class G, class S>
  NodeId rest(NodeId n, G segments, S solid) {
    scene_.set(n, segments, form_.segments);
    return set_solid(n, solid);
  }
  NodeId cone(const FrustumForm& f) {
    const NodeId n = node(nodes::Cone);
    scene_.set(n, nodes::cone::bottomRadius, f.bottom_radius, nodes::cone::height, f.height);
    if (!form_.bottom) scene_.set(n, nodes::cone::bottom, false);
    scene_.set(n, nodes::cone::segments, form_.segments);
    return n;
  }
  static std::vector<double> flat(const std::vector<Vec2>& points) {
    std::vector<double> out;
    for (const Vec2& p : points) out.insert(out.end(), p.begin(), p.end());
    return out;
  }
  NodeId extrusion(const PrismForm& f) {
    namespace k = nodes::extrusion;
    const NodeId n = node(nodes::Extrusion);
    auto curve = flat(f.points);
    curve.insert(curve.end(), {f.points[0][0], f.points[0][1]});
    scene_.set(n, k::crossSection, curve, k::spine, std::vector<double>{0, -f.height / 2, 0, 0, f.height / 2, 0});
    if (f.crease_angle != 0) scene_.set(n, k::creaseAngle, f.crease_angle);
    if (!is_convex(f)) scene_.set(n, k::convex, false);
    caps(n, k::beginCap, k::endCap);
    return set_solid(n, k::solid);
  }

  Scene& scene_;
  const Form& form_;
  bool solid_;
  Span where_;
};

}  // namespace

std::optional<Form> read_form(const Scene& scene, NodeId geometry) {
  return geometry ? Reader(scene, geometry).read() : std::nullopt;
}

bool is_solid(const Scene& scene, NodeId geometry) {
  const auto slot = scene.type(geometry).find("solid", Dialect::x3d);
  return !slot || scene.value(geometry, *slot).integer != 0;
}

NodeId add_form(Scene& scene, const Form& form, bool solid, Span where) {
  return std::visit(Adder(scene, form, solid, where), form.shape);
}

}  // namespace wrlkit
