#include "passes/light/cache.h"

#include "passes/light/random.h"

namespace wrlkit::light {
namespace {

constexpr double angle = 0.25;       // that a cell spans at most, seen from where the ray comes
constexpr int levels = 7;            // each half as large as the one before

/// One of 19 steps of direction along each axis would split flat faces by rounding where a step ends at a usual direction;
/// these end at 14, 49 degrees and so on.
std::int64_t direction_step(double v) { return std::llround(2 * v); }

}  // namespace

std::optional<IrradianceCache::Key> IrradianceCache::key(const V3& position, const V3& face, std::uint32_t scope, double distance) const {
  double size = largest_;
  int level = 0;
  while (size > angle * distance && ++level < levels) size *= 0.5;
  if (level == levels) return {};
  // The grid stands askew to the numbers that people write, so that no wall lies on its planes.
  V3 p = (1 / size) * (position - centre_) + V3(0.137, 0.271, 0.419);
  auto whole = [](double v) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(v))); };
  std::int64_t direction = direction_step(face.x) * 25 + direction_step(face.y) * 5 + direction_step(face.z);
  Key where = key_of(whole(p.x), whole(p.y), whole(p.z));
  return key_of(where, static_cast<std::uint64_t>(direction + 100) * levels + static_cast<std::uint64_t>(level), scope);
}

std::size_t IrradianceCache::slot(Key key) const {
  std::size_t at = key & (table_.size() - 1);
  while (table_[at] && keys_[table_[at] - 1] != key) at = (at + 1) & (table_.size() - 1);
  return at;
}

const IrradianceCache::Cell* IrradianceCache::find(Key key) const {
  if (table_.empty()) return nullptr;
  std::uint32_t cell = table_[slot(key)];
  return cell ? &cells_[cell - 1] : nullptr;
}

void IrradianceCache::grow() {
  table_.assign(std::max<std::size_t>(1024, table_.size() * 2), 0);
  for (std::uint32_t c = 0; c < cells_.size(); ++c) table_[slot(keys_[c])] = c + 1;
}

void IrradianceCache::meet(Key key, const Receiver& place, std::uint64_t rank) {
  if (cells_.size() * 2 >= table_.size()) grow();
  std::size_t at = slot(key);
  if (!table_[at]) {
    cells_.emplace_back();
    keys_.push_back(key);
    table_[at] = static_cast<std::uint32_t>(cells_.size());
  }
  Cell& c = cells_[table_[at] - 1];
  // Each of n meetings stays with the same probability (Vitter's algorithm R).
  std::uint64_t keep = c.n_met < most_places ? c.n_met : rank % (c.n_met + 1);
  if (keep < most_places) c.places[keep] = place;
  ++c.n_met;
}

}  // namespace wrlkit::light
