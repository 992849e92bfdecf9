#include "light/integrator.h"

#include <algorithm>

#include "base/parallel.h"
#include "light/radiosity.h"

namespace wrlkit::light {
namespace {

constexpr std::size_t points_a_block = 64;  // points that are done in one piece
constexpr int gather_lamp_rays = 16;
constexpr double largest_cell = 0.1;  // of the cache, by the radius of the world

Receiver receiver(const LightWorld& world, const Point& p) {
  std::uint32_t scope = p.use == Point::nowhere ? 0 : world.stage().uses[p.use].lights;
  return {world.off_surface(p.position, p.face, p.extent), p.face, p.normal, scope};
}

Rgb rgb(const V3& c) { return {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)}; }

}  // namespace

struct Integrator::State {
  const LightWorld& world;
  IntegratorOptions options;
  DirectLight direct;
  IrradianceCache cache;
  Transport transport;

  State(const LightWorld& w, const IntegratorOptions& o)
      : world(w),
        options(o),
        direct(w),
        cache(w.centre(), o.cell > 0 ? o.cell : w.radius() * largest_cell, o.cache),
        transport(w, direct, o.mode == IntegratorOptions::Mode::cached ? &cache : nullptr) {}
};

namespace {

/// The rays of one point.
class Estimate {
 public:
  Estimate(const DirectLight& direct, const Transport& transport, bool all_emitters, const Receiver& at,
           std::uint64_t key, std::uint32_t first)
      : direct_(direct),
        transport_(transport),
        at_(at),
        all_emitters_(all_emitters),
        key_(key),
        first_(first),
        random_(first ? random_key(key, 4, first) : key),
        directions_(random_key(key, 1)),
        places_(random_key(key, 2)) {
    direct_.lamps(at_, gather_lamp_rays, random_, lamps_);
  }

  void trace(std::uint32_t n) {
    if (all_emitters_)
      direct_.all_emitters(at_, random_key(key_, 3), first_ + n_, n, emitters_, emitter_noise_);
    else
      direct_.emitters(at_, places_, first_ + n_, n, emitters_);
    for (std::uint32_t i = n_; i < n_ + n; ++i) gather(i);
    n_ += n;
  }

  Irradiance result() const {
    Irradiance out;
    double each = 1.0 / n_;
    out.direct = rgb(lamps_.sum + each * emitters_.sum);
    out.gathered = rgb(each * gathered_.sum);
    out.direct_variance = rgb(all_emitters_ ? each * each * emitter_noise_ : emitters_.variance(n_));
    out.gathered_variance = rgb(gathered_.variance(n_));
    for (int k = 0; k < 3; ++k) out.along[k] = rgb(lamps_.along[k] + each * (emitters_.along[k] + gathered_.along[k]));
    out.inside = static_cast<float>(n_inside_ * each);
    out.rays = n_;
    out.by_lamp = mean(lamps_.sum) > 0;
    return out;
  }

 private:
  void gather(std::uint32_t i) {
    auto [u, v] = directions_[first_ + i];
    V3 direction = cosine_direction(at_.normal, u, v);
    if (!(dot(direction, at_.face) > 0)) return;
    Arriving a = transport_.gather(at_, {at_.start, direction}, random_, all_emitters_);
    gathered_.add(pi * (a.direct + a.reflected), direction);
    n_inside_ += a.from_inside;
  }

  const DirectLight& direct_;
  const Transport& transport_;
  Receiver at_;
  bool all_emitters_;  // each is looked at, so that rays leave them out
  std::uint64_t key_;
  std::uint32_t first_;  // rays that others have
  RandomStream random_;
  Lattice<2> directions_;
  Lattice<3> places_;
  Flux lamps_, emitters_, gathered_;
  V3 emitter_noise_;
  std::uint32_t n_ = 0, n_inside_ = 0;
};

}  // namespace

Integrator::Integrator(const LightWorld& world, std::span<const Point> points, const IntegratorOptions& options)
    : state_(new State(world, options)) {
  State& s = *state_;
  std::vector<Receiver> from;
  for (const Point& p : points) from.push_back(receiver(world, p));
  if (options.mode != IntegratorOptions::Mode::cached) return;
  const double n_points = options.points > 0 ? options.points : static_cast<double>(points.size());
  fill(s.cache, world, s.direct, from, options.rays, n_points * options.rays,
       options.cache ? random_key(options.seed, 7) : options.seed);
}

Integrator::~Integrator() = default;
Integrator::Integrator(Integrator&&) noexcept = default;

int Integrator::rays() const { return state_->options.rays; }

std::vector<Irradiance> Integrator::irradiance(std::span<const Point> points, std::size_t first,
                                               const Round& round) const {
  const State& s = *state_;
  const bool all_emitters = s.options.mode == IntegratorOptions::Mode::cached && s.direct.has_few_emitters();
  std::vector<Irradiance> out(points.size());
  parallel_for((points.size() + points_a_block - 1) / points_a_block, [&](std::size_t b) {
    for (std::size_t i = b * points_a_block; i < std::min(points.size(), (b + 1) * points_a_block); ++i) {
      Estimate e(s.direct, s.transport, all_emitters, receiver(s.world, points[i]),
                 random_key(s.options.seed, 6, first + (round.numbers.empty() ? i : round.numbers[i])), round.first);
      e.trace(static_cast<std::uint32_t>(std::max(1, round.rays)));
      out[i] = e.result();
    }
  });
  return out;
}

}  // namespace wrlkit::light
