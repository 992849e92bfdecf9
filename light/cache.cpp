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

int IrradianceCache::level_for(double distance) const {
  const double times = distance / finest_;
  if (!(times >= 1)) return levels;
  return std::max(0, levels - 1 - std::ilogb(times));
}

IrradianceCache::Key IrradianceCache::key(const RayEnd& place, int level) const {
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

std::size_t IrradianceCache::slot(Key key) const {
  std::size_t at = key & (table_.size() - 1);
  while (table_[at].cell && table_[at].key != key) at = (at + 1) & (table_.size() - 1);
  return at;
}

const IrradianceCache::Cell* IrradianceCache::at(const RayEnd& place, int level) const {
  if (table_.empty()) return nullptr;
  const std::uint32_t number = table_[slot(key(place, level))].cell;
  if (!number) return nullptr;
  const Cell& c = cells_[number - 1];
  const V3& p = place.position;
  const bool within =
      p.x >= c.low.x && p.y >= c.low.y && p.z >= c.low.z && p.x <= c.high.x && p.y <= c.high.y && p.z <= c.high.z;
  return within ? &c : nullptr;
}

const IrradianceCache::Cell* IrradianceCache::find(const RayEnd& place) const {
  for (int l = level_for(place.distance); l < levels; ++l)
    if (const Cell* c = at(place, l)) return c;
  return nullptr;
}

const IrradianceCache::Cell* IrradianceCache::find_larger(const RayEnd& place, int larger) const {
  const int level = level_for(place.distance);
  for (int l = level - 1; l >= std::max(0, level - larger); --l)
    if (const Cell* c = at(place, l)) return c;
  return nullptr;
}

void IrradianceCache::rebuild(std::size_t size) {
  table_.assign(size, {});
  for (std::uint32_t c = 0; c < cells_.size(); ++c) table_[slot(keys_[c])] = {keys_[c], c + 1};
}

void IrradianceCache::add(Key key, const Cell& cell) {
  if (cells_.size() * 2 >= table_.size()) rebuild(std::max<std::size_t>(1024, table_.size() * 2));
  cells_.push_back(cell);
  keys_.push_back(key);
  table_[slot(key)] = {key, static_cast<std::uint32_t>(cells_.size())};
}

}  // namespace wrlkit::light
