#include "passes/lower_x3d/plant_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "passes/lower_x3d/foreign_fields.h"
#include "passes/lower_x3d/revolution.h"
#include "passes/lower_x3d/sphere_segment.h"
#include "passes/lower_x3d/two_sides.h"
#include "scenegraph/any_node.h"
#include "scenegraph/decompose.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

namespace k = nodes;

/// A geometry and where it stands in the Shape.
struct PlantPart {
  NodeId geometry;
  Vec3 translation{0, 0, 0};
  bool lies = false;  // bent around Z instead of Y: turned by -90 degrees around X
  Vec3 scale{1, 1, 1};

  bool moved() const { return translation != Vec3{0, 0, 0} || lies || scale != Vec3{1, 1, 1}; }
};
using PlantParts = std::vector<PlantPart>;

class PlantShape {
 public:
  PlantShape(Scene& scene, NodeId n, Diagnostics& diag) : scene_(scene), n_(n), diag_(diag), from_(scene, n) {}

  /// Empty: it is none.
  PlantParts make() {
    struct Row {
      std::string_view name;
      PlantParts (PlantShape::*make)();
    };
    static constexpr Row rows[] = {{"Pyramid", &PlantShape::pyramid},
                                   {"Snout", &PlantShape::snout},
                                   {"SlopedCylinder", &PlantShape::sloped_cylinder},
                                   {"Dish", &PlantShape::dish},
                                   {"Torus", &PlantShape::torus},
                                   {"RectangularTorus", &PlantShape::rectangular_torus},
                                   {"Nozzle", &PlantShape::nozzle},
                                   {"Plane", &PlantShape::plane},
                                   {"SolidOfRevolution", &PlantShape::solid_of_revolution},
                                   {"SphereSegment", &PlantShape::sphere_segment}};
    for (const Row& row : rows)
      if (scene_.type(n_).name == row.name) return (this->*row.make)();
    return {};
  }

 private:
  double size(std::string_view name, double otherwise) const { return std::abs(from_.number(name, otherwise)); }
  NodeId add(TypeId type) { return scene_.add(type, scene_.where(n_)); }
  template <class Key>
  void set_solid(NodeId to, Key solid) {
    if (!from_.flag("solid", true)) scene_.set(to, solid, false);
  }
  template <class Bottom, class Top>
  void set_caps(NodeId to, Bottom bottom, Top top, bool has_bottom, bool has_top) {
    if (!has_bottom) scene_.set(to, bottom, false);
    if (!has_top) scene_.set(to, top, false);
  }
  double angle() const { return std::clamp(from_.number("angle", 2 * std::numbers::pi), 0.0, 2 * std::numbers::pi); }
  Vec2 offset() const { return {from_.number("xoff", 0.25), from_.number("yoff", 0.25)}; }
  /// A form is centred between its ends, a shape of X3DOM above its bottom.
  static Vec3 centre_of(const Vec2& offset) { return {offset[0] / 2, 0, offset[1] / 2}; }

  PlantParts pyramid() {
    namespace f = k::pyramid_form;
    const NodeId to = add(k::PyramidForm);
    scene_.set(to, f::bottomSize, Vec2{size("xbottom", 1), size("ybottom", 1)}, f::topSize,
               Vec2{size("xtop", 0.5), size("ytop", 0.5)}, f::height, size("height", 1), f::offset, offset());
    set_solid(to, f::solid);
    return {{to, centre_of(offset())}};
  }

  PlantParts snout() {
    namespace f = k::frustum_form;
    const NodeId to = add(k::FrustumForm);
    scene_.set(to, f::bottomRadius, size("dbottom", 1) / 2, f::topRadius, size("dtop", 0.5) / 2, f::height,
               size("height", 1), f::offset, offset());
    set_caps(to, f::bottom, f::top, from_.flag("bottom", true), from_.flag("top", true));
    set_solid(to, f::solid);
    return {{to, centre_of(offset())}};
  }

  /// Its shears are how far the ends rise at the radius.
  PlantParts sloped_cylinder() {
    namespace f = k::frustum_form;
    const NodeId to = add(k::FrustumForm);
    const double radius = size("radius", 1), by = radius > 0 ? 1 / radius : 0, shear = 0.26179;
    scene_.set(to, f::bottomRadius, radius, f::topRadius, radius, f::height, size("height", 2), f::bottomSlope,
               Vec2{by * from_.number("xbshear", shear), by * from_.number("ybshear", 0)}, f::topSlope,
               Vec2{by * from_.number("xtshear", shear), by * from_.number("ytshear", 0)});
    set_caps(to, f::bottom, f::top, from_.flag("bottom", true), from_.flag("top", true));
    set_solid(to, f::solid);
    return {{to}};
  }

  /// The upper part of an ellipsoid: a cap of a ball, stretched along Y.
  PlantParts dish() {
    namespace f = k::dish_form;
    const double radius = size("diameter", 2) / 2, said = size("radius", radius), up = said > 0 ? said : radius;
    const double height = std::min(size("height", 1), up), stretch = radius > 0 ? up / radius : 1;
    const double round = height / stretch;  // of the ball
    const NodeId to = add(k::DishForm);
    scene_.set(to, f::radius, std::sqrt(std::max(0.0, round * (2 * radius - round))), f::height, round, f::spherical,
               true);
    if (!from_.flag("bottom", true)) scene_.set(to, f::bottom, false);
    set_solid(to, f::solid);
    return {{to, {0, 0, 0}, false, {1, stretch, 1}}};
  }

  PlantParts torus() {
    namespace f = k::torus_form;
    double bend = size("outerRadius", 1), radius = size("innerRadius", 0.5);
    const bool walls = from_.flag("insideOutsideRadius", false);  // the radii are those of the walls
    if (walls) {
      const double inner = std::min(bend, radius), outer = std::max(bend, radius);
      bend = (inner + outer) / 2;
      radius = (outer - inner) / 2;
    }
    const NodeId to = add(k::TorusForm);
    scene_.set(to, f::bendRadius, bend, f::radius, radius, f::angle, angle());
    const bool caps = from_.flag("caps", true);
    set_caps(to, f::bottom, f::top, caps, caps);
    set_solid(to, f::solid);
    return {{to, {0, 0, 0}, !walls}};
  }

  PlantParts rectangular_torus() {
    namespace f = k::rectangular_torus_form;
    const double one = size("innerRadius", 0.5), other = size("outerRadius", 1);
    const NodeId to = add(k::RectangularTorusForm);
    scene_.set(to, f::innerRadius, std::min(one, other), f::outerRadius, std::max(one, other), f::height,
               size("height", 1), f::angle, angle());
    const bool caps = from_.flag("caps", true);
    set_caps(to, f::bottom, f::top, caps, caps);
    set_solid(to, f::solid);
    return {{to}};
  }

  NodeId pipe(double inner, double outer, double height, bool top) {
    namespace f = k::ring_form;
    const NodeId to = add(k::RingForm);
    scene_.set(to, f::innerRadius, inner, f::outerRadius, outer, f::height, height);
    set_caps(to, f::bottom, f::top, true, top);
    set_solid(to, f::solid);
    return to;
  }

  /// A pipe with a flange at its upper end.
  PlantParts nozzle() {
    const double one = size("innerRadius", 0.4), other = size("outerRadius", 0.5), height = size("height", 1);
    const double inner = std::min(one, other), outer = std::max(one, other);
    const double flange = std::max(size("nozzleRadius", 0.6), outer),
                 thick = std::min(size("nozzleHeight", 0.1), height);
    PlantParts out;
    if (height > thick) out.push_back({pipe(inner, outer, height - thick, false), {0, -thick / 2, 0}});
    if (thick > 0) out.push_back({pipe(inner, flange, thick, true), {0, (height - thick) / 2, 0}});
    return out;
  }

  PlantParts plane() {
    auto across = from_.numbers("size"), centre = from_.numbers("center");
    if (across.size() < 2) across = {2, 2};
    if (centre.size() < 3) centre = {0, 0, 0};
    std::vector<double> points, places;
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
      points.insert(points.end(), {centre[0] + (x - 0.5) * across[0], centre[1] + (y - 0.5) * across[1], centre[2]});
      places.insert(places.end(), {x, y});
    }
    namespace f = k::indexed_face_set;
    const NodeId to = add(k::IndexedFaceSet), coord = add(k::Coordinate), texture = add(k::TextureCoordinate);
    scene_.set(coord, k::coordinate::point, points);
    scene_.set(texture, k::texture_coordinate::point, places);
    scene_.set(to, f::coord, coord, f::texCoord, texture, f::coordIndex, std::vector<std::int32_t>{0, 1, 2, 3, -1});
    set_solid(to, f::solid);
    return {{to}};
  }

  PlantParts solid_of_revolution() {
    const Revolution r{from_.numbers("crossSection"), from_.number("angle", 2 * std::numbers::pi),
                       from_.number("creaseAngle", 0), from_.flag("caps", true)};
    if (r.profile.size() / 2 > Revolution::most_points) report_first(Revolution::most_points, "points of crossSection");
    const NodeId to = faces_of(scene_, r, scene_.where(n_));
    if (!to) return {};
    set_solid(to, k::indexed_face_set::solid);
    return {{to}};
  }

  PlantParts sphere_segment() {
    const SphereNet net{size("radius", 1), from_.numbers("longitude"), from_.numbers("latitude")};
    if (std::max(net.longitude.size(), net.latitude.size()) > SphereNet::most_lines)
      report_first(SphereNet::most_lines, "lines of longitude and latitude");
    const NodeId to = faces_of(scene_, net, scene_.where(n_));
    if (!to) return {};
    set_solid(to, k::indexed_face_set::solid);
    return {{to}};
  }

  void report_first(std::size_t count, std::string_view of_what) {
    diag_.report(Diag::drawn_otherwise, scene_.where(n_), scene_.type(n_).name,
                 "with the first " + std::to_string(count) + " " + std::string(of_what));
  }

  Scene& scene_;
  NodeId n_;
  Diagnostics& diag_;
  ForeignFields from_;
};

NodeId shape_with(Scene& scene, NodeId shape, NodeId geometry) {
  const NodeId out = scene.add(k::Shape, scene.where(shape));
  scene.set_fields(out, scene.copy_of_fields(shape));
  scene.set(out, k::shape::geometry, geometry);
  return out;
}

void place(Scene& scene, NodeId to, const PlantPart& part, NodeId child) {
  namespace t = k::transform;
  scene.set(to, t::children, std::vector<NodeId>{child});
  if (part.translation != Vec3{0, 0, 0}) scene.set(to, t::translation, part.translation);
  if (part.lies) scene.set(to, t::rotation, Vec4{1, 0, 0, -std::numbers::pi / 2});
  if (part.scale != Vec3{1, 1, 1}) scene.set(to, t::scale, part.scale);
}

void give(Scene& scene, NodeId shape, const PlantParts& parts) {
  if (parts.size() == 1 && !parts[0].moved()) {
    scene.set(shape, k::shape::geometry, parts[0].geometry);
    return;
  }
  std::vector<NodeId> shapes;
  for (const PlantPart& part : parts) shapes.push_back(shape_with(scene, shape, part.geometry));
  if (parts.size() == 1) {
    scene.become(shape, k::Transform, {});
    return place(scene, shape, parts[0], shapes[0]);
  }
  std::vector<NodeId> children;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    children.push_back(scene.add(k::Transform, scene.where(shape)));
    place(scene, children.back(), parts[i], shapes[i]);
  }
  scene.become(shape, k::Group, {});
  scene.set(shape, k::group::children, children);
}

NodeId foreign_geometry(const Scene& scene, NodeId n) {
  if (!scene.is(n, k::Shape)) return {};
  const NodeId geometry = scene.get(n, k::shape::geometry);
  return geometry && scene.type(geometry).kind == NodeKind::unknown ? geometry : NodeId{};
}

/// Whether a prototype or events give it its values, which are not those that stand in it.
bool is_tied(const Scene& scene, NodeId n, const std::vector<char>& routed) {
  return (n.value < routed.size() && routed[n.value]) ||
         std::ranges::any_of(scene.fields(n), [&](const Value& v) { return scene.content(v).is; });
}

}  // namespace

bool lower_plant_shapes(Scene& scene, Diagnostics& diag) {
  if (!any_node(scene, [&](NodeId n) { return static_cast<bool>(foreign_geometry(scene, n)); })) return false;
  const auto driven = routed_nodes(scene);
  std::map<std::uint32_t, PlantParts> made;  // by geometry
  bool changed = false;
  for (const NodeId n : all_nodes(scene)) {
    const NodeId geometry = foreign_geometry(scene, n);
    if (!geometry || is_tied(scene, n, driven) || is_tied(scene, geometry, driven)) continue;
    const auto [at, is_new] = made.try_emplace(geometry.value);
    if (is_new) at->second = PlantShape(scene, geometry, diag).make();
    if (at->second.empty()) continue;
    if (is_new) scene.set_name(at->second[0].geometry, scene.name(geometry));
    give(scene, n, at->second);
    changed = true;
  }
  return changed;
}

}  // namespace wrlkit::x3d
