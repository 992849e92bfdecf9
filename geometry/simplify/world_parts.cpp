#include "geometry/simplify/world_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "base/math/affine.h"
#include "base/math/box.h"
#include "base/math/saturating.h"
#include "base/math/vec.h"
#include "base/parallel.h"
#include "geometry/simplify/closest_on_triangle.h"
#include "geometry/simplify/like_form.h"
#include "geometry/simplify/pieces.h"
#include "geometry/simplify/shared_borders.h"
#include "geometry/simplify/surface_places.h"
#include "geometry/simplify/surface_scales.h"
#include "scenegraph/nodes.h"
#include "scenegraph/places/places.h"

namespace wrlkit::simplify {
namespace {

constexpr std::size_t most_places_asked = 4;  // of a ladder, for what hides it
constexpr std::size_t ladder_samples_of_face = 8, least_ladder_samples = 400,
                      most_ladder_samples = 20'000;  // of a ladder
constexpr std::size_t parts_at_once = 4096;
constexpr std::size_t most_alike = 64;  // forms with the same corners
// Samples for when a part leaves, in a place: of large parts, of the others; and of all in all places.
constexpr std::size_t of_large = 32, of_small = 12, most_leaving = 4'000'000;
// Of what is shown in very many places, some are looked at: triangles of all neighbours, places of a part that leaves.
constexpr std::uint64_t most_neighbours = 8'000'000;
constexpr std::size_t most_left_from = 1024;

/// Normals as long as twice the area of each face.
std::vector<Vec3> area_normals(const Triangles& surface, std::span<const std::uint32_t> faces) {
  std::vector<Vec3> out;
  out.reserve(faces.size());
  for (auto f : faces)
    if (const auto c = surface[f]; is_usable(c)) out.push_back(area_normal(c));
  return out;
}

/// Where a map takes area normals: its cofactors.
Matrix map_of_area_normals(const Matrix& m) {
  const Vec3 x = m.column(0), y = m.column(1), z = m.column(2);
  return matrix_of_columns(cross(y, z), cross(z, x), cross(x, y));
}

double area_of(std::span<const Vec3> area_normals, const Matrix& place) {
  const Matrix map = map_of_area_normals(place);
  double area = 0;
  for (const Vec3& n : area_normals) area += fast_length(direction(map, n)) / 2;
  return area;
}

/// By how much the area of what has been sampled grows in a map: of each sample. Corners, that have no normal, grow as
/// all do.
std::vector<double> growth_of(std::span<const SurfaceSample> samples, const Matrix& m) {
  const Matrix map = map_of_area_normals(m);
  std::vector<double> out;
  double before = 0, behind = 0;
  for (const auto& s : samples) {
    out.push_back(fast_length(direction(map, s.normal)));
    if (s.normal == Vec3{}) continue;
    before += s.weight;
    behind += s.weight * out.back();
  }
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (samples[i].normal == Vec3{}) out[i] = before > 0 ? behind / before : 1;
  return out;
}

/// Half the width of a thing that is seen from its broad side: the middle one of the extents of its bounds.
double half_width(std::span<const SurfaceSample> samples) {
  if (samples.empty()) return 0;
  wrlkit::Box bounds;
  for (const auto& s : samples) bounds.add(s.point);
  Vec3 extent = bounds.size();
  std::ranges::sort(extent);
  return extent[1] / 2;
}

/// Whether something nearby is in front of a sample, or faces it where they touch.
bool is_hidden(const Vec3& point, const Vec3& normal, const std::array<Vec3, 3>& corners, double distance,
               double width) {
  if (distance > width / 2 || normal == Vec3{}) return false;
  const auto at = closest_on_triangle(point, corners).at;
  const Vec3 away = at[0] * corners[0] + at[1] * corners[1] + at[2] * corners[2] - point;
  if (dot(away, normal) > 0.7 * distance && distance > 0.01 * width) return true;
  return distance <= 0.02 * width && dot(unit(area_normal(corners)), normal) < -0.5;
}

/// Places of each surface with which all of them together have no more triangles than may be neighbours; at least 1.
std::uint64_t most_places(std::span<const PlacedSurface> surfaces) {
  std::uint64_t low = 1, high = most_neighbours;
  while (low < high) {
    const auto most = high - (high - low) / 2;
    std::uint64_t n = 0;
    for (const auto& s : surfaces) n += s.mesh.n_faces() * std::min<std::uint64_t>(s.n_places, most);
    if (n <= most_neighbours)
      low = most;
    else
      high = most - 1;
  }
  return low;
}

/// Leaves out what is not the same in both scenes.
void keep_surfaces_of(const Scene& original, OfText text, std::vector<ShapeSurface>& found) {
  const auto surfaces = surfaces_of(original, {}, BelowLod::leave_levels, text);
  const auto number = surface_numbers(original, surfaces);
  const auto is_there = [&](const ShapeSurface& s) {
    return std::ranges::all_of(s.shapes, [&](NodeId shape) {
      const auto i = shape.value < number.size() ? number[shape.value] : 0;
      return i > 0 && surfaces[i - 1].geometry == s.geometry;
    });
  };
  std::erase_if(found, [&](const ShapeSurface& s) { return !is_there(s); });
}

}  // namespace

WorldParts::WorldParts(const Scene& original, const Scene& scene, const CollapseOptions& options, OfText text,
                       Task& ctx)
    : scene_(scene), options_(options) {
  read(original, text, ctx);
  find_looks();
  cut();
}

void WorldParts::read(const Scene& original, OfText text, Task& ctx) {
  SurfaceReader reader(scene_, ctx);
  auto found = surfaces_of(scene_, report_not_simplified(scene_, ctx.diag), BelowLod::leave_levels, text);
  if (&original != &scene_) keep_surfaces_of(original, text, found);
  const auto is_text = [&](const ShapeSurface& s) { return scene_.is(s.geometry, nodes::Text); };
  if (std::ranges::all_of(found, is_text)) {  // nothing would be left of the world
    found.clear();
    text = OfText::leave;
  }
  SharedBorders borders;
  Mesh mesh;
  for (const auto& s : found) {
    reader.read(s, mesh);
    borders.add(mesh);
    surfaces.push_back({.surface = s, .mesh = std::move(mesh), .is_text = is_text(s)});
  }
  auto fixed = borders.find(scene_, found);
  for (std::size_t i = 0; i < surfaces.size(); ++i) surfaces[i].fixed = std::move(fixed[i]);
  const ShownTimes shown(scene_);
  find_places(shown, found);
  count_left(shown, found, text, reader);
}

void WorldParts::find_places(const ShownTimes& shown, const std::vector<ShapeSurface>& found) {
  for (auto& s : surfaces) {
    s.n_places = shown.of(s.surface);
    n_drawn = saturating_add(n_drawn, saturating_multiply(s.mesh.n_faces(), s.n_places));
  }
  if (n_drawn > most_drawn) return surfaces.clear();
  auto places = some_places(scene_, shown, found, most_places(surfaces));
  for (std::size_t i = 0; i < surfaces.size(); ++i) surfaces[i].places = std::move(places[i]);
  std::erase_if(surfaces, [&](PlacedSurface& s) { return !measure_places(s); });
  n_drawn -= n_left;
  for (const auto& s : surfaces) n_faces += s.mesh.n_faces();
}

/// False when there is nothing to see, or nothing with a size: that is drawn as it is.
bool WorldParts::measure_places(PlacedSurface& s) {
  s.scale = 0;
  for (std::size_t i = 0; i < s.places.size(); ++i)
    if (const double scale = scale_of(s.places[i]); is_invertible(s.places[i]) && scale > s.scale) {
      s.widest = i;
      s.scale = scale;
    }
  if (!(s.scale > 0)) leave(s.mesh.n_faces() * s.n_places, "a Shape that is scaled to nothing");
  return s.scale > 0 && s.mesh.n_faces() > 0;
}

void WorldParts::leave(std::uint64_t n_triangles, std::string_view why) {
  if (n_triangles == 0) return;
  n_left = saturating_add(n_left, n_triangles);
  auto of_this = std::ranges::find(left, why, &std::pair<std::string_view, std::uint64_t>::first);
  if (of_this == left.end()) of_this = left.insert(left.end(), {why, 0});
  of_this->second = saturating_add(of_this->second, n_triangles);
}

/// What has levels already, changes, or comes from a prototype: it is drawn, and the budget has to pay for it.
void WorldParts::count_left(const ShownTimes& shown, const std::vector<ShapeSurface>& taken, OfText text,
                            SurfaceReader& reader) {
  std::map<std::uint32_t, std::string_view> cause;  // by Shape
  const auto keep_cause = [&](NodeId shape, const char* why) { cause[shape.value] = why; };
  surfaces_of(scene_, keep_cause, BelowLod::leave_levels, text);
  std::vector<char> is_taken(scene_.node_count());
  for (const auto& s : taken) is_taken[s.geometry.value] = 1;
  Mesh mesh;
  const auto count = [&](const ShapeSurface& s, std::string_view why) {
    if (!s.geometry || is_taken[s.geometry.value]) return;
    reader.read(s, mesh);
    leave(saturating_multiply(mesh.n_faces(), shown.of(s)), why);
  };
  for (const auto& [shape, why] : cause)
    count({scene_.get(NodeId{shape}, nodes::shape::geometry), {NodeId{shape}}}, why);
  for (auto& s : surfaces_of(scene_, {}, BelowLod::take, OfText::take)) {
    std::erase_if(s.shapes, [&](NodeId shape) { return cause.contains(shape.value); });
    if (!s.shapes.empty()) count(s, "made by prototypes (-p expand,weld helps)");
  }
}

/// Shapes look alike that have the same diffuse colour and the same texture.
void WorldParts::find_looks() {
  std::map<std::array<double, 4>, std::uint32_t> number;
  for (auto& s : surfaces) {
    std::array<double, 4> key{-1, -1, -1, 0};
    const NodeId appearance = scene_.get(s.surface.shapes[0], nodes::shape::appearance);
    if (scene_.is(appearance, nodes::Appearance)) {
      const NodeId material = scene_.get(appearance, nodes::appearance::material);
      if (scene_.is(material, nodes::Material)) {
        const Vec3 color = scene_.get(material, nodes::material::diffuseColor);
        std::ranges::copy(color, key.begin());
      }
      key[3] = scene_.get(appearance, nodes::appearance::texture).value;
    }
    s.look = number.try_emplace(key, static_cast<std::uint32_t>(number.size())).first->second;
  }
}

/// Surfaces into pieces, each of which is in all places of the surface.
void WorldParts::cut() {
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    auto& s = surfaces[i];
    s.first_part = static_cast<std::uint32_t>(parts.size());
    for (auto& faces : connected_pieces(s.mesh)) parts.push_back({.surface = i, .faces = std::move(faces)});
    s.n_parts = static_cast<std::uint32_t>(parts.size()) - s.first_part;
  }
  allocated.resize(parts.size());
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    const auto& s = surfaces[parts[i].surface];
    const auto triangles = triangles_of(s.mesh);
    const auto normals = area_normals(triangles, parts[i].faces);
    parts[i].own_area = area_of(normals, Matrix{});
    parts[i].area = area_of(normals, s.places[s.widest]);
    allocated[i].n_places = s.n_places;
    allocated[i].first_owner = n_owners_;
    allocated[i].n_owners = static_cast<std::uint32_t>(s.places.size());
    allocated[i].look = s.look;
    n_placed_ += static_cast<double>(s.n_places);
    const double each = s.each(s.places.size());
    for (std::size_t k = 0; k < s.places.size(); ++k) {
      const Matrix& m = s.places[k];
      const double grown = each * area_of(normals, m);
      area += grown;
      const Stretch there(m, parts[i].own_area > 0 ? grown / parts[i].own_area : each);
      if (k == 0)
        allocated[i].stretch = there;
      else
        allocated[i].stretch.add(there);
      neighbours.add(triangles, parts[i].faces, m, n_owners_++);
      part_of_.push_back(i);
    }
    neighbours.end_part();
  }
}

/// From the surface to metres, in its widest place, with the origin at its first point.
Matrix WorldParts::frame_of(const WorldPart& part) const {
  const auto& s = surfaces[part.surface];
  Matrix frame = s.places[s.widest];
  const auto triangles = triangles_of(s.mesh);
  const Vec3 origin = frame.point(triangles.position(triangles.corners[std::size_t{3} * part.faces[0]]));
  for (int r = 0; r < 3; ++r) frame(r, 3) -= origin[static_cast<std::size_t>(r)];
  return frame;
}

Mesh WorldParts::in_metres(const WorldPart& part, CollapseOptions* options) const {
  const auto& s = surfaces[part.surface];
  std::vector<std::uint32_t> original;
  Mesh mesh = piece_of(s.mesh, part.faces, original);
  transform(mesh, frame_of(part));
  for (std::uint32_t k = 0; options && k < original.size(); ++k)
    if (std::ranges::binary_search(s.fixed, original[k])) options->fixed.push_back(k);
  return mesh;
}

/// Ladders that are known, by the corners of their forms.
struct WorldParts::Known {
  LikeForm form;
  std::vector<std::uint32_t> fixed;
  std::uint32_t ladder;
  double area;
};

/// A part as a mesh, and whether it may share a ladder: those with attributes have their own.
struct WorldParts::Candidate {
  Mesh mesh;
  std::vector<std::uint32_t> fixed;
  std::uint64_t hash = 0;
  bool plain = false;
};

WorldParts::Candidate WorldParts::candidate(std::uint32_t part) const {
  CollapseOptions options;
  Candidate out{in_metres(parts[part], &options), {}, 0, false};
  const auto attributes = out.mesh.attributes();
  out.fixed = std::move(options.fixed);
  out.plain = std::ranges::none_of(attributes, [](const Attribute* a) { return a->present(); });
  out.hash = hash_of_corners(out.mesh);
  return out;
}

void WorldParts::find_ladder_of(std::uint32_t i, Candidate mine, std::vector<Known>& alike) {
  auto& part = parts[i];
  double ladder_area = part.area;
  part.from_ladder = inverse(frame_of(part));
  part.ladder = static_cast<std::uint32_t>(members_.size());
  for (std::size_t k = 0; mine.plain && k < alike.size(); ++k) {
    const auto& known = alike[k];
    const auto map = known.fixed == mine.fixed ? known.form.to(mine.mesh) : std::nullopt;
    if (!map) continue;
    part.ladder = known.ladder;
    part.from_ladder = part.from_ladder * *map;
    ladder_area = known.area;
    break;
  }
  const double grown = ladder_area > 0 ? part.own_area / ladder_area : 1;
  allocated[i].stretch = allocated[i].stretch.after(part.from_ladder, grown);
  if (part.ladder == members_.size()) {
    members_.emplace_back();
    if (mine.plain && alike.size() < most_alike)
      alike.push_back({LikeForm(std::move(mine.mesh)), std::move(mine.fixed), part.ladder, part.area});
  }
  members_[part.ladder].push_back(i);
}

/// The meshes of some parts are made at a time: all of them would take as much memory as the world.
void WorldParts::find_ladders() {
  std::unordered_map<std::uint64_t, std::vector<Known>> by_corners;
  for (std::size_t first = 0; first < parts.size(); first += parts_at_once) {
    std::vector<Candidate> some(std::min(parts_at_once, parts.size() - first));
    parallel_for(some.size(), [&](std::size_t i) { some[i] = candidate(static_cast<std::uint32_t>(first + i)); });
    for (std::size_t i = 0; i < some.size(); ++i) {
      auto& alike = by_corners[some[i].hash];
      find_ladder_of(static_cast<std::uint32_t>(first + i), std::move(some[i]), alike);
    }
  }
}

/// Where a ladder stands.
struct WorldParts::Surroundings {
  std::uint32_t first, end;  // owners that are itself
  Matrix place;              // from the ladder to the world
  double width;
};

/// Of two that hide one another, the larger one stays.
bool WorldParts::yields(std::uint32_t owner, std::uint32_t other) const {
  const auto part = part_of_[owner], other_part = part_of_[other];
  if (surfaces[parts[other_part].surface].is_text) return false;  // it may be thin, as letters are
  return std::pair(parts[part].area, owner) < std::pair(parts[other_part].area, other);
}

/// Nothing needs to be nearer to a sample that is hidden than what hides it, or than what hides that in turn: it may
/// go.
double WorldParts::enough(const Surroundings& around, const SurfaceSample& sample, double within,
                          Neighbours::Found& found) const {
  constexpr int most_behind = 4;
  constexpr double seen = std::numeric_limits<double>::infinity();
  const Vec3 p = around.place.point(sample.point);
  found = neighbours.nearest(p, within, {around.first, around.end}, found.triangle);
  if (found.owner == ClosestPoint::no_guess) return seen;
  const auto hides = [&](std::uint32_t owner, const Vec3& point, const Vec3& normal, const Neighbours::Found& other) {
    return other.owner != ClosestPoint::no_guess && yields(owner, other.owner) &&
           is_hidden(point, normal, neighbours.corners(other.triangle), other.distance, around.width);
  };
  if (!hides(around.first, p, unit(direction(around.place, sample.normal)), found)) return seen;
  auto front = found;
  for (int i = 0; i < most_behind; ++i) {
    const auto corners = neighbours.corners(front.triangle);
    const Vec3 there = p + way_to(p, corners);
    const auto next = neighbours.nearest(there, around.width, {front.owner, front.owner + 1}, front.triangle);
    if (!hides(front.owner, there, unit(area_normal(corners)), next)) break;
    front = next;
  }
  const Vec3 way = way_to(p, neighbours.corners(front.triangle));
  return dot(way, way);
}

void WorldParts::make_ladder_of(std::uint32_t ladder) {
  const auto& members = members_[ladder];
  CollapseOptions options = options_;
  const Mesh mesh = in_metres(parts[members[0]], &options);
  auto samples = sample_surface(triangles_of(mesh), std::clamp(ladder_samples_of_face * mesh.n_faces(),
                                                               least_ladder_samples, most_ladder_samples));
  std::vector<Surroundings> around;
  const double width = half_width(samples);
  const std::size_t stride = (members.size() + most_places_asked - 1) / most_places_asked;
  for (std::size_t i = 0; i < members.size(); i += stride) {
    const auto m = members[i];
    const auto& places = surfaces[parts[m].surface].places;
    const std::size_t step = (stride * places.size() + most_places_asked - 1) / most_places_asked;
    for (std::size_t k = 0; k < places.size(); k += std::max<std::size_t>(step, 1)) {
      const auto owner = allocated[m].first_owner + static_cast<std::uint32_t>(k);
      around.push_back({owner, owner + 1, places[k] * parts[m].from_ladder, width});
    }
  }
  Neighbours::Found found{0, ClosestPoint::no_guess, ClosestPoint::no_guess};
  for (auto& sample : samples) {
    double least = 0;
    for (std::size_t k = 0; k < around.size() && std::isfinite(least); ++k)
      least = std::max(least, enough(around[k], sample, around[k].width, found));
    sample.enough = least;
  }
  std::uint64_t n_places = 0;
  for (const auto m : members) n_places = saturating_add(n_places, surfaces[parts[m].surface].n_places);
  const double share =
      static_cast<double>(n_places) * static_cast<double>(mesh.n_faces()) / static_cast<double>(n_drawn);
  ladders_[ladder] = make_ladder({mesh, samples, options, share});
}

/// Points of a part in its places, for when it leaves.
void WorldParts::find_leaving(std::uint32_t part) {
  const Mesh mesh = in_metres(parts[part], nullptr);
  wrlkit::Box bounds;
  for (std::uint32_t i = 0; i < mesh.n_positions(); ++i) bounds.add(triangles_of(mesh).position(i));
  const double size = diagonal(bounds);
  const bool large = size * size * n_placed_ > area;
  const auto most = std::min(large ? of_large : of_small, std::max<std::size_t>(1, most_leaving / n_owners_));
  const auto samples = sample_surface(triangles_of(mesh), std::min(2 * mesh.n_faces(), most));
  const double width = half_width(samples);
  const auto& s = surfaces[parts[part].surface];
  const Matrix back = inverse(frame_of(parts[part]));
  auto& out = allocated[part];
  constexpr double far = std::numeric_limits<double>::infinity();
  const std::size_t step = (s.places.size() + most_left_from - 1) / most_left_from;
  const double each = s.each((s.places.size() + step - 1) / step);
  for (std::size_t k = 0; k < s.places.size(); k += step) {
    const Surroundings around{out.first_owner, out.first_owner + out.n_owners, s.places[k] * back, width};
    const auto grown = growth_of(samples, around.place);
    Neighbours::Found near{0, ClosestPoint::no_guess, ClosestPoint::no_guess};
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto& sample = samples[i];
      const bool hidden = std::isfinite(enough(around, sample, far, near));
      out.leaving.push_back({around.place.point(sample.point), sample.weight * grown[i] * each,
                             hidden ? 0 : width * width, out.look, near.owner, near.distance});
    }
  }
}

void WorldParts::make_ladders() {
  neighbours.prepare();
  find_ladders();
  ladders_.resize(members_.size());
  parallel_for(members_.size(), [&](std::size_t i) { make_ladder_of(static_cast<std::uint32_t>(i)); });
  parallel_for(parts.size(), [&](std::size_t i) {
    find_leaving(static_cast<std::uint32_t>(i));
    allocated[i].rungs = &ladders_[parts[i].ladder];
  });
}

bool WorldParts::is_changed(const PlacedSurface& s, const std::vector<std::uint32_t>& rungs,
                            const std::vector<std::uint32_t>* before) const {
  for (std::uint32_t i = s.first_part; i < s.first_part + s.n_parts; ++i)
    if (rungs[i] != (before ? (*before)[i] : 0)) return true;
  return false;
}

}  // namespace wrlkit::simplify
