#include "passes/render/shade.h"

#include <algorithm>

#include "passes/render/attributes.h"
#include "scenegraph/nodes.h"

namespace wrlkit::drawing {
namespace {

constexpr int most_layers = 32;      // of transparent things, one behind the other
constexpr double hidden = 1.0 / 512; // what shows through by less is not looked for

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

Shader::Shader(const Scene& scene, const Drawing& drawing, const Tracer& tracer, const Camera& camera, const Sky& sky,
               bool headlight)
    : drawing_(drawing), tracer_(tracer), camera_(camera), sky_(sky) {
  const Stage& stage = drawing.stage;
  if (headlight) headlight_ = headlight_of(camera);
  if (stage.fog) fog_ = Fog(scene, *stage.fog, stage);
  for (const Placed& p : stage.lights)
    if (auto l = make_light(scene, p, stage)) everywhere_.push_back(*l);
  for (const LightScope& s : stage.scopes) scoped_.push_back(s.light.node ? make_light(scene, s.light, stage) : std::nullopt);
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
  if (m.kind == Mesh::Kind::faces) out = shade_face(ray, hit, s);
  else if (auto own = vertex_color(drawing_.meshes, m, hit)) out = {own->color, own->alpha * s.alpha};
  else out = {s.lit ? s.emissive : V3(1), s.alpha};  // IndexedLineSet and PointSet (6.24, 6.36)
  return {displayed(fog_.dim(displayed(out.color), hit.distance * ray.direction)), displayed(out.alpha)};
}

Texel Shader::shade_face(const Ray& ray, const Hit& hit, const Surface& s) const {
  Spot at = spot_at(drawing_, ray, hit);
  double area = length(at.face);
  double facing = area > 0 ? std::fabs(dot(at.face, ray.direction)) / area : 1;
  Texel base = s.base(vertex_color(drawing_.meshes, drawing_.meshes[drawing_.mesh_of[hit.use]], hit), texel(s, hit, area, facing));
  if (!s.lit) return base;
  LitPoint lit{at.position, at.normal, -ray.direction};
  return {light(s, base.color, lit, drawing_.stage.uses[hit.use].lights), base.alpha};
}

/// `world_area` is twice the area of the triangle; `facing` the cosine between it and the ray.
std::optional<Texel> Shader::texel(const Surface& s, const Hit& hit, double world_area, double facing) const {
  const MeshPool& pool = drawing_.meshes;
  const PooledMesh& m = pool[drawing_.mesh_of[hit.use]];
  if (!s.texture || m.texcoords == PooledMesh::absent) return {};
  const float* c[3];
  for (int k = 0; k < 3; ++k) c[k] = pool.value(pool.texcoords, m, m.texcoords, hit.element, k);
  double picture = std::fabs(double{c[1][0] - c[0][0]} * (c[2][1] - c[0][1]) - double{c[2][0] - c[0][0]} * (c[1][1] - c[0][1]));
  double pixels = picture * std::fabs(s.texcoords.determinant()) * s.texture->width() * s.texture->height();
  double span = hit.distance * camera_.sample();
  double detail = world_area > 0 ? span * std::sqrt(pixels / world_area / std::max(facing, 0.05)) : 1;
  return texture_at(pool, m, s, hit, detail);
}

/// The sum of 4.14.4, without fog.
V3 Shader::light(const Surface& s, const V3& base, const LitPoint& at, std::uint32_t scope) const {
  Lit material = s.material;
  material.diffuse = base;
  V3 sum = s.emissive;
  if (headlight_) sum += contribution(*headlight_, at, material);
  for (const Light& l : everywhere_) sum += contribution(l, at, material);
  for (; scope; scope = drawing_.stage.scopes[scope].parent)
    if (scoped_[scope]) sum += contribution(*scoped_[scope], at, material);
  return sum;
}

}  // namespace wrlkit::drawing
