#include "light/radiosity.h"

#include <algorithm>

#include "base/parallel.h"
#include "light/links.h"

namespace wrlkit::light {
namespace {

using Cell = IrradianceCache::Cell;

constexpr std::size_t most_walks = 1 << 17;
constexpr int walk_length = 4;       // rays
constexpr std::size_t block = 256;   // walks or cells that are done in one piece
constexpr std::ptrdiff_t often = 4;  // meetings that make a cell known
constexpr int most_reflections = 6;  // reflections outside of cells

/// How well the cells are known.
struct Effort {
  std::size_t fewest_walks;
  int rays;  // of a cell
};
constexpr Effort thorough{1 << 16, 128}, quick{1 << 15, 64};
constexpr int few = 16;  // rays a point: below, the quick way will do

/// A place where a walk ended a ray.
struct Meeting {
  IrradianceCache::Key key;
  Receiver place;
};

template <class F>
void in_blocks(std::size_t n, F&& f) {
  parallel_for((n + block - 1) / block, [&](std::size_t b) {
    for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i) f(i);
  });
}

class Solver {
 public:
  Solver(IrradianceCache& cache, const LightWorld& world, const DirectLight& direct, const Effort& effort,
         std::uint64_t seed)
      : cache_(cache),
        world_(world),
        direct_(direct),
        transport_(world, direct, &cache),
        effort_(effort),
        seed_(seed) {}

  void run(std::span<const Receiver> from) {
    discover(from);
    keep_sound_cells();
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
  void keep_sound_cells();
  bool is_sound(const Cell& cell) const;
  void light_directly(std::size_t c);
  void gather(std::size_t c, LinkedCell& out) const;
  void look(const Receiver& at, const Ray& ray, RandomStream& random, const V3& share, int depth,
            LinkedCell& out) const;
  void follow(const Receiver& at, RandomStream& random, const V3& share, int depth, LinkedCell& out) const;

  IrradianceCache& cache_;
  const LightWorld& world_;
  const DirectLight& direct_;
  Transport transport_;
  Effort effort_;
  std::uint64_t seed_;
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
  std::vector<const Meeting*> order;
  for (const auto& list : met)
    for (const Meeting& m : list) order.push_back(&m);
  std::stable_sort(order.begin(), order.end(), [](const Meeting* a, const Meeting* b) { return a->key < b->key; });
  RandomStream rank(random_key(seed_, 2));
  for (auto first = order.begin(), last = first; first != order.end(); first = last) {
    while (last != order.end() && (*last)->key == (*first)->key) ++last;
    if (last - first < often) continue;  // rarely met cells cost more than they bring
    for (auto m = first; m != last; ++m) cache_.meet((*m)->key, (*m)->place, rank.bits());
  }
}

void Solver::keep_sound_cells() {
  const auto& cells = cache_.cells();
  std::vector<char> sound(cells.size());
  in_blocks(cells.size(), [&](std::size_t c) { sound[c] = is_sound(cells[c]); });
  cache_.keep_only(sound);
}

/// A cell on both sides of a wall would let light through: all its places must see one another. They look from above
/// the surface, so that one that is bent a little does not stand in the way.
bool Solver::is_sound(const Cell& cell) const {
  for (int p = 1; p < cell.n_places(); ++p) {
    double height = 0.25 * length(cell.places[p].start - cell.places[0].start);
    V3 from = cell.places[0].start + height * cell.places[0].face,
       way = cell.places[p].start + height * cell.places[p].face - from;
    double distance = length(way);
    if (distance > 0 && world_.transmittance({from, (1 / distance) * way}, distance) == 0) return false;
  }
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
      if (auto key = cache_.key({ray.at(hit.distance), s.face, at.scope, hit.distance})) out.push_back({*key, at});
    });
    if (!found || next >= strength) return;
  }
}

void Solver::light_directly(std::size_t c) {
  constexpr int lamp_rays = 4;
  const int emitter_rays = effort_.rays / IrradianceCache::most_places;
  Cell& cell = cache_.cells()[c];
  for (int p = 0; p < cell.n_places(); ++p) {
    RandomStream random(random_key(seed_, 3, c * IrradianceCache::most_places + p));
    Flux lamps, emitters;
    direct_.lamps(cell.places[p], lamp_rays, random, lamps);
    direct_.emitters(cell.places[p], Lattice<3>(random.bits()), 0, emitter_rays, emitters);
    V3 e = lamps.sum + (1.0 / emitter_rays) * emitters.sum;
    cell.direct += (1.0 / cell.n_places()) * e;
  }
}

/// Adds what comes along a ray, times `share`: from the sky and from direct light, and links to cells.
void Solver::look(const Receiver& from, const Ray& ray, RandomStream& random, const V3& share, int depth,
                  LinkedCell& out) const {
  const double open = transport_.each_layer(ray, [&](const Hit& hit, const SurfacePoint& s, double part) {
    if (mean(s.emission) > 0) out.first += (part * pi * direct_.gather_weight(from, ray, hit)) * (share * s.emission);
    if (!(mean(s.albedo) > 0)) return;
    const V3 reflected = part * (share * s.albedo);
    IrradianceCache::RayEnd place{ray.at(hit.distance), s.face, world_.stage().uses[hit.use].lights, hit.distance};
    const Cell* cell = cache_.find(place, 2);
    if (!cell) return follow(transport_.receiver_at(hit, s), random, reflected, depth + 1, out);
    out.first += reflected * cell->direct;
    out.link(static_cast<std::uint32_t>(cell - cache_.cells().data()), reflected);
  });
  if (open > 0 && world_.has_sky()) out.first += (open * pi) * (share * world_.sky(ray.direction));
}

/// Where there is no cell: an estimate by one more ray.
void Solver::follow(const Receiver& at, RandomStream& random, const V3& share, int depth, LinkedCell& out) const {
  Flux f;
  direct_.lamps(at, 1, random, f);
  direct_.emitters(at, Lattice<3>(random.bits()), 0, 1, f);
  out.first += share * f.sum;
  const double u = random.next(), v = random.next();
  const V3 direction = cosine_direction(at.normal, u, v);
  if (depth < most_reflections && dot(direction, at.face) > 0)
    look(at, {at.start, direction}, random, share, depth, out);
}

void Solver::gather(std::size_t c, LinkedCell& out) const {
  const Cell& cell = cache_.cells()[c];
  RandomStream random(random_key(seed_, 4, c));
  Lattice<2> directions(random_key(seed_, 5, c));
  for (int i = 0; i < effort_.rays; ++i) {
    const Receiver& at = cell.places[i % cell.n_places()];
    auto [u, v] = directions[static_cast<std::uint32_t>(i)];
    const Ray ray{at.start, cosine_direction(at.normal, u, v)};
    if (dot(ray.direction, at.face) > 0) look(at, ray, random, V3(1.0 / effort_.rays), 0, out);
  }
  out.merge();
}

}  // namespace

void fill(IrradianceCache& cache, const LightWorld& world, const DirectLight& direct, std::span<const Receiver> from,
          int rays, std::uint64_t seed) {
  Solver(cache, world, direct, rays < few ? quick : thorough, seed).run(from);
}

}  // namespace wrlkit::light
