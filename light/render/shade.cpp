#include "light/render/shade.h"

#include <algorithm>

#include "light/render/baked.h"
#include "light/render/picture_place.h"
#include "scenegraph/nodes.h"

namespace wrlkit::drawing {
namespace {

constexpr int most_layers = 32;       // of transparent things, one behind the other
constexpr double hidden = 1.0 / 512;  // what shows through by less is not looked for

/// Into [0, 1]; what is no number is black.
double displayed(double v) { return v > 0 ? std::min(v, 1.0) : 0; }
V3 displayed(const V3& c) { return {displayed(c.x), displayed(c.y), displayed(c.z)}; }

/// NavigationInfo (6.29): a light of full strength that travels with the view.
Light headlight_of(const Camera& camera) {
  Light l;
  l.direction = -camera.back;
  return l;
}

}  // namespace

Spot spot_at(const Drawing& d, const Ray& ray, const Hit& hit) {
  const PooledMesh& m = d.meshes[d.mesh_of[hit.use]];
  const Affine& frame = d.stage.frames[d.stage.uses[hit.use].frame];
  V3 a = d.meshes.position(m, hit.element, 0);
  V3 e1 = d.meshes.position(m, hit.element, 1) - a, e2 = d.meshes.position(m, hit.element, 2) - a;
  Spot s{ray.origin + hit.distance * ray.direction, frame.normal(cross(e1, e2)), {}};
  if (m.normals != PooledMesh::absent) {
    auto n = interpolate<3>(d.meshes, d.meshes.normals, m, m.normals, hit);
    s.normal = unit(frame.normal({n[0], n[1], n[2]}));
  }
  if (!(dot(s.normal, s.normal) > 0.5)) s.normal = unit(s.face);
  // Seen from behind, a surface is lit as if it were turned round.
  if (dot(s.face, ray.direction) > 0) s.normal = -s.normal;
  return s;
}

std::optional<Texel> texel_of(const Drawing& d, const Surface& s, const Hit& hit, const Camera& camera,
                              const Seen& seen) {
  const PooledMesh& m = d.meshes[d.mesh_of[hit.use]];
  if (!s.picture.texture) return {};
  auto place = place_of(d.meshes, m, hit, d.meshes.texcoords, m.texcoords, s.texcoords, seen.area);
  if (!place) return {};
  return s.picture.sample(place->at, place->detail(*s.picture.texture, hit, camera, seen.facing));
}

Shader::Shader(const Scene& scene, const Drawing& drawing, const Tracer& tracer, const Camera& camera, const Sky& sky,
               bool headlight)
    : drawing_(drawing),
      tracer_(tracer),
      camera_(camera),
      sky_(sky),
      dashes_(scene, drawing.stage, drawing.meshes, drawing.mesh_of, camera) {
  const Stage& stage = drawing.stage;
  if (headlight) headlight_ = headlight_of(camera);
  if (stage.fog) fog_ = Fog(scene, *stage.fog, stage);
  for (const Placed& p : stage.lights)
    if (auto l = make_light(scene, p, stage)) everywhere_.push_back(*l);
  for (const LightScope& s : stage.scopes)
    scoped_.push_back(s.light.node ? make_light(scene, s.light, stage) : std::nullopt);
}

V3 Shader::color(double px, double py) const {
  Ray ray{camera_.eye, camera_.direction(px, py)};
  V3 sum;
  double through = 1, after = 0;
  Hit hit;
  for (int layer = 0; layer < most_layers && tracer_.nearest(ray, after, hit); ++layer) {
    Texel t = shade(ray, hit);
    sum += (through * t.alpha) * t.color;
    through *= 1 - t.alpha;
    if (through < hidden) return sum;
    after = hit.distance;
  }
  return sum + through * displayed(sky_.color(ray.direction, camera_.sample()));
}

Texel Shader::shade(const Ray& ray, const Hit& hit) const {
  const Surface& s = drawing_.surfaces[drawing_.surface_of[hit.use]];
  const PooledMesh& m = drawing_.meshes[drawing_.mesh_of[hit.use]];
  Texel out;
  if (m.kind == Mesh::Kind::faces)
    out = hatched(s, ray, hit, shade_face(ray, hit, s));
  else if (auto own = vertex_color(drawing_.meshes, m, hit))
    out = {own->color, own->alpha * s.alpha};
  else
    out = {s.lit ? s.emissive : V3(1), s.alpha};  // IndexedLineSet and PointSet (6.24, 6.36)
  if (dashes_.is_gap(hit, ray.origin + hit.distance * ray.direction)) out.alpha = 0;
  return {displayed(fog_.dim(displayed(out.color), hit.distance * ray.direction)), displayed(out.alpha)};
}

Texel Shader::hatched(const Surface& s, const Ray& ray, const Hit& hit, const Texel& below) const {
  if (!s.hatch) return below;
  const V3 at = camera_.project(ray.origin + hit.distance * ray.direction);
  const double unit = camera_.height / 60.0;
  if (s.hatch->covers(at.x / at.z / unit, at.y / at.z / unit)) return {s.hatch->color, below.alpha};
  return {below.color, s.hatch->is_filled ? below.alpha : 0};
}

Texel Shader::shade_face(const Ray& ray, const Hit& hit, const Surface& s) const {
  Spot at = spot_at(drawing_, ray, hit);
  double area = length(at.face);
  double facing = area > 0 ? std::fabs(dot(at.face, ray.direction)) / area : 1;
  const MeshPool& pool = drawing_.meshes;
  const PooledMesh& m = pool[drawing_.mesh_of[hit.use]];
  Texel base = s.base(vertex_color(pool, m, hit), texel_of(drawing_, s, hit, camera_, {area, facing}));
  auto place = s.baked ? place_of(pool, m, hit, pool.lightcoords, m.lightcoords, s.baked.places, area) : std::nullopt;
  if (place) {
    auto sample = sample_light(s.baked, place->at, place->detail(*s.baked.light.texture, hit, camera_, facing));
    V3 face = dot(at.face, ray.direction) > 0 ? -unit(at.face) : unit(at.face);
    return {baked_color(s, base.color, sample, {at.position, at.normal, -ray.direction}, face), base.alpha};
  }
  if (!s.lit) return base;
  LitPoint lit{at.position, at.normal, -ray.direction};
  Further further{s.material.ambient, s.emissive};
  if (s.has_further_pictures()) further_pictures(s, m, hit, {area, facing}, lit.normal, further);
  return {light(s, base.color, further, lit, drawing_.stage.uses[hit.use].lights), base.alpha};
}

/// Occlusion dims ambient light, as in glTF; normals lean along the picture's sides.
void Shader::further_pictures(const Surface& s, const PooledMesh& m, const Hit& hit, const Seen& seen, V3& normal,
                              Further& to) const {
  const MeshPool& pool = drawing_.meshes;
  const auto place = place_of(pool, m, hit, pool.texcoords, m.texcoords, s.texcoords, seen.area);
  if (!place) return;
  auto sample = [&](const Layer& l) {
    return l.sample(place->at, place->detail(*l.texture, hit, camera_, seen.facing));
  };
  if (s.glow.texture) to.emissive = s.emissive * sample(s.glow).color;
  if (s.shadow.texture) to.ambient *= 1 - s.shadow_strength * (1 - sample(s.shadow).color.x);
  if (!s.bumps.texture) return;
  std::array<double, 2> uv[3];
  for (int k = 0; k < 3; ++k) {
    const float* c = pool.value(pool.texcoords, m, m.texcoords, hit.element, k);
    uv[k] = s.texcoords(c[0], c[1]);
  }
  const double u1 = uv[1][0] - uv[0][0], v1 = uv[1][1] - uv[0][1], u2 = uv[2][0] - uv[0][0], v2 = uv[2][1] - uv[0][1],
               d = u1 * v2 - u2 * v1;
  if (!(std::fabs(d) > 0)) return;
  const Affine& frame = drawing_.stage.frames[drawing_.stage.uses[hit.use].frame];
  const V3 a = pool.position(m, hit.element, 0), e1 = pool.position(m, hit.element, 1) - a,
           e2 = pool.position(m, hit.element, 2) - a;
  auto along = [&](const V3& direction) {
    const V3 w = frame.vector((1 / d) * direction);
    return unit(w - dot(w, normal) * normal);
  };
  const V3 t = along(v2 * e1 - v1 * e2), b = along(u1 * e2 - u2 * e1), n = 2.0 * sample(s.bumps).color - V3(1);
  normal = unit((s.bump_scale * n.x) * t + (s.bump_scale * n.y) * b + n.z * normal);
}

/// The sum of 4.14.4, without fog.
V3 Shader::light(const Surface& s, const V3& base, const Further& further, const LitPoint& at,
                 std::uint32_t scope) const {
  Lit material = s.material;
  material.diffuse = base;
  material.ambient = further.ambient;
  V3 sum = further.emissive;
  if (headlight_) sum += contribution(*headlight_, at, material);
  for (const Light& l : everywhere_) sum += contribution(l, at, material);
  for (; scope; scope = drawing_.stage.scopes[scope].parent)
    if (scoped_[scope]) sum += contribution(*scoped_[scope], at, material);
  return sum;
}

}  // namespace wrlkit::drawing
