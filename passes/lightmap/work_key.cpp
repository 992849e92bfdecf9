#include "passes/lightmap/work_key.h"

#include <algorithm>
#include <cmath>

#include "light/spiral.h"
#include "passes/lightmap/checkpoint.h"

namespace wrlkit::bake {
namespace {

using drawing::V3;

constexpr std::size_t most_places = 2048,
                      all_places = 1 << 20;  // of a Shape and of the world where colours are asked for

/// Only of types without padding, whose bytes could be any.
class Key {
 public:
  template <class T>
  void add(std::span<const T> values) {
    hash_ = hash_bytes(values.data(), values.size_bytes(), hash_);
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(std::span<const T>(values));
  }
  void add(std::initializer_list<double> numbers) { add(std::span(numbers.begin(), numbers.size())); }
  void add(std::initializer_list<V3> vectors) { add(std::span(vectors.begin(), vectors.size())); }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = hash_bytes(nullptr, 0);
};

void add_lamp(const light::Lamp& lamp, Key& key) {
  const auto& l = lamp.light;
  key.add({lamp.irradiance, l.location, l.direction, l.attenuation, l.to_local.x, l.to_local.y, l.to_local.z,
           l.to_local.t});
  key.add({double(l.kind), l.radius, l.beam_width, l.cut_off_angle});
  if (l.fall) key.add({l.fall->distance, l.fall->strength});
}

void add_lamps(const light::LightWorld& world, Key& key) {
  for (const auto& l : world.lamps()) add_lamp(l, key);
  std::uint32_t scope = 0;
  for (const auto& use : world.stage().uses) {
    if (use.lights == scope) continue;
    scope = use.lights;
    key.add({double(scope)});
    world.each_directional(scope, [&](const light::Lamp& l) { add_lamp(l, key); });
  }
}

/// From all sides alike.
void add_sky(const light::LightWorld& world, Key& key) {
  constexpr int n = 256;
  for (int i = 0; world.has_sky() && i < n; ++i) key.add({world.sky(light::spiral_direction(i, n))});
}

/// Both sides, at places by Roberts' R2 lattice, folded into the triangle.
void add_surface(const light::LightWorld& world, std::uint32_t use, std::size_t n_places, Key& key) {
  const auto& mesh = world.meshes()[world.mesh_of()[use]];
  for (std::uint32_t element = 0; element < mesh.n_elements && mesh.kind == Mesh::Kind::faces; ++element)
    for (std::size_t k = 0; k < std::max<std::size_t>(1, n_places / mesh.n_elements); ++k) {
      double u = std::fmod(0.5 + 0.7548776662466927 * double(k), 1),
             v = std::fmod(0.5 + 0.5698402909980532 * double(k), 1);
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      for (const bool back : {false, true}) {
        const auto s = world.surface({.use = use, .element = element, .back = back, .weights = {1 - u - v, u, v}});
        key.add({s.albedo, s.emission});
        key.add({s.alpha, double(s.inside)});
      }
    }
}

}  // namespace

std::uint64_t work_key(const std::vector<Part>& parts, const Layout& layout, const light::LightWorld& world,
                       const BakeOptions& o) {
  Key key;
  key.add({double(o.samples), double(o.rays), double(o.most_rays), o.error, double(o.denoise), double(o.directional)});
  key.add({double(o.integrator.mode), double(o.integrator.rays), o.integrator.cell, double(o.integrator.seed)});
  key.add({world.radius()});
  key.add({world.centre()});
  for (const auto& p : layout.pages()) {
    key.add(p.triangles);
    key.add(p.refs);
  }
  for (const Part& p : parts) key.add(p.normals);
  key.add(world.meshes().points);
  key.add(world.stage().frames);
  add_lamps(world, key);
  add_sky(world, key);
  const std::size_t n_uses = world.stage().uses.size(),
                    n_places = std::min(most_places, all_places / std::max<std::size_t>(1, n_uses));
  for (std::uint32_t use = 0; use < n_uses; ++use) add_surface(world, use, n_places, key);
  return key.value();
}

}  // namespace wrlkit::bake
