#include "passes/light/radiosity.h"

#include <algorithm>

#include "passes/parallel.h"

namespace wrlkit::light {
namespace {

using Cell = IrradianceCache::Cell;

constexpr std::size_t fewest_walks = 1 << 14, most_walks = 1 << 18;
constexpr int walk_length = 4;       // rays
constexpr std::size_t block = 256;   // walks or cells that are done in one piece
constexpr int iterations = 8, warm_up = 2, rays_a_cell = 16;
constexpr std::uint32_t often = 4;   // meetings that make a cell known
constexpr double least_agreement = 0.15;  // of a place's light with the mean of its cell

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
  Solver(IrradianceCache& cache, const LightWorld& world, const DirectLight& direct, std::uint64_t seed)
      : cache_(cache), world_(world), direct_(direct), transport_(world, direct, &cache), seed_(seed) {}

  void run(std::span<const Receiver> from) {
    discover(from);
    const std::size_t n = cache_.cells().size();
    of_place_.assign(n * IrradianceCache::most_places, {});
    in_blocks(n, [&](std::size_t c) { light_directly(c); });
    start();
    for (int i = 0; i < iterations; ++i) iterate(i);
    for (std::size_t c = 0; c < n; ++c) judge(c);
  }

 private:
  /// What a cell gathers: from the sky and from direct light, and from what others have gathered.
  struct Gathered {
    V3 first, further;
  };

  void discover(std::span<const Receiver> from);
  void walk(Receiver at, Stream& random, std::vector<Meeting>& out) const;
  void light_directly(std::size_t c);
  void start();
  void iterate(int iteration);
  Gathered gather(std::size_t c, int iteration);
  Gathered look(const Ray& ray, Stream& random) const;
  void judge(std::size_t c);

  IrradianceCache& cache_;
  const LightWorld& world_;
  const DirectLight& direct_;
  Transport transport_;
  std::uint64_t seed_;
  V3 mean_gathered_;                   // of all cells
  std::vector<V3> sum_;                // by cell: gathered after the warm-up
  std::vector<double> of_place_;       // by cell and place: all its light so far, to see whether places agree
};

void Solver::discover(std::span<const Receiver> from) {
  if (from.empty()) return;
  std::size_t n = std::clamp(from.size(), fewest_walks, most_walks), n_blocks = (n + block - 1) / block;
  std::vector<std::vector<Meeting>> met(n_blocks);
  parallel_for(n_blocks, [&](std::size_t b) {
    for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i) {
      Stream random(key_of(seed_, 1, i));
      walk(from[i * from.size() / n], random, met[b]);
    }
  });
  Stream rank(key_of(seed_, 2));
  for (const auto& list : met)
    for (const Meeting& m : list) cache_.meet(m.key, m.place, rank.bits());
}

void Solver::walk(Receiver at, Stream& random, std::vector<Meeting>& out) const {
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
      if (auto key = cache_.key(s.position, s.face, at.scope, hit.distance)) out.push_back({*key, at});
    });
    if (!found || next >= strength) return;
  }
}

void Solver::light_directly(std::size_t c) {
  constexpr int lamp_rays = 4, emitter_rays = 4;
  Cell& cell = cache_.cells()[c];
  for (int p = 0; p < cell.n_places(); ++p) {
    Stream random(key_of(seed_, 3, c * IrradianceCache::most_places + p));
    Flux lamps, emitters;
    direct_.lamps(cell.places[p], lamp_rays, random, lamps);
    direct_.emitters(cell.places[p], Lattice<3>(random.bits()), 0, emitter_rays, false, emitters);
    V3 e = lamps.sum + (1.0 / emitter_rays) * emitters.sum;
    of_place_[c * IrradianceCache::most_places + p] = mean(e) * iterations * rays_a_cell / cell.n_places();
    cell.direct += (1.0 / cell.n_places()) * e;
  }
}

/// As if all cells saw one another alike. What is wrong with that goes away with the first corrections.
void Solver::start() {
  V3 sum;
  double n = 0;
  for (const Cell& c : cache_.cells()) sum += double(c.n_met) * c.direct, n += c.n_met;
  mean_gathered_ = n > 0 ? (1 / n) * sum : V3();
  for (Cell& c : cache_.cells()) c.gathered = mean_gathered_;
  sum_.assign(cache_.cells().size(), {});
}

Solver::Gathered Solver::look(const Ray& ray, Stream& random) const {
  Gathered out;
  double open = transport_.each_layer(ray, [&](const Hit& hit, const SurfacePoint& s, double part) {
    if (!world_.emitter_of(hit.use, hit.element)) out.first += (part * pi) * s.emission;
    if (!(mean(s.albedo) > 0)) return;
    auto key = cache_.key(s.position, s.face, world_.stage().uses[hit.use].lights, hit.distance);
    const Cell* cell = key ? cache_.find(*key) : nullptr;
    V3 direct, gathered = mean_gathered_;
    if (cell) {
      direct = cell->direct, gathered = cell->gathered;
    } else {
      Flux f;
      Receiver at = transport_.receiver_at(hit, s);
      direct_.lamps(at, 1, random, f);
      direct_.emitters(at, Lattice<3>(random.bits()), 0, 1, false, f);
      direct = f.sum;
    }
    out.first += part * (s.albedo * direct);
    out.further += part * (s.albedo * gathered);
  });
  if (open > 0 && world_.has_sky()) out.first += (open * pi) * world_.sky(ray.direction);
  return out;
}

Solver::Gathered Solver::gather(std::size_t c, int iteration) {
  const Cell& cell = cache_.cells()[c];
  Stream random(key_of(seed_, 4, c * iterations + iteration));
  Lattice<2> directions(key_of(seed_, 5, c));
  Gathered sum;
  for (int i = 0; i < rays_a_cell; ++i) {
    int place = i % cell.n_places();
    const Receiver& at = cell.places[place];
    auto [u, v] = directions[static_cast<std::uint32_t>(iteration * rays_a_cell + i)];
    Ray ray{at.start, cosine_direction(at.normal, u, v)};
    if (!(dot(ray.direction, at.face) > 0)) continue;
    Gathered g = look(ray, random);
    sum.first += g.first;
    sum.further += g.further;
    of_place_[c * IrradianceCache::most_places + place] += mean(g.first + g.further);
  }
  return {(1.0 / rays_a_cell) * sum.first, (1.0 / rays_a_cell) * sum.further};
}

/// All cells gather once from what all had before. What the whole world is too bright or too dark by would need many
/// iterations to go away; it is found from the sums over all cells and corrected at once.
void Solver::iterate(int iteration) {
  auto& cells = cache_.cells();
  std::vector<Gathered> now(cells.size());
  in_blocks(cells.size(), [&](std::size_t c) { now[c] = gather(c, iteration); });
  V3 first, lacking, sum;
  double n = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    double w = cells[c].n_met;
    first += w * now[c].first;
    lacking += w * (cells[c].gathered - now[c].further);
    n += w;
  }
  auto ratio = [](double a, double b) { return b > 0 ? std::clamp(a / b, 0.1, 10.0) : 1; };
  V3 scale{ratio(first.x, lacking.x), ratio(first.y, lacking.y), ratio(first.z, lacking.z)};
  int counted = std::max(0, iteration - warm_up + 1);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    V3 e = now[c].first + scale * now[c].further;
    if (counted) sum_[c] += e;
    cells[c].gathered = counted ? (1.0 / counted) * sum_[c] : e;
    sum += double(cells[c].n_met) * cells[c].gathered;
  }
  if (n > 0) mean_gathered_ = (1 / n) * sum;
}

/// A cell on both sides of a wall, or of the edge of a shadow, is not to be relied on.
void Solver::judge(std::size_t c) {
  Cell& cell = cache_.cells()[c];
  auto first = of_place_.begin() + static_cast<std::ptrdiff_t>(c * IrradianceCache::most_places), last = first + cell.n_places();
  double sum = 0;
  for (auto p = first; p != last; ++p) sum += *p;
  cell.trusted = cell.n_met >= often && *std::min_element(first, last) >= least_agreement * sum / cell.n_places();
}

}  // namespace

void fill(IrradianceCache& cache, const LightWorld& world, const DirectLight& direct, std::span<const Receiver> from, std::uint64_t seed) {
  Solver(cache, world, direct, seed).run(from);
}

}  // namespace wrlkit::light
