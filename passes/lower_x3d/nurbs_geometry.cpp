#include "passes/lower_x3d/nurbs_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "base/math/quaternion.h"
#include "base/math/vec.h"
#include "passes/lower_x3d/geometry.h"
#include "passes/lower_x3d/nurbs.h"
#include "passes/lower_x3d/trimming.h"
#include "scenegraph/nodes.h"

namespace wrlkit::x3d {
namespace {

namespace patch = nodes::nurbs_patch_surface;
namespace trimmed = nodes::nurbs_trimmed_surface;

struct Faces {
  std::vector<double> points, normals, texcoords;
  std::vector<std::int32_t> index;
};

class NurbsLowering {
 public:
  NurbsLowering(Scene& scene, NodeId n, double tolerance, Diagnostics& diag)
      : scene_(scene), n_(n), tolerance_(tolerance), diag_(diag) {}

  bool run() {
    const TypeId t = scene_.type_id(n_);
    if (t == nodes::CoordinateDouble)
      coordinate();
    else if (t == nodes::NurbsCurve)
      curve();
    else if (t == nodes::NurbsPatchSurface || t == nodes::NurbsTrimmedSurface)
      surface();
    else if (t == nodes::NurbsSweptSurface)
      swept();
    else if (t == nodes::NurbsSwungSurface)
      swung();
    else
      return false;
    return true;
  }

  bool interpolator() {
    if (scene_.is(n_, nodes::NurbsPositionInterpolator)) {
      keys(nodes::PositionInterpolator, FieldType::MFVec3f, false);
      return true;
    }
    if (scene_.is(n_, nodes::NurbsOrientationInterpolator)) {
      keys(nodes::OrientationInterpolator, FieldType::MFRotation, true);
      return true;
    }
    return false;
  }

  /// As the point that `key` and `places`, from 0 to 1 along u and v, lead over the surface.
  bool surface_interpolator(std::span<const double> key, std::span<const double> places) {
    constexpr std::size_t most_pieces = 64;
    const auto p = control_points(n_);
    const auto s = surface_of(n_, p, 3);
    const std::size_t n = std::min(key.size(), places.size() / 2);
    if (!s || n == 0) return false;
    const auto point = [&](std::size_t i, double t) {
      const auto place = [&](const Basis& b, std::size_t k) {
        const double from = places[2 * i + k], to = i + 1 < n ? places[2 * (i + 1) + k] : from;
        return b.first() + std::clamp(from + t * (to - from), 0.0, 1.0) * (b.last() - b.first());
      };
      return s->at(place(s->u, 0), place(s->v, 1));
    };
    const auto near = [&](std::size_t i, std::size_t pieces) {
      for (std::size_t k = 0; k < pieces; ++k) {
        const auto at = [&](double t) { return point(i, (static_cast<double>(k) + t) / static_cast<double>(pieces)); };
        if (length(at(0.5) - 0.5 * (at(0) + at(1))) > tolerance(p, 3)) return false;
      }
      return true;
    };
    std::vector<double> keys, values;
    for (std::size_t i = 0; i < n; ++i) {
      std::size_t pieces = 1;
      while (i + 1 < n && pieces < most_pieces && !near(i, pieces)) pieces *= 2;
      for (std::size_t k = 0; k < pieces; ++k) {
        const double t = static_cast<double>(k) / static_cast<double>(pieces);
        const Vec3 at = point(i, t);
        keys.push_back(i + 1 < n ? key[i] + t * (key[i + 1] - key[i]) : key[i]);
        values.insert(values.end(), at.begin(), at.end());
      }
    }
    become_interpolator(nodes::PositionInterpolator, FieldType::MFVec3f, keys, values);
    return true;
  }

 private:
  // ---- the values of the fields ----

  const Value& field(NodeId n, std::string_view name) const {
    return scene_.value(n, *scene_.type(n).find(name, Dialect::x3d));
  }
  std::span<const double> numbers(NodeId n, std::string_view name) const {
    const Value& v = field(n, name);
    return v.is ? std::span<const double>{} : v.number_span();
  }
  int integer(NodeId n, std::string_view name) const { return field(n, name).is ? 0 : field(n, name).integer; }

  void bad(const std::string& why) { diag_.report(Diag::bad_nurbs, scene_.where(n_), scene_.type(n_).name, why); }

  /// Control points of a node: of a Coordinate, or of one in double precision.
  std::span<const double> control_points(NodeId n) const {
    const NodeId c = field(n, "controlPoint").is ? NodeId{} : field(n, "controlPoint").node;
    if (scene_.is(c, nodes::Coordinate)) return scene_.get(c, nodes::coordinate::point);
    return scene_.is(c, nodes::CoordinateDouble) ? scene_.get(c, nodes::coordinate_double::point)
                                                 : std::span<const double>{};
  }

  std::vector<double> weights(NodeId n, std::size_t count) {
    auto given = numbers(n, "weight");
    if (given.empty()) return {};
    if (given.size() < count || !std::ranges::all_of(given, [](double w) { return w > 0 && std::isfinite(w); })) {
      diag_.report(Diag::x3d_repaired, scene_.where(n),
                   std::string(scene_.type(n).name) + ": a weight above 0 is needed for each control point; all are 1");
      return {};
    }
    return {given.begin(), given.begin() + static_cast<std::ptrdiff_t>(count)};
  }

  std::optional<Basis> basis(NodeId n, std::size_t count, std::string_view order, std::string_view knot) {
    bool replaced = false;
    const auto knots = numbers(n, knot);
    auto b = make_basis(integer(n, order), knots, count, replaced);
    if (!b)
      bad(std::to_string(count) + " control points for order " + std::to_string(integer(n, order)));
    else if (replaced && !knots.empty())
      diag_.report(Diag::x3d_repaired, scene_.where(n),
                   std::string(scene_.type(n).name) + ": " + std::string(knot) + " has no knots for " +
                       std::to_string(count) + " control points; equal steps are taken");
    return b;
  }

  /// None without a message where nothing is given, as for an IndexedFaceSet without coordinates.
  std::optional<Curve> curve_of(NodeId n) {
    if (!n) return std::nullopt;
    if (scene_.is(n, nodes::ContourPolyline2D)) {
      const auto p = scene_.get(n, nodes::contour_polyline2d::controlPoint);
      if (p.empty()) return std::nullopt;
      bool replaced = false;
      auto b = make_basis(2, {}, p.size() / 2, replaced);
      if (!b) {
        bad("a line has two points");
        return std::nullopt;
      }
      return Curve{*b, p, {}, 2};
    }
    const bool flat = scene_.is(n, nodes::NurbsCurve2D);
    if (!flat && !scene_.is(n, nodes::NurbsCurve) && !scene_.is(n, nodes::NurbsPositionInterpolator) &&
        !scene_.is(n, nodes::NurbsOrientationInterpolator)) {
      bad("a curve is missing");
      return std::nullopt;
    }
    const auto p = flat ? numbers(n, "controlPoint") : control_points(n);
    if (p.empty()) return std::nullopt;
    const std::size_t arity = flat ? 2 : 3;
    auto b = basis(n, p.size() / arity, "order", "knot");
    if (!b) return std::nullopt;
    return Curve{*b, p, weights(n, b->count), arity};
  }

  std::optional<Surface> surface_of(NodeId n, std::span<const double> p, std::size_t arity) {
    if (p.empty()) return std::nullopt;
    const auto u = static_cast<std::size_t>(std::max(integer(n, "uDimension"), 0)),
               v = static_cast<std::size_t>(std::max(integer(n, "vDimension"), 0));
    if (u == 0 || v == 0 || p.size() / arity / u < v) {
      bad(std::to_string(p.size() / arity) + " control points for " + std::to_string(u) + " x " + std::to_string(v));
      return std::nullopt;
    }
    auto along_u = basis(n, u, "uOrder", "uKnot"), along_v = basis(n, v, "vOrder", "vKnot");
    if (!along_u || !along_v) return std::nullopt;
    return Surface{*along_u, *along_v, p, weights(n, u * v), arity};
  }

  static double diagonal(std::span<const double> p, std::size_t arity) {
    double sum = 0;
    for (std::size_t k = 0; k < arity && p.size() >= arity; ++k) {
      double low = p[k], high = p[k];
      for (std::size_t i = k; i < p.size(); i += arity) {
        low = std::min(low, p[i]);
        high = std::max(high, p[i]);
      }
      sum += (high - low) * (high - low);
    }
    return std::sqrt(sum);
  }

  double tolerance(std::span<const double> p, std::size_t arity) const {
    constexpr double part = 0.001;
    return tolerance_ > 0 ? tolerance_ : part * diagonal(p, arity);
  }

  std::vector<double> cuts_of(const Curve& c, NodeId n) const {
    if (scene_.is(n, nodes::ContourPolyline2D)) return {c.basis.knots.begin() + 1, c.basis.knots.end() - 1};
    const bool interpolator = !scene_.type(n).find("tessellation", Dialect::x3d);
    return cuts(c, tolerance(c.points, c.arity), interpolator ? 0 : integer(n, "tessellation"));
  }

  std::vector<double> points_of(const Curve& c, const std::vector<double>& at) const {
    std::vector<double> out;
    for (double t : at) {
      const Vec3 p = c.at(t);
      out.insert(out.end(), p.begin(), p.begin() + static_cast<std::ptrdiff_t>(c.arity));
    }
    return out;
  }

  // ---- what becomes of them ----

  void coordinate() {
    auto fields = fields_for(scene_, n_, nodes::Coordinate);
    fields.push_back(scene_.make(FieldType::MFVec3f, nodes::coordinate::point.slot,
                                 scene_.get(n_, nodes::coordinate_double::point)));
    scene_.become(n_, nodes::Coordinate, fields);
  }

  NodeId child(TypeId type, FieldType t, std::uint16_t slot, std::span<const double> values) {
    NodeId i = scene_.add(type, scene_.where(n_));
    scene_.set(i, scene_.make(t, slot, values));
    return i;
  }

  void curve() {
    namespace l = nodes::indexed_line_set;
    std::vector<double> points;
    if (auto c = curve_of(n_)) points = points_of(*c, cuts_of(*c, n_));
    std::vector<std::int32_t> index(points.size() / 3);
    for (std::size_t i = 0; i < index.size(); ++i) index[i] = static_cast<std::int32_t>(i);
    auto fields = fields_for(scene_, n_, nodes::IndexedLineSet);
    fields.push_back(scene_.make(FieldType::SFNode, l::coord.slot,
                                 child(nodes::Coordinate, FieldType::MFVec3f, nodes::coordinate::point.slot, points)));
    fields.push_back(scene_.make(FieldType::MFInt32, l::coordIndex.slot, index));
    scene_.become(n_, nodes::IndexedLineSet, fields);
  }

  void become_faces(const Faces& f) {
    namespace s = nodes::indexed_face_set;
    auto fields = fields_for(scene_, n_, nodes::IndexedFaceSet);
    std::erase_if(fields, [&](const Value& v) { return !scene_.is_extra(v) && v.slot == s::texCoord.slot; });
    fields.push_back(
        scene_.make(FieldType::SFNode, s::coord.slot,
                    child(nodes::Coordinate, FieldType::MFVec3f, nodes::coordinate::point.slot, f.points)));
    fields.push_back(scene_.make(FieldType::MFInt32, s::coordIndex.slot, f.index));
    fields.push_back(scene_.make(FieldType::SFNode, s::normal.slot,
                                 child(nodes::Normal, FieldType::MFVec3f, nodes::normal::vector.slot, f.normals)));
    fields.push_back(scene_.make(
        FieldType::SFNode, s::texCoord.slot,
        child(nodes::TextureCoordinate, FieldType::MFVec2f, nodes::texture_coordinate::point.slot, f.texcoords)));
    scene_.become(n_, nodes::IndexedFaceSet, fields);
  }

  /// Without those that have two corners in one place.
  static void triangle(Faces& f, std::size_t a, std::size_t b, std::size_t c, double smallest) {
    auto point = [&](std::size_t i) { return Vec3{f.points[3 * i], f.points[3 * i + 1], f.points[3 * i + 2]}; };
    auto apart = [&](std::size_t i, std::size_t j) { return length(point(i) - point(j)) > smallest; };
    if (apart(a, b) && apart(b, c) && apart(c, a))
      f.index.insert(f.index.end(),
                     {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c), -1});
  }

  static void triangles(Faces& f, std::size_t columns, double smallest) {
    for (std::size_t i = columns; i < f.points.size() / 3; ++i) {
      if (i % columns == 0) continue;
      const std::size_t below = i - columns;
      triangle(f, below - 1, below, i, smallest);
      triangle(f, below - 1, i, i - 1, smallest);
    }
  }

  /// Where the surface has a point, the normal is that of its neighbourhood.
  static Vec3 normal(const Surface& s, double u, double v) {
    constexpr double aside = 1e-4;
    const Vec3 n = s.across(u, v);
    auto inwards = [&](const Basis& b, double t) { return t + ((b.first() + b.last()) / 2 - t) * aside; };
    const Vec3 near = s.across(inwards(s.u, u), inwards(s.v, v));
    return unit(length(n) > 1e-6 * length(near) ? n : near);
  }

  /// What the trimming contours are made of: their curves, one behind the other.
  std::vector<std::vector<Vec2>> contours(const Surface& s) {
    constexpr double part = 0.0005;
    constexpr std::size_t most = 1'000'000;
    std::vector<std::vector<Vec2>> out;
    if (!scene_.is(n_, nodes::NurbsTrimmedSurface)) return out;
    const double size = std::hypot(s.u.last() - s.u.first(), s.v.last() - s.v.first());
    std::size_t count = 0;
    for (NodeId contour : scene_.get(n_, trimmed::trimmingContour)) {
      if (!scene_.is(contour, nodes::Contour2D)) continue;
      auto& points = out.emplace_back();
      for (NodeId child : scene_.get(contour, nodes::contour2d::children)) {
        const auto c = curve_of(child);
        if (!c || c->arity != 2 || count > most) continue;
        const bool lines = scene_.is(child, nodes::ContourPolyline2D);
        const auto at = lines ? cuts_of(*c, child) : cuts(*c, part * size, integer(child, "tessellation"));
        for (double t : at) points.push_back({c->at(t)[0], c->at(t)[1]});
      }
      count += points.size();
    }
    if (count > most) out.clear();
    return out;
  }

  void surface() {
    const auto p = control_points(n_);
    Faces f;
    if (auto s = surface_of(n_, p, 3)) {
      const Grid g = cuts(*s, tolerance(p, 3), integer(n_, "uTessellation"), integer(n_, "vTessellation"));
      auto cut = trim(g, contours(*s));
      const bool whole = cut.triangles.empty();
      if (whole) {
        if (scene_.is(n_, nodes::NurbsTrimmedSurface) && !scene_.get(n_, trimmed::trimmingContour).empty())
          diag_.report(Diag::untrimmed, scene_.where(n_));
        cut.points.clear();
        for (double v : g.v)
          for (double u : g.u) cut.points.push_back({u, v});
      }
      for (const auto& [u, v] : cut.points) {
        const Vec3 at = s->at(u, v), n = normal(*s, u, v);
        f.points.insert(f.points.end(), at.begin(), at.end());
        f.normals.insert(f.normals.end(), n.begin(), n.end());
      }
      f.texcoords = texcoords(*s, cut.points);
      const double smallest = 1e-9 * diagonal(p, 3);
      if (whole)
        triangles(f, g.u.size(), smallest);
      else
        for (std::size_t i = 0; i < cut.triangles.size(); i += 3)
          triangle(f, cut.triangles[i], cut.triangles[i + 1], cut.triangles[i + 2], smallest);
    }
    become_faces(f);
  }

  std::vector<double> texcoords(const Surface& s, const std::vector<Vec2>& points) {
    const NodeId t = field(n_, "texCoord").is ? NodeId{} : field(n_, "texCoord").node;
    std::optional<Surface> map;
    if (scene_.is(t, nodes::TextureCoordinate) &&
        scene_.get(t, nodes::texture_coordinate::point).size() >= 2 * s.u.count * s.v.count)
      map = Surface{s.u, s.v, scene_.get(t, nodes::texture_coordinate::point), s.weights, 2};
    else if (scene_.is(t, nodes::NurbsTextureCoordinate))
      map = surface_of(t, scene_.get(t, nodes::nurbs_texture_coordinate::controlPoint), 2);
    std::vector<double> out;
    auto part = [](const Basis& b, double x) { return (x - b.first()) / (b.last() - b.first()); };
    for (const auto& [u, v] : points) {
      const Vec3 at = map ? map->at(u, v) : Vec3{part(s.u, u), part(s.v, v), 0};
      out.insert(out.end(), {at[0], at[1]});
    }
    return out;
  }

  NodeId curve_node(std::string_view name) const { return field(n_, name).is ? NodeId{} : field(n_, name).node; }

  void swept() {
    namespace e = nodes::extrusion;
    const NodeId across = curve_node("crossSectionCurve"), along = curve_node("trajectoryCurve");
    auto fields = fields_for(scene_, n_, nodes::Extrusion);
    auto section = curve_of(across), way = curve_of(along);
    std::vector<double> section_points, spine;
    if (section && way && section->arity == 2 && way->arity == 3) {
      section_points = points_of(*section, cuts_of(*section, across));
      spine = points_of(*way, cuts_of(*way, along));
    }
    fields.push_back(scene_.make(FieldType::MFVec2f, e::crossSection.slot, section_points));
    fields.push_back(scene_.make(FieldType::MFVec3f, e::spine.slot, spine));
    for (std::uint16_t slot : {e::beginCap.slot, e::endCap.slot})
      fields.push_back(scene_.make(FieldType::SFBool, slot, false));
    fields.push_back(scene_.make(FieldType::SFFloat, e::creaseAngle.slot, std::numbers::pi));
    scene_.become(n_, nodes::Extrusion, fields);
  }

  /// (r, y) of the profile times (x, z) of the way around: The NURBS Book, 8.3. Two splines make one surface.
  void swung() {
    const NodeId around = curve_node("trajectoryCurve"), up = curve_node("profileCurve");
    auto way = curve_of(around), profile = curve_of(up);
    Faces f;
    if (way && profile && way->arity == 2 && profile->arity == 2) {
      const auto us = cuts_of(*profile, up), vs = cuts_of(*way, around);
      const double reach = diagonal(profile->points, 2) + 1, nudge = 1e-4;
      auto at = [&](double u, double v) {
        const Vec3 p = profile->at(u), t = way->at(v);
        return Vec3{p[0] * t[0], p[1], p[0] * t[1]};
      };
      auto slope = [&](const Basis& b, double t, auto point) {  // by differences, inside of the ends
        const double h = (b.last() - b.first()) * nudge, from = std::max(t - h, b.first()),
                     to = std::min(t + h, b.last());
        return point(to) - point(from);
      };
      for (std::size_t j = 0; j < vs.size(); ++j)
        for (std::size_t i = 0; i < us.size(); ++i) {
          const double u = us[i], v = vs[j];
          const Vec3 p = at(u, v);
          // Next to the axis, where the surface has a point.
          const double inner = u + ((profile->basis.first() + profile->basis.last()) / 2 - u) * nudge;
          const Vec3 n = unit(cross(slope(profile->basis, u, [&](double t) { return at(t, v); }),
                                    slope(way->basis, v, [&](double t) { return at(inner, t); })));
          f.points.insert(f.points.end(), p.begin(), p.end());
          f.normals.insert(f.normals.end(), n.begin(), n.end());
          f.texcoords.insert(f.texcoords.end(), {static_cast<double>(i) / static_cast<double>(us.size() - 1),
                                                 static_cast<double>(j) / static_cast<double>(vs.size() - 1)});
        }
      triangles(f, us.size(), 1e-9 * reach);
    }
    become_faces(f);
  }

  /// Keys by the parameter of the curve, from 0 to 1.
  void keys(TypeId type, FieldType values, bool directions) {
    std::vector<double> key, value;
    if (auto c = curve_of(n_)) {
      const Basis& b = c->basis;
      for (double t : cuts_of(*c, n_)) {
        const double part = (t - b.first()) / (b.last() - b.first());
        key.push_back(part);
        if (!directions) {
          const Vec3 p = c->at(t);
          value.insert(value.end(), p.begin(), p.end());
          continue;
        }
        constexpr double nudge = 1e-4;
        const double h = (b.last() - b.first()) * nudge;
        const Vec4 turn = from_z(unit(c->at(std::min(t + h, b.last())) - c->at(std::max(t - h, b.first()))));
        value.insert(value.end(), turn.begin(), turn.end());
      }
    }
    become_interpolator(type, values, key, value);
  }

  void become_interpolator(TypeId type, FieldType values, const std::vector<double>& key,
                           const std::vector<double>& value) {
    auto fields = fields_for(scene_, n_, type);
    auto slot = [&](std::string_view name) { return *scene_.type(type).find(name, Dialect::x3d); };
    fields.push_back(scene_.make(FieldType::MFFloat, slot("key"), key));
    fields.push_back(scene_.make(values, slot("keyValue"), value));
    scene_.become(n_, type, fields);
  }

  /// The shortest turn from Z to a direction.
  static Vec4 from_z(const Vec3& d) {
    const Vec3 axis = cross({0, 0, 1}, d);
    const double sine = length(axis);
    if (sine < 1e-12) return d[2] < 0 ? Vec4{0, 1, 0, std::numbers::pi} : Vec4{0, 0, 1, 0};
    return {axis[0] / sine, axis[1] / sine, axis[2] / sine, std::atan2(sine, d[2])};
  }

  Scene& scene_;
  NodeId n_;
  double tolerance_;
  Diagnostics& diag_;
};

}  // namespace

bool lower_nurbs(Scene& scene, NodeId n, double tolerance, Diagnostics& diag) {
  return NurbsLowering(scene, n, tolerance, diag).run();
}
bool lower_nurbs_interpolator(Scene& scene, NodeId n, double tolerance, Diagnostics& diag) {
  return NurbsLowering(scene, n, tolerance, diag).interpolator();
}
bool lower_surface_interpolator(Scene& scene, NodeId n, std::span<const double> key, std::span<const double> places,
                                double tolerance, Diagnostics& diag) {
  return NurbsLowering(scene, n, tolerance, diag).surface_interpolator(key, places);
}

}  // namespace wrlkit::x3d
