// Shooting: see methods.h. Every ray carries about the same power, so a side gets as many rays as its unshot light is
// worth, and a side that has less than a ray's worth gets one by chance. Sides are done in rounds, all those together
// that have at least half as much as the brightest; the deposits of a round are added in the order of the sides.
#include <algorithm>

#include "base/parallel.h"
#include "light/patches/methods.h"
#include "light/transport.h"

namespace wrlkit::light {
namespace {

constexpr double enough = 1e-4;  // of the light is left when shooting ends
constexpr int rays_to_lamps = 16;

struct Deposit {
  std::uint32_t side;
  V3 power;
};

class Shooting {
 public:
  Shooting(const PatchedWorld& world, const MethodOptions& options)
      : world_(world),
        options_(options),
        direct_(world.world()),
        transport_(world.world(), direct_, nullptr),
        received_(world.n_sides()),
        unshot_(world.n_sides()),
        shot_(world.n_sides()) {}

  std::vector<V3> run() {
    start();
    const double first = total();
    const double a_ray = first / (static_cast<double>(options_.samples) * static_cast<double>(world_.n_sides()));
    double left = first;
    for (std::uint32_t round = 0; left > enough * first; ++round) {
      shoot(brightest(), a_ray, round);
      left = total();
      options_.done(std::min(1.0, std::log(left / first) / std::log(enough)));
    }
    share_the_rest();
    return std::move(received_);
  }

 private:
  /// Lamps and sky are no patches; what comes from them is gathered, over the area of each side.
  void start() {
    for_sides(0, static_cast<std::uint32_t>(world_.n_sides()), [&](std::uint32_t s) {
      if (!(world_.area(s) > 0)) return;
      const auto key = random_key(options_.seed, 30, s);
      const Lattice<4> ways(random_key(key, 1));
      RandomStream random(key);
      Flux f;
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(options_.samples); ++i) {
        const auto [pu, pv, du, dv] = ways[i];
        const Receiver at = world_.receiver(s, pu, pv);
        direct_.lamps(at, rays_to_lamps, random, f);
        if (!world_.world().has_sky()) continue;
        const Ray ray{at.start, cosine_direction(at.normal, du, dv)};
        f.sum += (pi * transport_.each_layer(ray, [](auto&&...) {})) * world_.world().sky(ray.direction);
      }
      received_[s] = (1.0 / options_.samples) * f.sum;
      unshot_[s] = world_.area(s) * (pi * world_.emission(s) + world_.albedo(s) * received_[s]);
    });
  }

  double total() const {
    double sum = 0;
    for (const V3& p : unshot_) sum += mean(p);
    return sum;
  }

  std::vector<std::uint32_t> brightest() const {
    double most = 0;
    for (const V3& p : unshot_) most = std::max(most, mean(p));
    std::vector<std::uint32_t> out;
    for (std::uint32_t s = 0; s < unshot_.size(); ++s)
      if (mean(unshot_[s]) >= 0.5 * most && most > 0) out.push_back(s);
    return out;
  }

  void shoot(const std::vector<std::uint32_t>& from, double a_ray, std::uint32_t round) {
    constexpr std::size_t block = 64;
    std::vector<std::vector<Deposit>> deposits((from.size() + block - 1) / block);
    parallel_for(deposits.size(), [&](std::size_t b) {
      for (std::size_t i = b * block; i < std::min(from.size(), (b + 1) * block); ++i)
        shoot_from(from[i], a_ray, round, deposits[b]);
    });
    for (auto s : from) {
      sent_ += mean(unshot_[s]);
      unshot_[s] = {};
    }
    for (const auto& list : deposits)
      for (const auto& [side, power] : list) {
        landed_ += mean(power);
        received_[side] += (1 / world_.area(side)) * power;
        unshot_[side] += world_.albedo(side) * power;
      }
  }

  void shoot_from(std::uint32_t s, double a_ray, std::uint32_t round, std::vector<Deposit>& out) {
    const auto key = random_key(options_.seed, 31, s);
    const Lattice<4> ways(random_key(key, 1));
    const double worth = mean(unshot_[s]) / a_ray;
    const auto n = static_cast<std::uint32_t>(worth + RandomStream(random_key(key, 3, round)).next());
    const V3 power = (1 / worth) * unshot_[s];
    for (std::uint32_t i = shot_[s]; i < shot_[s] + n; ++i) {
      const auto [pu, pv, du, dv] = ways[i];
      const Receiver at = world_.receiver(s, pu, pv);
      const Ray ray{at.start, cosine_direction(at.normal, du, dv)};
      transport_.each_layer(ray, [&](const Hit& hit, const SurfacePoint& p, double part) {
        const auto side = world_.side_at(hit, ray.at(hit.distance));
        // A side reflects its albedo times its alpha; `part` has the alpha already.
        if (side != PatchedWorld::none && part > 0 && world_.area(side) > 0)
          out.push_back({side, (part / p.alpha) * power});
      });
    }
    shot_[s] += n;
  }

  /// The ambient term: what is left goes to all alike, and is reflected for ever, as far as it does not leave the
  /// world.
  void share_the_rest() {
    V3 left, reflecting;
    double area = 0;
    for (std::uint32_t s = 0; s < unshot_.size(); ++s) {
      left += unshot_[s];
      reflecting += world_.area(s) * world_.albedo(s);
      area += world_.area(s);
    }
    if (!(area > 0) || !(sent_ > 0)) return;
    const double staying = std::min(1.0, landed_ / sent_);
    const V3 rho = (staying / area) * reflecting;
    const V3 ambient = (staying / area) * V3(left.x / (1 - rho.x), left.y / (1 - rho.y), left.z / (1 - rho.z));
    for (V3& e : received_) e += ambient;
  }

  const PatchedWorld& world_;
  const MethodOptions& options_;
  DirectLight direct_;
  Transport transport_;
  std::vector<V3> received_, unshot_;  // irradiance; power that has not been shot yet
  std::vector<std::uint32_t> shot_;    // rays so far
  double sent_ = 0, landed_ = 0;       // power of all rays, and of those that met a patch
};

}  // namespace

std::vector<V3> shoot_progressively(const PatchedWorld& world, const MethodOptions& options) {
  return Shooting(world, options).run();
}

}  // namespace wrlkit::light
