#include "passes/lower_x3d/particles.h"

#include <algorithm>
#include <cmath>

#include "base/stop.h"
#include "passes/lower_x3d/geometry.h"
#include "passes/lower_x3d/particle_emitter.h"
#include "scenegraph/any_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

namespace k = nodes;
namespace system_ = nodes::particle_system;

constexpr std::int32_t most_particles = 10'000, most_in_all = 50'000;
constexpr double moment = 1;  // seconds after the beginning

struct Particle {
  Vec3 position, velocity;
  double age;   // seconds
  double life;  // part of its life that has gone
};

/// What moves all particles alike.
struct Forces {
  Vec3 force{0, 0, 0};     // newtons
  Vec3 pressure{0, 0, 0};  // newtons on a square metre
};

Forces forces_of(const Scene& scene, NodeId n) {
  Forces out;
  for (const NodeId model : scene.get(n, system_::physics)) {
    if (scene.is(model, k::ForcePhysicsModel)) {
      namespace f = k::force_physics_model;
      if (scene.get(model, f::enabled)) out.force = out.force + scene.get(model, f::force);
    } else if (scene.is(model, k::WindPhysicsModel)) {
      namespace f = k::wind_physics_model;
      const double speed = scene.get(model, f::speed);
      if (scene.get(model, f::enabled))  // the pressure by the speed: 40.4.12
        out.pressure = out.pressure + 0.64615 * speed * speed * unit(scene.get(model, f::direction));
    }
  }
  return out;
}

std::vector<Particle> particles_of(const Scene& scene, NodeId n, const ParticleEmitter& emitter, std::int32_t at_most) {
  const double life = scene.get(n, system_::particleLifetime), variation = scene.get(n, system_::lifetimeVariation);
  const auto most = std::clamp(scene.get(n, system_::maxParticles), 0, at_most);
  if (!(life > 0) || !std::isfinite(life)) return {};
  const double now = std::min(moment, life / 2);
  const int count = emitter.is_explosion() ? most : static_cast<int>(std::ceil(std::min(1.0, now / life) * most));
  const Forces forces = forces_of(scene, n);
  RandomStream random(random_key(22, static_cast<std::uint64_t>(most)));
  std::vector<Particle> out;
  for (int i = 0; i < count; ++i) {
    const ParticleStart start = emitter.start(random);
    const double own_life = ParticleEmitter::varied(life, variation, random);
    const double age = emitter.is_explosion() ? now : now * (i + 0.5) / count;
    if (age >= own_life) continue;
    const double by_mass = start.mass > 0 ? 1 / start.mass : 0;
    const Vec3 change = by_mass * (forces.force + start.surface_area * forces.pressure);
    const Particle p{start.position + age * start.velocity + age * age / 2 * change, start.velocity + age * change, age,
                     age / own_life};
    if (std::isfinite(dot(p.position, p.position))) out.push_back(p);
  }
  return out;
}

/// Values by parts of a life, mixed in between.
class Ramp {
 public:
  Ramp(std::span<const double> keys, std::span<const double> values, std::size_t width)
      : keys_(keys.begin(), keys.end()), values_(values.begin(), values.end()), width_(width) {
    keys_.resize(std::min(keys_.size(), values_.size() / width_));
  }
  bool any() const { return !keys_.empty(); }
  void add(double at, std::vector<double>& out) const {
    const auto next = static_cast<std::size_t>(std::ranges::upper_bound(keys_, at) - keys_.begin());
    const std::size_t b = std::min(next, keys_.size() - 1), a = next > 0 ? next - 1 : 0;
    const double span = keys_[b] - keys_[a], t = span > 0 ? (at - keys_[a]) / span : 0;
    for (std::size_t i = 0; i < width_; ++i)
      out.push_back(values_[a * width_ + i] + t * (values_[b * width_ + i] - values_[a * width_ + i]));
  }

 private:
  std::vector<double> keys_, values_;
  std::size_t width_;
};

class StillParticles {
 public:
  StillParticles(Scene& scene, NodeId n, std::vector<Particle> particles)
      : scene_(scene), n_(n), particles_(std::move(particles)) {}

  void make() {
    const auto type = scene_.get(n_, system_::geometryType);
    const Vec2 size = scene_.get(n_, system_::particleSize);
    if (type == "GEOMETRY") return become_copies();
    if (type == "POINT")
      become_shape(points());
    else if (type == "LINE")
      become_shape(lines(size[1]));
    else if (type == "TRIANGLE")
      become_shape(faces({{{-size[0] / 2, -size[1] / 2}, {size[0] / 2, -size[1] / 2}, {0, size[1] / 2}}},
                         {{{0, 0}, {1, 0}, {0.5, 1}}}));
    else
      become_shape(faces({{{-size[0] / 2, -size[1] / 2},
                           {size[0] / 2, -size[1] / 2},
                           {size[0] / 2, size[1] / 2},
                           {-size[0] / 2, size[1] / 2}}},
                         {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}));
  }

 private:
  using Outline = std::vector<Vec2>;

  NodeId add(TypeId type) { return scene_.add(type, scene_.where(n_)); }

  NodeId coordinates(const std::vector<double>& points) {
    const NodeId to = add(k::Coordinate);
    scene_.set(to, k::coordinate::point, points);
    return to;
  }

  /// One for each of that many corners of each particle; none where the system has no colours.
  NodeId colors(std::size_t corners) {
    const NodeId from = scene_.get(n_, system_::color);
    const bool with_alpha = scene_.is(from, k::ColorRGBA);
    if (!with_alpha && !scene_.is(from, k::Color)) return {};
    const Ramp ramp(scene_.get(n_, system_::colorKey),
                    with_alpha ? scene_.get(from, k::color_rgba::color) : scene_.get(from, k::color::color),
                    with_alpha ? 4 : 3);
    if (!ramp.any()) return {};
    std::vector<double> out;
    for (const Particle& p : particles_)
      for (std::size_t i = 0; i < corners; ++i) ramp.add(p.life, out);
    const NodeId to = add(with_alpha ? k::ColorRGBA : k::Color);
    if (with_alpha)
      scene_.set(to, k::color_rgba::color, out);
    else
      scene_.set(to, k::color::color, out);
    return to;
  }

  NodeId points() {
    std::vector<double> at;
    for (const Particle& p : particles_) at.insert(at.end(), p.position.begin(), p.position.end());
    const NodeId to = add(k::PointSet);
    scene_.set(to, k::point_set::coord, coordinates(at));
    if (const NodeId c = colors(1)) scene_.set(to, k::point_set::color, c);
    return to;
  }

  /// Along the way of each.
  NodeId lines(double size) {
    std::vector<double> at;
    std::vector<std::int32_t> index;
    for (const Particle& p : particles_) {
      const Vec3 half = size / 2 * unit(p.velocity == Vec3{0, 0, 0} ? Vec3{0, 1, 0} : p.velocity);
      for (const Vec3& end : {p.position - half, p.position + half}) {
        index.push_back(static_cast<std::int32_t>(at.size() / 3));
        at.insert(at.end(), end.begin(), end.end());
      }
      index.push_back(-1);
    }
    namespace f = k::indexed_line_set;
    const NodeId to = add(k::IndexedLineSet);
    scene_.set(to, f::coord, coordinates(at), f::coordIndex, index);
    if (const NodeId c = colors(2)) scene_.set(to, f::color, c);
    return to;
  }

  /// Each in a plane across Z.
  NodeId faces(const Outline& outline, const Outline& places) {
    std::vector<double> at, texture;
    std::vector<std::int32_t> index;
    for (const Particle& p : particles_) {
      for (std::size_t i = 0; i < outline.size(); ++i) {
        index.push_back(static_cast<std::int32_t>(at.size() / 3));
        at.insert(at.end(), {p.position[0] + outline[i][0], p.position[1] + outline[i][1], p.position[2]});
        const Vec2 place = place_of(p, i, outline.size(), places[i]);
        texture.insert(texture.end(), place.begin(), place.end());
      }
      index.push_back(-1);
    }
    namespace f = k::indexed_face_set;
    const NodeId to = add(k::IndexedFaceSet), coord = add(k::TextureCoordinate);
    scene_.set(coord, k::texture_coordinate::point, texture);
    scene_.set(to, f::coord, coordinates(at), f::texCoord, coord, f::coordIndex, index, f::solid, false);
    if (const NodeId c = colors(outline.size())) scene_.set(to, f::color, c);
    return to;
  }

  /// Of the last key that the particle has passed.
  Vec2 place_of(const Particle& p, std::size_t corner, std::size_t corners, const Vec2& otherwise) const {
    const NodeId from = scene_.get(n_, system_::texCoord);
    if (!scene_.is(from, k::TextureCoordinate)) return otherwise;
    const auto all = scene_.get(from, k::texture_coordinate::point);
    const auto keys = scene_.get(n_, system_::texCoordKey);
    const auto passed =
        static_cast<std::size_t>(std::ranges::count_if(keys, [&](double key) { return key <= p.life; }));
    const std::size_t at = 2 * ((passed > 0 ? passed - 1 : 0) * corners + corner);
    return at + 1 < all.size() ? Vec2{all[at], all[at + 1]} : otherwise;
  }

  void become_shape(NodeId geometry) {
    scene_.become(n_, k::Shape, fields_for(scene_, n_, k::Shape));
    scene_.set(n_, k::shape::geometry, geometry);
  }

  void become_copies() {
    const NodeId shape = add(k::Shape);
    if (const NodeId look = scene_.get(n_, system_::appearance)) scene_.set(shape, k::shape::appearance, look);
    if (const NodeId what = scene_.get(n_, system_::geometry)) scene_.set(shape, k::shape::geometry, what);
    std::vector<NodeId> children;
    for (const Particle& p : particles_) {
      children.push_back(add(k::Transform));
      scene_.set(children.back(), k::transform::translation, p.position, k::transform::children,
                 std::vector<NodeId>{shape});
    }
    scene_.become(n_, k::Group, fields_for(scene_, n_, k::Group));
    scene_.set(n_, k::group::children, children);
  }

  Scene& scene_;
  NodeId n_;
  std::vector<Particle> particles_;
};

}  // namespace

bool lower_particles(Scene& scene, PassContext& ctx) {
  if (!any_node(scene, [&](NodeId n) { return scene.is(n, nodes::ParticleSystem); })) return false;
  bool changed = false;
  std::int32_t left = most_in_all;
  for (const NodeId n : all_nodes(scene)) {
    check_stop();
    if (!scene.is(n, k::ParticleSystem) || !scene.get(n, system_::enabled) || !scene.get(n, system_::createParticles))
      continue;
    const ParticleEmitter emitter(scene, scene.get(n, system_::emitter), ctx);
    changed = true;  // an emitter makes faces of its geometry
    if (!emitter.any()) continue;
    const auto at_most = std::min(left, most_particles);
    if (scene.get(n, system_::maxParticles) > at_most)
      ctx.diag.report(Diag::expansion_limit, scene.where(n), at_most < most_particles ? most_in_all : most_particles,
                      "particles");
    auto particles = particles_of(scene, n, emitter, at_most);
    left -= static_cast<std::int32_t>(particles.size());
    if (particles.empty()) continue;
    StillParticles(scene, n, std::move(particles)).make();
    ctx.diag.report(Diag::drawn_otherwise, scene.where(n), "ParticleSystem", "as it stands in its first second");
  }
  return changed;
}

}  // namespace wrlkit::x3d
