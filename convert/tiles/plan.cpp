#include "convert/tiles/plan.h"

#include <algorithm>

namespace wrlkit::tiles {
namespace {

constexpr std::size_t least_saving = 3;  // a coarse tile has at most one triangle of that many

/// Bytes in a tile for each of a stored piece: a little more than plants take, so that budgets mostly hold.
double packing(GltfCompression::Method method) {
  switch (method) {
    case GltfCompression::Method::none:
      return 2;
    case GltfCompression::Method::quantize:
      return 1;
    case GltfCompression::Method::meshopt:
    case GltfCompression::Method::draco:
      return 0.4;
  }
  return 2;
}

}  // namespace

Cells planned_cells(std::span<const PieceStore::Entry> pieces, const Looks& looks, const TilesOptions& options) {
  std::vector<LookCost> costs;
  for (std::uint32_t i = 0; i < looks.size(); ++i) costs.push_back({looks.family(i), looks.picture_bytes(i)});
  const CellBudget most{options.triangles, options.draws, options.bytes, packing(options.save.compress)};
  return cut_into_cells(pieces, most, costs);
}

std::uint32_t Plan::top_of(std::uint32_t cell) const {
  while (cell != 0 && fits(cell) && fits(cells_[cell].parent)) cell = cells_[cell].parent;
  return cell;
}

std::size_t Plan::target(std::uint32_t cell) const {
  const auto& tile = tiles_[cell];
  const double bytes = packing(options_.save.compress) * static_cast<double>(tile.n_stored);
  const double share = std::min(1.0, static_cast<double>(options_.bytes) / std::max(bytes, 1.0));
  const auto of_bytes = static_cast<std::uint64_t>(share * static_cast<double>(tile.n_full));
  return std::min({std::uint64_t{options_.triangles}, tile.n_full / least_saving, of_bytes});
}

std::size_t Plan::count_of(std::span<const std::uint32_t> level, std::size_t n_drawn) const {
  double full = 0, wanted = 0;
  for (const auto i : level) {
    full += static_cast<double>(tiles_[i].n_full);
    wanted += static_cast<double>(target(i));
  }
  return static_cast<std::size_t>(static_cast<double>(n_drawn) * std::min(1.0, wanted / full));
}

std::vector<std::uint32_t> Plan::cells_below(std::uint32_t top) const {
  std::vector<std::uint32_t> out, open{top};
  while (!open.empty()) {
    const auto i = open.back();
    open.pop_back();
    out.push_back(i);
    const auto& children = cells_[i].children;
    open.insert(open.end(), children.rbegin(), children.rend());
  }
  return out;
}

}  // namespace wrlkit::tiles
