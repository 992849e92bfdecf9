#include "light/cache.h"

#include "base/math/random.h"

namespace wrlkit::light {
namespace {

constexpr double angle = 0.5;  // that a cell spans at most, seen from where the ray comes

/// One of five steps along each axis. They end at 0.25 and 0.75, where the normals of few faces lie.
std::int64_t direction_step(double v) { return static_cast<std::int64_t>(2 * v + 2.5) - 2; }

}  // namespace

// The grid stands askew to the numbers that people write, so that no wall lies on its planes.
IrradianceCache::IrradianceCache(const V3& centre, double largest, int number)
    : centre_(centre),
      offset_(V3(0.137, 0.271, 0.419) + V3(0.5 * number)),
      finest_(std::ldexp(largest / angle, 1 - levels)) {
  for (int level = 0; level < levels; ++level) per_unit_[level] = std::ldexp(1 / largest, level);
}

/// The first level whose cells are small enough for that distance; `levels` when none is.
int IrradianceCache::level_for(double distance) const {
  const double times = distance / finest_;
  if (!(times >= 1)) return levels;
  return std::max(0, levels - 1 - std::ilogb(times));
}

IrradianceCache::Key IrradianceCache::key_at(const RayEnd& place, int level) const {
  const V3& face = place.face;
  V3 p = per_unit_[level] * (place.position - centre_) + offset_;
  auto whole = [](double v) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(v))); };
  const std::int64_t direction = direction_step(face.x) * 25 + direction_step(face.y) * 5 + direction_step(face.z);
  const auto kind = static_cast<std::uint64_t>(direction + 100) * levels + static_cast<std::uint64_t>(level);
  // A sum of odd multiples, which no two of so few cells will have in common, once mixed.
  return random_bits(whole(p.x) * 0x9e3779b97f4a7c15u + whole(p.y) * 0xc2b2ae3d27d4eb4fu +
                     whole(p.z) * 0x165667b19e3779f9u + kind * 0xd6e8feb86659fd93u +
                     std::uint64_t{place.scope} * 0xff51afd7ed558ccdu);
}

std::optional<IrradianceCache::Key> IrradianceCache::key(const RayEnd& place, int larger) const {
  const int level = level_for(place.distance);
  if (level == levels) return {};
  return key_at(place, std::max(0, level - larger));
}

std::size_t IrradianceCache::slot(Key key) const {
  std::size_t at = key & (table_.size() - 1);
  while (table_[at].cell && table_[at].key != key) at = (at + 1) & (table_.size() - 1);
  return at;
}

const IrradianceCache::Cell* IrradianceCache::find(const RayEnd& place, int larger) const {
  if (table_.empty()) return nullptr;
  const int level = level_for(place.distance);
  for (int l = std::min(level, levels - 1); l >= std::max(0, level - larger); --l)
    if (std::uint32_t cell = table_[slot(key_at(place, l))].cell) return &cells_[cell - 1];
  return nullptr;
}

void IrradianceCache::rebuild(std::size_t size) {
  table_.assign(size, {});
  for (std::uint32_t c = 0; c < cells_.size(); ++c) table_[slot(keys_[c])] = {keys_[c], c + 1};
}

void IrradianceCache::keep_only(std::span<const char> keep) {
  std::size_t kept = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (!keep[c]) continue;
    cells_[kept] = cells_[c];
    keys_[kept++] = keys_[c];
  }
  cells_.resize(kept);
  keys_.resize(kept);
  rebuild(table_.size());
}

void IrradianceCache::meet(Key key, const Receiver& place, std::uint64_t rank) {
  if (cells_.size() * 2 >= table_.size()) rebuild(std::max<std::size_t>(1024, table_.size() * 2));
  std::size_t at = slot(key);
  if (!table_[at].cell) {
    cells_.emplace_back();
    keys_.push_back(key);
    table_[at] = {key, static_cast<std::uint32_t>(cells_.size())};
  }
  Cell& c = cells_[table_[at].cell - 1];
  // Each of n meetings stays with the same probability (Vitter's algorithm R).
  std::uint64_t keep = c.n_met < most_places ? c.n_met : rank % (c.n_met + 1);
  if (keep < most_places) c.places[keep] = place;
  ++c.n_met;
}

}  // namespace wrlkit::light
