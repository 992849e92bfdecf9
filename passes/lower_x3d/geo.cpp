#include "passes/lower_x3d/geo.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "base/math/quaternion.h"
#include "base/math/vec.h"
#include "passes/lower_x3d/earth.h"
#include "passes/lower_x3d/geometry.h"
#include "scenegraph/any_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scopes.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

/// The fields that give a node's place on Earth.
struct GeoRow {
  TypeId type;
  std::string_view place;
  bool origin_last = false;  // of the places that an origin is taken from these are the last
};

constexpr GeoRow rows[] = {
    {nodes::GeoLocation, "geoCoords"},
    {nodes::GeoCoordinate, "point"},
    {nodes::GeoElevationGrid, "geoGridOrigin"},
    {nodes::GeoTransform, "geoCenter"},
    {nodes::GeoLOD, "center"},
    {nodes::GeoPositionInterpolator, "keyValue"},
    {nodes::GeoTouchSensor, {}, true},
    {nodes::GeoViewpoint, "position", true},
    {nodes::GeoProximitySensor, "geoCenter", true},
};

const GeoRow* row_of(const Scene& scene, NodeId n) {
  auto row = std::ranges::find(rows, scene.type_id(n), &GeoRow::type);
  return row == std::end(rows) ? nullptr : row;
}

Matrix transposed(const Matrix& m) {
  return {{m(0, 0), m(1, 0), m(2, 0), 0, m(0, 1), m(1, 1), m(2, 1), 0, m(0, 2), m(1, 2), m(2, 2), 0}};
}

Vec3 vec3(std::span<const double> numbers, std::size_t i = 0) { return {numbers[i], numbers[i + 1], numbers[i + 2]}; }

/// "48.8583 2.2945 33 (latitude, longitude, height)".
std::string text_of(const Vec3& geodetic) {
  constexpr int digits[] = {7, 7, 3};  // a centimetre, and a millimetre
  std::string out;
  for (std::size_t i = 0; i < 3; ++i) {
    char b[64];
    std::string number(b, std::to_chars(b, b + sizeof b, geodetic[i], std::chars_format::fixed, digits[i]).ptr);
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
    out += (number == "-0" ? "0" : number) + ' ';
  }
  return out + "(latitude, longitude, height)";
}

class Placing {
 public:
  Placing(Scene& scene, Diagnostics& diag) : scene_(scene), diag_(diag) {}

  bool run() {
    if (!any_node(scene_, [&](NodeId n) { return row_of(scene_, n) != nullptr; })) return false;
    const auto all = all_nodes(scene_);
    std::vector<NodeId> found;
    std::ranges::copy_if(all, std::back_inserter(found), [&](NodeId n) { return row_of(scene_, n) != nullptr; });
    if (found.empty()) return false;
    choose_origin(all, found);
    for_each_scope(scene_, [&](Scope& s) { routes(s); });
    for (NodeId n : found) place(n);
    return true;
  }

 private:
  struct Stand {
    Vec3 at;      // in the world that is made
    Matrix turn;  // to its axes, from east, up and south of that place
  };

  // ---- the origin ----

  void choose_origin(const std::vector<NodeId>& all, const std::vector<NodeId>& found) {
    namespace o = nodes::geo_origin;
    auto given = std::ranges::find_if(all, [&](NodeId n) { return scene_.is(n, nodes::GeoOrigin); });
    if (given != all.end())
      return set_origin(*given, scene_.get(*given, o::geoCoords), scene_.get(*given, o::rotateYUp));
    for (bool last : {false, true})
      for (NodeId n : found) {
        const GeoRow& row = *row_of(scene_, n);
        if (row.origin_last != last || row.place.empty()) continue;
        const auto numbers = scene_.value(n, *scene_.type(n).find(row.place, Dialect::x3d)).number_span();
        if (numbers.size() >= 3) return set_origin(n, vec3(numbers), true);
      }
  }

  void set_origin(NodeId n, const Vec3& place, bool up) {
    const GeoSystem& s = system(n);
    origin_ = geocentric(s, place);
    const Vec3 there = geodetic(s.ellipsoid, origin_);
    if (up) axes_ = transposed(standing_at(there));
    diag_.report(Diag::no_vrml97_place, scene_.where(n), text_of(there));
  }

  // ---- places ----

  /// What the numbers of a node mean.
  const GeoSystem& system(NodeId n) {
    const Value* v = scene_.find(n, *scene_.type(n).find("geoSystem", Dialect::x3d));
    std::string key;
    if (v && !v->is)
      for (std::string_view word : v->text_span()) (key += word) += '\n';
    auto [i, fresh] = systems_.try_emplace(key);
    if (!fresh) return i->second;
    std::vector<std::string> unknown;
    if (v && !v->is) i->second = geo_system(v->text_span(), unknown);
    constexpr std::string_view kinds[] = {"GD", "UTM", "GC"};
    for (const auto& word : unknown)
      diag_.report(
          Diag::unknown_geo_system, scene_.where(n), word,
          word == "WGS84" ? "the height above the ellipsoid" : kinds[static_cast<std::size_t>(i->second.kind)]);
    return i->second;
  }

  /// Without what is beyond the digits of the coordinates.
  Vec3 world(const Vec3& geocentric) const {
    constexpr double steps = 1e7;  // in a metre
    Vec3 p = axes_.point(geocentric - origin_);
    for (double& x : p) x = std::round(x * steps) / steps + 0.0;
    return p;
  }
  Vec3 world(const GeoSystem& s, const Vec3& place) const { return world(geocentric(s, place)); }

  Stand stand(const GeoSystem& s, const Vec3& place) const {
    const Vec3 at = geocentric(s, place);
    Matrix turn = axes_ * standing_at(geodetic(s.ellipsoid, at));
    for (double& x : turn.m) x = std::round(x * 1e13) / 1e13;
    return {world(at), turn};
  }

  Stand stand(NodeId n, const Vec3& place) { return stand(system(n), place); }

  std::vector<double> world_points(NodeId n, std::span<const double> places) {
    const GeoSystem& s = system(n);
    std::vector<double> out;
    out.reserve(places.size());
    for (std::size_t i = 0; i + 2 < places.size(); i += 3) {
      const Vec3 p = world(s, vec3(places, i));
      out.insert(out.end(), p.begin(), p.end());
    }
    return out;
  }

  // ---- nodes ----

  void place(NodeId n) {
    for (const Value& v : scene_.fields(n))
      if (v.is && !scene_.is_extra(v) && scene_.type(n).fields[v.slot].name == row_of(scene_, n)->place)
        diag_.report(Diag::no_vrml97_value, scene_.where(n), scene_.type(n).name, scene_.type(n).fields[v.slot].name);
    const TypeId t = scene_.type_id(n);
    if (t == nodes::GeoLocation)
      location(n);
    else if (t == nodes::GeoCoordinate)
      coordinate(n);
    else if (t == nodes::GeoElevationGrid)
      grid(n);
    else if (t == nodes::GeoTransform)
      transform(n);
    else if (t == nodes::GeoViewpoint)
      viewpoint(n);
    else if (t == nodes::GeoPositionInterpolator)
      interpolator(n);
    else if (t == nodes::GeoLOD)
      level_of_detail(n);
    else if (t == nodes::GeoProximitySensor)
      proximity(n);
    else
      scene_.become(n, nodes::TouchSensor, fields_for(scene_, n, nodes::TouchSensor));
  }

  void location(NodeId n) {
    namespace t = nodes::transform;
    const Stand s = stand(n, scene_.get(n, nodes::geo_location::geoCoords));
    auto fields = fields_for(scene_, n, nodes::Transform);
    fields.push_back(scene_.make(FieldType::SFVec3f, t::translation.slot, s.at));
    fields.push_back(scene_.make(FieldType::SFRotation, t::rotation.slot, axis_angle(s.turn)));
    scene_.become(n, nodes::Transform, fields);
  }

  void coordinate(NodeId n) {
    auto fields = fields_for(scene_, n, nodes::Coordinate);
    fields.push_back(scene_.make(FieldType::MFVec3f, nodes::coordinate::point.slot,
                                 world_points(n, scene_.get(n, nodes::geo_coordinate::point))));
    scene_.become(n, nodes::Coordinate, fields);
  }

  /// The node's own turn and scale, in the axes of its centre: into them, moved, and back.
  void transform(NodeId n) {
    namespace t = nodes::transform;
    const Stand s = stand(n, scene_.get(n, nodes::geo_transform::geoCenter));
    const Vec4 turn = axis_angle(s.turn), back{turn[0], turn[1], turn[2], -turn[3]};
    const Vec3 away = rotation_matrix(back).point(-1.0 * s.at);
    auto fields = fields_for(scene_, n, nodes::Transform);
    auto own = [&](std::uint16_t slot) {
      return slot == t::rotation.slot || slot == t::scale.slot || slot == t::scaleOrientation.slot ||
             slot == t::translation.slot;
    };
    NodeId inner = scene_.add(nodes::Transform, scene_.where(n)), moved = scene_.add(nodes::Transform, scene_.where(n));
    scene_.set(inner, t::translation, away, t::rotation, back);
    std::vector<Value> outer;
    for (const Value& v : fields) {
      if (!scene_.is_extra(v) && own(v.slot))
        scene_.set(moved, v);
      else if (!scene_.is_extra(v) && v.slot == t::children.slot)
        scene_.set(inner, v);
      else
        outer.push_back(v);
    }
    scene_.set(moved, t::children, std::vector<NodeId>{inner});
    outer.push_back(scene_.make(FieldType::SFVec3f, t::translation.slot, s.at));
    outer.push_back(scene_.make(FieldType::SFRotation, t::rotation.slot, turn));
    outer.push_back(scene_.make(FieldType::MFNode, t::children.slot, std::vector<NodeId>{moved}));
    scene_.become(n, nodes::Transform, outer);
  }

  void viewpoint(NodeId n) {
    namespace g = nodes::geo_viewpoint;
    namespace v = nodes::viewpoint;
    const Stand s = stand(n, scene_.get(n, g::position));
    auto fields = fields_for(scene_, n, nodes::Viewpoint);
    std::erase_if(fields, [&](const Value& f) { return !scene_.is_extra(f) && f.slot == v::orientation.slot; });
    fields.push_back(scene_.make(FieldType::SFVec3f, v::position.slot, s.at));
    fields.push_back(scene_.make(FieldType::SFRotation, v::orientation.slot,
                                 axis_angle(s.turn * rotation_matrix(scene_.get(n, g::orientation)))));
    if (scene_.find(n, g::centerOfRotation.slot))
      fields.push_back(scene_.make(FieldType::SFVec3f, v::centerOfRotation.slot,
                                   world(system(n), scene_.get(n, g::centerOfRotation))));
    for (std::uint16_t slot : {g::headlight.slot, g::navType.slot, g::speedFactor.slot})
      if (scene_.find(n, slot))
        diag_.report(Diag::no_vrml97_value, scene_.where(n), "GeoViewpoint", scene_.type(n).fields[slot].name);
    scene_.become(n, nodes::Viewpoint, fields);
  }

  void interpolator(NodeId n) {
    auto fields = fields_for(scene_, n, nodes::PositionInterpolator);
    fields.push_back(scene_.make(FieldType::MFVec3f, nodes::position_interpolator::keyValue.slot,
                                 world_points(n, scene_.get(n, nodes::geo_position_interpolator::keyValue))));
    scene_.become(n, nodes::PositionInterpolator, fields);
  }

  void proximity(NodeId n) {
    auto fields = fields_for(scene_, n, nodes::ProximitySensor);
    fields.push_back(scene_.make(FieldType::SFVec3f, nodes::proximity_sensor::center.slot,
                                 world(system(n), scene_.get(n, nodes::geo_proximity_sensor::geoCenter))));
    scene_.become(n, nodes::ProximitySensor, fields);
  }

  /// The near level is the four children, the far one is the root: nodes, or an Inline of its own url. Nodes that a
  /// file gives in `children`, which is an event of the standard (25.3.5), are part of the near level.
  void level_of_detail(NodeId n) {
    namespace g = nodes::geo_lod;
    namespace l = nodes::lod;
    auto inlined = [&](std::span<const std::string_view> url) {
      NodeId i = scene_.add(nodes::Inline, scene_.where(n));
      scene_.set(i, nodes::inline_::url, std::vector<std::string_view>(url.begin(), url.end()));
      return i;
    };
    auto group = [&](const std::vector<NodeId>& children) {
      NodeId i = scene_.add(nodes::Group, scene_.where(n));
      scene_.set(i, nodes::group::children, children);
      return i;
    };
    std::vector<NodeId> near, far;
    for (auto url : {scene_.get(n, g::child1Url), scene_.get(n, g::child2Url), scene_.get(n, g::child3Url),
                     scene_.get(n, g::child4Url)})
      if (!url.empty()) near.push_back(inlined(url));
    for (NodeId c : scene_.get(n, g::children)) near.push_back(c);
    for (NodeId c : scene_.get(n, g::rootNode)) far.push_back(c);
    if (far.empty() && !scene_.get(n, g::rootUrl).empty()) far.push_back(inlined(scene_.get(n, g::rootUrl)));
    auto fields = fields_for(scene_, n, nodes::LOD);
    std::erase_if(fields, [&](const Value& v) {
      return !scene_.is_extra(v) && (v.slot == l::center.slot || v.slot == l::range.slot || v.slot == l::children.slot);
    });
    const bool both = !near.empty();
    std::vector<NodeId> levels{group(far)};
    if (both) levels.insert(levels.begin(), group(near));
    fields.push_back(scene_.make(FieldType::MFNode, l::children.slot, levels));
    fields.push_back(scene_.make(FieldType::SFVec3f, l::center.slot, world(system(n), scene_.get(n, g::center))));
    if (both)
      fields.push_back(scene_.make(FieldType::MFFloat, l::range.slot, std::vector<double>{scene_.get(n, g::range)}));
    scene_.become(n, nodes::LOD, fields);
  }

  /// Rows from south to north, each from west to east: seen from above, that is counterclockwise.
  void grid(NodeId n) {
    namespace g = nodes::geo_elevation_grid;
    namespace f = nodes::indexed_face_set;
    const auto height = scene_.get(n, g::height);
    const auto columns = static_cast<std::size_t>(std::max(scene_.get(n, g::xDimension), 0));
    auto n_rows = static_cast<std::size_t>(std::max(scene_.get(n, g::zDimension), 0));
    if (columns > 0 && height.size() / columns < n_rows) {
      diag_.report(Diag::short_height, scene_.where(n), "GeoElevationGrid", height.size(), columns, n_rows);
      n_rows = height.size() / columns;
    }
    const GeoSystem& s = system(n);
    const Vec3 corner = scene_.get(n, g::geoGridOrigin);
    const double step[] = {scene_.get(n, g::zSpacing), scene_.get(n, g::xSpacing)}, factor = scene_.get(n, g::yScale);
    const std::size_t north = s.east_first ? 1 : 0, east = 1 - north;
    std::vector<double> points, texcoords;
    std::vector<std::int32_t> index;
    for (std::size_t r = 0; r < n_rows; ++r)
      for (std::size_t c = 0; c < columns; ++c) {
        Vec3 place = corner;
        place[north] += static_cast<double>(r) * step[0];
        place[east] += static_cast<double>(c) * step[1];
        place[2] += height[r * columns + c] * factor;
        const Vec3 p = world(s, place);
        points.insert(points.end(), p.begin(), p.end());
        texcoords.push_back(columns > 1 ? static_cast<double>(c) / static_cast<double>(columns - 1) : 0);
        texcoords.push_back(n_rows > 1 ? static_cast<double>(r) / static_cast<double>(n_rows - 1) : 0);
        if (r == 0 || c == 0) continue;
        const auto here = static_cast<std::int32_t>(r * columns + c), below = here - static_cast<std::int32_t>(columns);
        index.insert(index.end(), {below - 1, below, here, here - 1, -1});
      }
    auto fields = fields_for(scene_, n, nodes::IndexedFaceSet);
    auto child = [&](TypeId type, std::uint16_t slot, std::uint16_t list, FieldType t,
                     const std::vector<double>& numbers) {
      NodeId i = scene_.add(type, scene_.where(n));
      scene_.set(i, scene_.make(t, list, numbers));
      fields.push_back(scene_.make(FieldType::SFNode, slot, i));
    };
    child(nodes::Coordinate, f::coord.slot, nodes::coordinate::point.slot, FieldType::MFVec3f, points);
    if (!scene_.get(n, g::texCoord))
      child(nodes::TextureCoordinate, f::texCoord.slot, nodes::texture_coordinate::point.slot, FieldType::MFVec2f,
            texcoords);
    fields.push_back(scene_.make(FieldType::MFInt32, f::coordIndex.slot, index));
    fields.push_back(scene_.make(FieldType::SFFloat, f::creaseAngle.slot, scene_.get(n, g::creaseAngle)));
    scene_.become(n, nodes::IndexedFaceSet, fields);
  }

  // ---- ROUTEs ----

  /// What carries places on Earth carries those of the world from now on; what only Earth knows leads nowhere.
  std::optional<std::string_view> event(NodeId n, std::string_view name) {
    struct Renamed {
      TypeId type;
      std::string_view field, is;
    };
    constexpr Renamed renamed[] = {{nodes::GeoPositionInterpolator, "geovalue_changed", "value_changed"},
                                   {nodes::GeoLocation, "geoCoords", "translation"},
                                   {nodes::GeoViewpoint, "set_position", "set_position"},
                                   {nodes::GeoTouchSensor, "hitGeoCoord_changed", {}},
                                   {nodes::GeoProximitySensor, "geoCoord_changed", {}},
                                   {nodes::GeoElevationGrid, "set_height", {}},
                                   {nodes::GeoTransform, "geoCenter", {}},
                                   {nodes::GeoLOD, "children", {}}};
    const auto slot = scene_.type(n).find(name, Dialect::x3d, true);
    if (!slot || !row_of(scene_, n)) return name;
    const auto field = scene_.type(n).fields[*slot].name;
    for (const auto& r : renamed)
      if (scene_.is(n, r.type) && field == r.field) {
        if (r.is.empty()) return std::nullopt;
        std::string s(name);
        return scene_.keep(s.replace(s.find(field), field.size(), r.is));
      }
    return name;
  }

  void routes(Scope& scope) {
    auto carries_place = [&](const Route& r) { return scene_.is(r.from, nodes::GeoPositionInterpolator); };
    auto takes_place = [&](const Route& r) {
      return (scene_.is(r.to, nodes::GeoLocation) && r.event_in.find("geoCoords") != r.event_in.npos) ||
             (scene_.is(r.to, nodes::GeoViewpoint) && r.event_in == "set_position");
    };
    std::vector<Route> kept;
    for (Route r : scope.routes) {
      const auto from = event(r.from, r.event_out), to = event(r.to, r.event_in);
      if (!from)
        diag_.report(Diag::no_vrml97_value, scene_.where(r.from), scene_.type(r.from).name, r.event_out);
      else if (!to || (takes_place(r) && !carries_place(r)))
        diag_.report(Diag::no_vrml97_value, scene_.where(r.to), scene_.type(r.to).name, r.event_in);
      else
        kept.push_back({r.from, r.to, *from, *to});
    }
    scope.routes = std::move(kept);
  }

  Scene& scene_;
  Diagnostics& diag_;
  Vec3 origin_{0, 0, 0};  // geocentric
  Matrix axes_;           // from geocentric to the world
  std::map<std::string, GeoSystem> systems_;
};

}  // namespace

bool place_on_earth(Scene& scene, Diagnostics& diag) { return Placing(scene, diag).run(); }

}  // namespace wrlkit::x3d
