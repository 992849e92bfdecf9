#include "light/world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "light/lamp_reach.h"
#include "light/render/attributes.h"
#include "light/render/gather.h"
#include "light/spiral.h"
#include "scenegraph/nodes.h"

namespace wrlkit::light {
namespace {

using namespace drawing;

constexpr double most_reflected = 0.99;  // a closed room of more would never come to an end
constexpr std::size_t most_emitters = 1'000'000;
constexpr int most_layers = 32;  // of transparent things, one behind the other
constexpr double least_of_lamp =
    0.2140;  // radiance: lin(0.5); CAD programs give a surface emission of a tenth or two for its looks
constexpr double most_of_bulb = 0.1;       // of the area of all faces
constexpr double least_light = 1.0 / 256;  // radiance that a display hardly tells from black
using std::numbers::pi;

V3 reflectance(const V3& display) { return min(linear(display), V3(most_reflected)); }

std::optional<Lamp> lamp_of(const std::optional<Light>& light) {
  if (!light) return {};
  Lamp l{*light, pi * linear(light->intensity * light->color)};
  if (!(mean(l.irradiance) > 0)) return {};
  return l;
}

double strongest(const V3& c) { return std::max({c.x, c.y, c.z}); }

/// Radiance in the mean of all directions, estimated by directions along a spiral.
double mean_radiance(const Sky& sky) {
  constexpr int n = 256;
  V3 sum;
  for (int k = 0; k < n; ++k) sum += linear(sky.color(spiral_direction(k, n), 0));
  return strongest(sum) / n;
}

bool may_be_clear(const Surface& s, const PooledMesh& m) {
  return s.alpha < 1 || (s.picture.texture && s.picture.texture->has_alpha()) ||
         (m.colors != PooledMesh::absent && m.color_width == 4);
}

}  // namespace

LightWorld::LightWorld(const Scene& scene, const MeshSource& source, Resources* resources, const LightOptions& options,
                       Diagnostics& diag)
    : options_(options), stage_(set_stage(scene, diag, {.viewer = options.viewer, .level_of = options.level_of})) {
  mesh_of_ = Gatherer(scene, source, pool_).meshes_of(stage_, diag);
  make_facts(scene, resources, diag);
  make_lamps(scene);
  make_sky(scene, resources, diag);
  find_bulbs();
  std::vector<char> clear;
  for (const UseFacts& f : facts_) clear.push_back(f.clear || f.bulb);
  rays_.emplace(stage_, pool_, mesh_of_,
                RayOptions{.cull = false, .fronts_first = true, .all_flat = options.all_flat, .clear = clear}, diag);
  make_emitters();
  if (options.lamps == LampFall::inverse_square) spread_lamps();
}

void LightWorld::make_facts(const Scene& scene, Resources* resources, Diagnostics& diag) {
  surfaces_.emplace(scene, resources, diag);
  for (std::size_t u = 0; u < stage_.uses.size(); ++u) {
    const PooledMesh& m = pool_[mesh_of_[u]];
    UseFacts f;
    f.surface = surfaces_->of(stage_.uses[u].appearance);
    const Surface& s = (*surfaces_)[f.surface];
    if (m.kind == Mesh::Kind::faces) {
      if (m.solid) f.inner = Inner::back;
      f.clear = may_be_clear(s, m);
      has_clear_ |= f.clear;
      f.plain = m.colors == PooledMesh::absent && (!s.picture.texture || m.texcoords == PooledMesh::absent);
      V3 color = s.base({}, {}).color;
      const bool emits = s.shines;
      f.emission = options_.emission * linear(emits ? color : s.emissive);
      if (!emits) f.albedo = reflectance(color);
      if (mean(f.emission) > 0 || (emits && !f.plain)) emits_ = true;
    }
    facts_.push_back(f);
  }
}

void LightWorld::make_lamps(const Scene& scene) {
  for (const Placed& p : stage_.lights)
    if (auto l = lamp_of(make_light(scene, p, stage_))) lamps_.push_back(*l);
  for (const LightScope& s : stage_.scopes)
    scoped_.push_back(s.light.node ? lamp_of(make_light(scene, s.light, stage_)) : std::nullopt);
}

/// Rooms that glow hold lamps, too: what has more than a small share of all area is no bulb.
void LightWorld::find_bulbs() {
  if (!emits_ || lamps_.empty()) return;
  std::optional<double> all;
  for (std::uint32_t u = 0; u < facts_.size(); ++u) {
    if (pool_[mesh_of_[u]].kind != Mesh::Kind::faces || strongest(facts_[u].emission) < least_of_lamp) continue;
    if (!holds_lamp(box_of(u), 0)) continue;
    if (!all) all = total_area();
    facts_[u].bulb = area_of(u) <= most_of_bulb * *all;
    has_clear_ |= facts_[u].bulb;
  }
}

Box LightWorld::box_of(std::uint32_t use) const {
  Box out;
  for (int k = 0; k < 8; ++k) out.add(stage_.frames[stage_.uses[use].frame].point(pool_[mesh_of_[use]].box.corner(k)));
  return out;
}

bool LightWorld::holds_lamp(const Box& box, double margin) const {
  const V3 room(margin * length(V3(box.size())));
  return std::ranges::any_of(lamps_, [&](const Lamp& lamp) {
    const V3 above = lamp.light.location - (V3(box.low) - room), below = V3(box.high) + room - lamp.light.location;
    return std::min({above.x, above.y, above.z, below.x, below.y, below.z}) >= 0;
  });
}

double LightWorld::total_area() const {
  double all = 0;
  for (std::uint32_t u = 0; u < facts_.size(); ++u)
    if (const double area = area_of(u); std::isfinite(area)) all += area;
  return all;
}

void LightWorld::spread_lamps() {
  for (Lamp& l : lamps_)
    if (const auto reach = lamp_reach(l.light, *this)) l.light.fall = SquareFall{*reach, attenuation(l.light, *reach)};
}

void LightWorld::make_sky(const Scene& scene, Resources* resources, Diagnostics& diag) {
  using Option = LightOptions::Sky;
  if (options_.sky == Option::constant) constant_sky_ = options_.sky_color;
  if (options_.sky == Option::background && stage_.background)
    background_.emplace(scene, stage_.background->node, stage_.frames[stage_.background->frame], resources, diag);
  const bool lit =
      !lamps_.empty() || std::any_of(scoped_.begin(), scoped_.end(), [](auto& l) { return l.has_value(); });
  has_lamps_ = lit || glow_is_light();
  sky_stands_in_ =
      options_.sky == Option::background && !has_lamps_ && !(background_ && mean_radiance(*background_) >= least_light);
  if (sky_stands_in_) {
    background_.reset();
    constant_sky_ = V3(1);
  }
  has_sky_ = background_ || mean(constant_sky_) > 0;
}

bool LightWorld::glow_is_light() const {
  if (!emits_) return false;
  double all = 0, shed = 0;
  for (std::uint32_t u = 0; u < facts_.size(); ++u) {
    const double area = area_of(u), radiance = strongest(facts_[u].emission);
    if (!std::isfinite(area)) continue;
    all += area;
    if (radiance >= least_of_lamp) shed += area * radiance;
  }
  return shed > 0 && shed >= least_light * all;
}

/// Of faces, in the world.
double LightWorld::area_of(std::uint32_t use) const {
  const PooledMesh& m = pool_[mesh_of_[use]];
  const Affine& frame = stage_.frames[stage_.uses[use].frame];
  if (m.kind != Mesh::Kind::faces) return 0;
  double twice = 0;
  for (std::uint32_t e = 0; e < m.n_elements; ++e) {
    const V3 a = pool_.position(m, e, 0);
    twice += length(cross(frame.vector(pool_.position(m, e, 1) - a), frame.vector(pool_.position(m, e, 2) - a)));
  }
  return twice / 2;
}

void LightWorld::make_emitters() {
  if (!emits_) return;
  for (std::uint32_t u = 0; u < facts_.size(); ++u) {
    UseFacts& f = facts_[u];
    const PooledMesh& m = pool_[mesh_of_[u]];
    const Affine& frame = stage_.frames[stage_.uses[u].frame];
    const bool unlit = (*surfaces_)[f.surface].shines;
    if (m.kind != Mesh::Kind::faces || !rays_->holds(u) || !(mean(f.emission) > 0 || (unlit && !f.plain))) continue;
    if (emitters_.size() + m.n_elements > most_emitters) continue;
    f.first_emitter = static_cast<std::uint32_t>(emitters_.size());
    for (std::uint32_t e = 0; e < m.n_elements; ++e) {
      V3 p[3];
      for (int k = 0; k < 3; ++k) p[k] = frame.point(pool_.position(m, e, k) + m.origin);
      emitters_.push_back(
          {p[0], p[1] - p[0], p[2] - p[0], {}, u, e, f.inner == Inner::neither, frame.determinant() < 0});
      emitters_.back().radiance = radiance(emitters_.back(), 1. / 3, 1. / 3);
    }
  }
}

void LightWorld::seal(std::uint32_t use, bool inside_out) {
  UseFacts& f = facts_[use];
  f.inner = inside_out ? Inner::front : Inner::back;
  f.sealed = true;
  if (f.first_emitter == no_emitter) return;
  for (Emitter& e : std::span(emitters_).subspan(f.first_emitter, pool_[mesh_of_[use]].n_elements)) {
    e.both_sides = false;
    if (inside_out) e.turned = !e.turned;
  }
}

Texel LightWorld::base(const UseFacts& use, const Hit& hit) const {
  const PooledMesh& m = pool_[mesh_of_[hit.use]];
  const Surface& s = (*surfaces_)[use.surface];
  return s.base(vertex_color(pool_, m, hit), texture_at(pool_, m, s, hit, 0));
}

/// The colours of the front, or of the back where it has any.
void LightWorld::paint(const UseFacts& use, const Hit& hit, SurfacePoint& to) const {
  if (use.plain && !use.clear) {
    to.albedo = use.albedo;
    to.emission = use.emission;
    return;
  }
  Texel t = base(use, hit);
  const bool emits = (*surfaces_)[use.surface].shines;
  to.emission = emits ? options_.emission * linear(t.color) : use.emission;
  to.albedo = emits ? V3() : reflectance(t.color);
  to.alpha = std::clamp(t.alpha, 0.0, 1.0);
}

SurfacePoint LightWorld::surface(const Hit& hit) const {
  const UseFacts& use = facts_[hit.use];
  SurfacePoint s;
  s.face = unit(hit.back ? -hit.across : hit.across);
  s.inside = use.inner == (hit.back ? Inner::back : Inner::front);
  if (hit.leaves != Hit::none && hides(hit.leaves) && facts_[hit.leaves].inner == Inner::back) s.inside = true;
  if (!s.inside)
    paint(use, hit, s);
  else if (use.clear)
    s.alpha = std::clamp(base(use, hit).alpha, 0.0, 1.0);
  return s;
}

LightWorld::HitPoint LightWorld::hit_point(const Hit& hit) const {
  const PooledMesh& m = pool_[mesh_of_[hit.use]];
  const Affine& frame = stage_.frames[stage_.uses[hit.use].frame];
  const V3 a = pool_.position(m, hit.element, 0);
  const V3 e1 = frame.vector(pool_.position(m, hit.element, 1) - a),
           e2 = frame.vector(pool_.position(m, hit.element, 2) - a);
  return {frame.point(m.origin + a) + hit.weights[1] * e1 + hit.weights[2] * e2,
          std::sqrt(std::max(dot(e1, e1), dot(e2, e2)))};
}

V3 LightWorld::normal(const Hit& hit, const V3& face) const {
  const PooledMesh& m = pool_[mesh_of_[hit.use]];
  if (m.normals == PooledMesh::absent) return face;
  const auto n = interpolate<3>(pool_, pool_.normals, m, m.normals, hit);
  const V3 front = unit(stage_.frames[stage_.uses[hit.use].frame].normal({n[0], n[1], n[2]}));
  const V3 smooth = hit.back ? -front : front;
  return dot(smooth, face) > 0 ? smooth : face;
}

bool LightWorld::encloses(const Ray& from) const {
  constexpr int most = 64;
  int left = 0;
  double after = 0;
  Hit hit;
  for (int i = 0; i < most && nearest(from, after, hit); ++i, after = hit.distance) {
    const UseFacts& use = facts_[hit.use];
    if (hides(hit.use)) left += use.inner == (hit.back ? Inner::back : Inner::front) ? 1 : -1;
    if (hit.leaves != Hit::none && hides(hit.leaves)) left += facts_[hit.leaves].inner == Inner::back ? 1 : -1;
  }
  return left > 0;
}

double LightWorld::passing(const Ray& ray, double distance, bool through_bulbs) const {
  if (rays_->occluded(ray, 0, distance)) return 0;
  double through = 1, after = 0;
  if (!has_clear_) return through;
  Hit hit;
  for (int layer = 0; layer < most_layers && nearest(ray, after, hit) && hit.distance < distance; ++layer) {
    after = hit.distance;
    if (through_bulbs && is_bulb(hit.use)) continue;
    through *= 1 - std::clamp(base(facts_[hit.use], hit).alpha, 0.0, 1.0);
  }
  return through;
}

V3 LightWorld::sky(const V3& direction) const {
  return background_ ? linear(background_->color(direction, 0)) : constant_sky_;
}

/// Coordinates are rounded to 24 bits around the centre, and a frame or two on the way round again. At the centre a
/// large triangle is where its corners have been rounded to.
V3 LightWorld::off_surface(const V3& position, const V3& face, double extent) const {
  constexpr double roundings = 1.0 / (1 << 21);
  V3 p = position - centre();
  double size = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z), radius() / 128, std::min(extent, radius())});
  return position + (size * roundings) * face;
}

V3 LightWorld::radiance(const Emitter& e, double u, double v) const {
  Hit hit{.use = e.use, .element = e.element, .weights = {1 - u - v, u, v}};
  SurfacePoint s;
  paint(facts_[e.use], hit, s);
  return s.alpha * s.emission;
}

}  // namespace wrlkit::light
