#include "light/radiosity.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "light/links.h"

namespace wrlkit::light {
namespace {

using Cell = IrradianceCache::Cell;

constexpr std::size_t most_walks = 1 << 17;
constexpr int walk_length = 4;       // rays
constexpr std::size_t block = 256;   // walks or cells that are done in one piece
constexpr std::ptrdiff_t often = 4;  // meetings that make a cell known
constexpr int near = 2;              // reflections outside of cells after which any cell will do, however large
constexpr std::size_t most_places = 1 << 20, fewest_places = 8;  // of all cells; of one
constexpr int most_rays = 2048;                                  // of a cell
constexpr double share_of_cells = 1. / 16;                       // of the work that the cells are for

/// How well the cells are known.
struct Effort {
  std::size_t fewest_walks;
  int rays;  // of a cell, at least
  std::size_t places;
};
constexpr Effort thorough{1 << 16, 128, 128}, quick{1 << 15, 64, 32};
constexpr int few = 16;  // rays a point: below, the quick way will do

/// A place where a walk ended a ray.
struct Meeting {
  IrradianceCache::Key key;
  IrradianceCache::RayEnd end;
  int level;
  Receiver place;
};

using Places = std::vector<Receiver>;

Places chosen(std::span<const Meeting* const> met, std::size_t most) {
  const std::size_t n = std::min(met.size(), most);
  Places out;
  for (std::size_t k = 0; k < n; ++k) out.push_back(met[k * met.size() / n]->place);
  return out;
}

template <class F>
void in_blocks(std::size_t n, F&& f) {
  parallel_for((n + block - 1) / block, [&](std::size_t b) {
    for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i) f(i);
  });
}

class Solver {
 public:
  Solver(IrradianceCache& cache, const LightWorld& world, const DirectLight& direct, const Effort& effort, double work,
         std::uint64_t seed)
      : cache_(cache),
        world_(world),
        direct_(direct),
        transport_(world, direct, &cache),
        effort_(effort),
        work_(work),
        seed_(seed) {}

  void run(std::span<const Receiver> from) {
    discover(from);
    const double each = share_of_cells * work_ / static_cast<double>(std::max<std::size_t>(1, places_.size()));
    rays_ = static_cast<int>(std::clamp<double>(each, effort_.rays, most_rays));
    in_blocks(cache_.cells().size(), [&](std::size_t c) { light_directly(c); });
    auto& cells = cache_.cells();
    std::vector<LinkedCell> linked(cells.size());
    in_blocks(cells.size(), [&](std::size_t c) { gather(c, linked[c]); });
    const auto light = solve(linked);
    for (std::size_t c = 0; c < cells.size(); ++c) cells[c].gathered = light[c];
  }

 private:
  void discover(std::span<const Receiver> from);
  void walk(Receiver at, RandomStream& random, std::vector<Meeting>& out) const;
  std::vector<Meeting> make_cells(const std::vector<Meeting>& met);
  Cell cell_of(std::span<const Meeting* const> met) const;
  bool is_sound(std::span<const Meeting* const> met, const Places& places) const;
  void light_directly(std::size_t c);
  void gather(std::size_t c, LinkedCell& out) const;
  void look(const Receiver& at, const Ray& ray, RandomStream& random, const V3& share, int depth,
            LinkedCell& out) const;
  void follow(const Receiver& at, const V3& albedo, RandomStream& random, const V3& share, int depth,
              LinkedCell& out) const;

  IrradianceCache& cache_;
  const LightWorld& world_;
  const DirectLight& direct_;
  Transport transport_;
  Effort effort_;
  double work_;
  std::uint64_t seed_;
  std::vector<Places> places_;  // by cell: a fair choice of where rays ended in it
  int rays_ = 0;                // of a cell
};

void Solver::discover(std::span<const Receiver> from) {
  if (from.empty()) return;
  std::size_t n = std::clamp(from.size(), effort_.fewest_walks, most_walks), n_blocks = (n + block - 1) / block;
  std::vector<std::vector<Meeting>> met(n_blocks);
  parallel_for(n_blocks, [&](std::size_t b) {
    for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i) {
      RandomStream random(random_key(seed_, 1, i));
      walk(from[i * from.size() / n], random, met[b]);
    }
  });
  std::vector<Meeting> by_level[IrradianceCache::levels];
  for (auto& list : met) {
    for (const Meeting& m : list) by_level[m.level].push_back(m);
    list = {};
  }
  // The largest first: what is in those that are not sound is met in smaller ones, too.
  std::vector<Meeting> rest;
  for (auto& here : by_level) {
    here.insert(here.end(), rest.begin(), rest.end());
    rest = make_cells(std::exchange(here, {}));
  }
}

/// What was met in cells that are not sound, to be looked for in smaller ones.
std::vector<Meeting> Solver::make_cells(const std::vector<Meeting>& met) {
  std::vector<const Meeting*> order;
  for (const Meeting& m : met) order.push_back(&m);
  std::stable_sort(order.begin(), order.end(), [](const Meeting* a, const Meeting* b) { return a->key < b->key; });
  std::vector<std::span<const Meeting* const>> groups;
  for (auto first = order.begin(), last = first; first != order.end(); first = last) {
    while (last != order.end() && (*last)->key == (*first)->key) ++last;
    if (last - first >= often) groups.emplace_back(first, last);  // others cost more than they bring
  }
  const std::size_t most =
      std::clamp(most_places / std::max<std::size_t>(1, groups.size()), fewest_places, effort_.places);
  std::vector<Places> places(groups.size());
  std::vector<char> sound(groups.size());
  in_blocks(groups.size(), [&](std::size_t g) {
    places[g] = chosen(groups[g], most);
    sound[g] = is_sound(groups[g], places[g]);
  });
  std::vector<Meeting> rest;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (sound[g]) {
      cache_.add(groups[g].front()->key, cell_of(groups[g]));
      places_.push_back(std::move(places[g]));
    } else if (groups[g].front()->level + 1 < IrradianceCache::levels) {
      for (const Meeting* m : groups[g]) {
        rest.push_back(*m);
        rest.back().key = cache_.key(m->end, ++rest.back().level);
      }
    }
  }
  return rest;
}

Cell Solver::cell_of(std::span<const Meeting* const> met) const {
  Cell out{.place = met.front()->place, .low = met.front()->end.position, .high = met.front()->end.position};
  for (const Meeting* m : met) {
    out.low = min(out.low, m->end.position);
    out.high = max(out.high, m->end.position);
  }
  const V3 around(cache_.side(met.front()->level) / static_cast<double>(met.size() + 1));
  out.low = out.low - around;
  out.high += around;
  return out;
}

/// A cell on both sides of a wall would let light through: its places must see one another, also those at its ends,
/// where there may be few.
bool Solver::is_sound(std::span<const Meeting* const> met, const Places& places) const {
  constexpr std::size_t tested = 16;
  const Receiver* last = &places.front();
  const auto sees_last = [&](const Receiver& r) { return see_one_another(world_, *std::exchange(last, &r), r); };
  for (double V3::*axis : {&V3::x, &V3::y, &V3::z}) {
    const auto [low, high] = std::ranges::minmax(met, {}, [&](const Meeting* m) { return m->place.start.*axis; });
    if (!sees_last(low->place) || !sees_last(high->place)) return false;
  }
  for (std::size_t k = 0; k < places.size(); k += (places.size() + tested - 1) / tested)
    if (!sees_last(places[k])) return false;
  return true;
}

void Solver::walk(Receiver at, RandomStream& random, std::vector<Meeting>& out) const {
  double strength = 1;
  for (int length = 0; length < walk_length; ++length) {
    double u = random.next(), v = random.next(), met = random.next(), next = random.next();
    Ray ray{at.start, cosine_direction(at.normal, u, v)};
    if (!(dot(ray.direction, at.face) > 0)) return;
    bool found = false;
    transport_.each_layer(ray, [&](const Hit& hit, const SurfacePoint& s, double part) {
      met -= part;
      if (found || met >= 0) return;
      found = true;
      strength *= std::max({s.albedo.x, s.albedo.y, s.albedo.z});
      at = transport_.receiver_at(hit, s);
      if (!(strength > 0)) return;
      const IrradianceCache::RayEnd end{ray.at(hit.distance), s.face, at.scope, hit.distance};
      const int level = cache_.level_for(hit.distance);
      if (level < IrradianceCache::levels) out.push_back({cache_.key(end, level), end, level, at});
    });
    if (!found || next >= strength) return;
  }
}

void Solver::light_directly(std::size_t c) {
  constexpr int lamp_rays = 4;
  const Places& places = places_[c];
  const auto n = static_cast<int>(places.size()), emitter_rays = (rays_ + n - 1) / n;
  V3 sum;
  for (int p = 0; p < n; ++p) {
    RandomStream random(random_key(seed_, 3, c * effort_.places + static_cast<std::size_t>(p)));
    Flux lamps, emitters;
    direct_.lamps(places[p], lamp_rays, random, lamps);
    direct_.emitters(places[p], Lattice<3>(random.bits()), 0, emitter_rays, emitters);
    sum += lamps.sum + (1.0 / emitter_rays) * emitters.sum;
  }
  cache_.cells()[c].direct = (1.0 / n) * sum;
}

/// Adds what comes along a ray, times `share`: from the sky and from direct light, and links to cells.
void Solver::look(const Receiver& from, const Ray& ray, RandomStream& random, const V3& share, int depth,
                  LinkedCell& out) const {
  const auto meet = [&](const Hit& hit, const SurfacePoint& s, double part) {
    if (mean(s.emission) > 0) out.first += (part * pi * direct_.gather_weight(from, ray, hit)) * (share * s.emission);
    if (!(mean(s.albedo) > 0)) return;
    const V3 reflected = part * (share * s.albedo);
    const Cell* cell = transport_.cell_at(ray, hit, s, depth < near ? 2 : IrradianceCache::levels);
    if (!cell) return follow(transport_.receiver_at(hit, s), s.albedo, random, reflected, depth + 1, out);
    out.first += reflected * cell->direct;
    out.link(static_cast<std::uint32_t>(cell - cache_.cells().data()), reflected);
  };
  const double open = depth == 0 ? transport_.each_layer(ray, meet) : transport_.one_layer(ray, random, meet);
  if (open > 0 && world_.has_sky()) out.first += (open * pi) * (share * world_.sky(ray.direction));
}

/// Where there is no cell: an estimate by one more ray.
void Solver::follow(const Receiver& at, const V3& albedo, RandomStream& random, const V3& share, int depth,
                    LinkedCell& out) const {
  constexpr int certain = 6, deepest = 64;  // reflections
  Flux f;
  direct_.lamps(at, 1, random, f);
  direct_.emitters(at, Lattice<3>(random.bits()), 0, 1, f);
  out.first += share * f.sum;
  const double u = random.next(), v = random.next();
  const double survival = depth < certain ? 1 : std::max({albedo.x, albedo.y, albedo.z});
  if (depth == deepest || random.next() >= survival) return;
  const V3 direction = cosine_direction(at.normal, u, v);
  if (dot(direction, at.face) > 0) look(at, {at.start, direction}, random, (1 / survival) * share, depth, out);
}

void Solver::gather(std::size_t c, LinkedCell& out) const {
  const Places& places = places_[c];
  RandomStream random(random_key(seed_, 4, c));
  Lattice<2> directions(random_key(seed_, 5, c));
  for (int i = 0; i < rays_; ++i) {
    const Receiver& at = places[static_cast<std::size_t>(i) % places.size()];
    auto [u, v] = directions[static_cast<std::uint32_t>(i)];
    const Ray ray{at.start, cosine_direction(at.normal, u, v)};
    if (dot(ray.direction, at.face) > 0) look(at, ray, random, V3(1.0 / rays_), 0, out);
  }
  out.merge();
}

}  // namespace

void fill(IrradianceCache& cache, const LightWorld& world, const DirectLight& direct, std::span<const Receiver> from,
          int rays, double work, std::uint64_t seed) {
  Solver(cache, world, direct, rays < few ? quick : thorough, work, seed).run(from);
}

}  // namespace wrlkit::light
