#include "passes/lower_x3d/particle_emitter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/geometry.h"
#include "geometry/tessellation.h"
#include "passes/lower_x3d/geometry.h"
#include "scenegraph/nodes.h"

namespace wrlkit::x3d {
namespace {

namespace k = nodes;
constexpr std::size_t most_tries = 64, most_tests = 16'384;  // for a point within a volume; of triangles

Vec3 random_direction(RandomStream& random) {
  const double z = 2 * random.next() - 1, a = 2 * std::numbers::pi * random.next(), r = std::sqrt(1 - z * z);
  return {r * std::cos(a), r * std::sin(a), z};
}

/// Evenly within a cone of that half angle.
Vec3 within_cone(const Vec3& axis, double angle, RandomStream& random) {
  const double least = std::cos(std::clamp(angle, 0.0, std::numbers::pi));
  const double c = least + (1 - least) * random.next(), s = std::sqrt(std::max(0.0, 1 - c * c)),
               a = 2 * std::numbers::pi * random.next();
  const Vec3 z = unit(axis), x = unit(cross(std::abs(z[0]) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, z)), y = cross(z, x);
  return c * z + s * (std::cos(a) * x + std::sin(a) * y);
}

/// Whether a ray along X from that point crosses the triangle.
bool crosses(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto side = [&](const Vec3& from, const Vec3& to) {
    return (to[1] - from[1]) * (p[2] - from[2]) - (to[2] - from[2]) * (p[1] - from[1]);
  };
  const double u = side(b, c), v = side(c, a), w = side(a, b), sum = u + v + w;
  if (sum == 0 || ((u < 0) != (v < 0)) || ((v < 0) != (w < 0))) return false;
  return (u * a[0] + v * b[0] + w * c[0]) / sum > p[0];
}

}  // namespace

double ParticleEmitter::varied(double value, double variation, RandomStream& random) {
  return std::max(0.0, value * (1 + variation * (2 * random.next() - 1)));
}

template <class Keys>
void ParticleEmitter::read_common(Keys keys) {
  any_ = scene_.get(n_, keys.on);
  speed_ = scene_.get(n_, keys.speed);
  variation_ = scene_.get(n_, keys.variation);
  mass_ = scene_.get(n_, keys.mass);
  surface_area_ = scene_.get(n_, keys.area);
}

ParticleEmitter::ParticleEmitter(Scene& scene, NodeId emitter, PassContext& ctx)
    : scene_(scene), n_(emitter), ctx_(ctx) {
  using Bool = FieldKey<FieldType::SFBool>;
  using Float = FieldKey<FieldType::SFFloat>;
  struct Keys {
    Bool on;
    Float speed, variation, mass, area;
  };
  if (scene.is(n_, k::PointEmitter)) {
    namespace f = k::point_emitter;
    read_common(Keys{f::on, f::speed, f::variation, f::mass, f::surfaceArea});
    position_ = scene.get(n_, f::position);
    direction_ = scene.get(n_, f::direction);
  } else if (scene.is(n_, k::ConeEmitter)) {
    namespace f = k::cone_emitter;
    read_common(Keys{f::on, f::speed, f::variation, f::mass, f::surfaceArea});
    position_ = scene.get(n_, f::position);
    direction_ = scene.get(n_, f::direction);
    angle_ = scene.get(n_, f::angle);
  } else if (scene.is(n_, k::ExplosionEmitter)) {
    namespace f = k::explosion_emitter;
    read_common(Keys{f::on, f::speed, f::variation, f::mass, f::surfaceArea});
    position_ = scene.get(n_, f::position);
    is_explosion_ = true;
  } else if (scene.is(n_, k::PolylineEmitter)) {
    namespace f = k::polyline_emitter;
    read_common(Keys{f::on, f::speed, f::variation, f::mass, f::surfaceArea});
    direction_ = scene.get(n_, f::direction);
    take_lines();
  } else if (scene.is(n_, k::SurfaceEmitter)) {
    namespace f = k::surface_emitter;
    read_common(Keys{f::on, f::speed, f::variation, f::mass, f::surfaceArea});
    along_normal_ = true;
    take_faces(scene.get(n_, f::surface));
  } else if (scene.is(n_, k::VolumeEmitter)) {
    namespace f = k::volume_emitter;
    read_common(Keys{f::on, f::speed, f::variation, f::mass, f::surfaceArea});
    direction_ = scene.get(n_, f::direction);
    is_volume_ = scene.get(n_, f::internal);
    take_volume();
  }
}

void ParticleEmitter::add(const Piece& p, double size) {
  if (!(size > 0) || !std::isfinite(size)) return;
  pieces_.push_back(p);
  pieces_.back().until = size + (pieces_.size() > 1 ? pieces_[pieces_.size() - 2].until : 0);
}

void ParticleEmitter::take_lines() {
  namespace f = k::polyline_emitter;
  const NodeId coord = scene_.get(n_, f::coord);
  if (!scene_.is(coord, k::Coordinate)) return void(any_ = false);
  const auto points = scene_.get(coord, k::coordinate::point);
  const auto index = scene_.get(n_, f::coordIndex);
  const auto point = [&](std::int32_t i) { return wrlkit::vec3(&points[3 * static_cast<std::size_t>(i)]); };
  const auto is_point = [&](std::int32_t i) { return i >= 0 && static_cast<std::size_t>(i) < points.size() / 3; };
  for (std::size_t i = 1; i < index.size(); ++i) {
    if (!is_point(index[i - 1]) || !is_point(index[i])) continue;
    const Vec3 a = point(index[i - 1]), b = point(index[i]);
    add({a, b, b, 0}, length(b - a));
  }
  any_ &= !pieces_.empty();
}

void ParticleEmitter::take_faces(NodeId geometry) {
  if (!geometry) return void(any_ = false);
  lower_geometry(scene_, geometry);
  Mesh mesh;
  MeshScratch scratch;
  MeshJob job{scene_, geometry, mesh, scratch, ctx_};
  make_mesh(job, {});
  if (!mesh.is_triangles()) return void(any_ = false);
  for (std::size_t i = 0; i + 2 < mesh.corners.size(); i += 3) {
    const Vec3 a = mesh.position(mesh.corners[i]), b = mesh.position(mesh.corners[i + 1]),
               c = mesh.position(mesh.corners[i + 2]);
    const double area = length(cross(b - a, c - a)) / 2;
    mesh.ccw ? add({a, b, c, 0}, area) : add({a, c, b, 0}, area);
  }
  any_ &= !pieces_.empty();
}

/// Its own points and faces, as those of an IndexedFaceSet.
void ParticleEmitter::take_volume() {
  namespace f = k::volume_emitter;
  const NodeId faces = scene_.add(k::IndexedFaceSet, scene_.where(n_));
  if (const NodeId coord = scene_.get(n_, f::coord)) scene_.set(faces, k::indexed_face_set::coord, coord);
  const auto index = scene_.get(n_, f::coordIndex);
  scene_.set(faces, k::indexed_face_set::coordIndex, std::vector<std::int32_t>(index.begin(), index.end()));
  take_faces(faces);
  Box box;
  for (const Piece& p : pieces_)
    for (const Vec3& corner : {p.a, p.b, p.c}) box.add(corner);
  if (!any_) return;
  low_ = box.low;
  high_ = box.high;
}

const ParticleEmitter::Piece& ParticleEmitter::piece(RandomStream& random) const {
  const double at = random.next() * pieces_.back().until;
  return *std::ranges::upper_bound(pieces_.begin(), pieces_.end() - 1, at, {}, &Piece::until);
}

bool ParticleEmitter::is_inside(const Vec3& p) const {
  return std::ranges::count_if(pieces_, [&](const Piece& t) { return crosses(p, t.a, t.b, t.c); }) % 2 != 0;
}

/// A point of the volume; of the middle of the box where none is found.
Vec3 ParticleEmitter::inside(RandomStream& random) const {
  const auto tries = std::clamp<std::size_t>(most_tests / std::max<std::size_t>(pieces_.size(), 1), 1, most_tries);
  for (std::size_t i = 0; i < tries; ++i) {
    Vec3 p;
    for (std::size_t d = 0; d < 3; ++d) p[d] = low_[d] + (high_[d] - low_[d]) * random.next();
    if (is_inside(p)) return p;
  }
  return 0.5 * (low_ + high_);
}

ParticleStart ParticleEmitter::start(RandomStream& random) const {
  Vec3 at = position_, way = direction_;
  if (is_volume_) {
    at = inside(random);
  } else if (!pieces_.empty()) {
    const Piece& p = piece(random);
    const bool is_line = p.b == p.c;
    double u = random.next(), v = is_line ? 0 : random.next();
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    at = p.a + u * (p.b - p.a) + v * (p.c - p.a);
    if (along_normal_) way = cross(p.b - p.a, p.c - p.a);
  }
  if (is_explosion_ || way == Vec3{0, 0, 0})
    way = random_direction(random);
  else if (angle_ > 0)
    way = within_cone(way, angle_, random);
  return {at, varied(speed_, variation_, random) * unit(way), varied(mass_, variation_, random),
          varied(surface_area_, variation_, random)};
}

}  // namespace wrlkit::x3d
