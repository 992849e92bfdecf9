#include "convert/tiles/cell_keys.h"

#include <algorithm>
#include <unordered_map>

namespace wrlkit::tiles {
namespace {

template <class T>
void add(std::string& to, const T& value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Of the pieces of a cell, in the order of the files. Looks count by their order among those of the cell, in which
/// their meshes are written, whatever their numbers.
ContentHash hash_of_range(const Cells& cells, const Cell& cell, std::span<const PieceStore::Entry> pieces,
                          const Looks& looks, const std::string& options) {
  std::vector<std::uint32_t> order(cells.order.begin() + cell.begin, cells.order.begin() + cell.end);
  std::ranges::sort(order);
  std::vector<std::uint32_t> used;
  for (const auto i : order) used.push_back(pieces[i].look);
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::string all = options;
  for (const auto look : used) add(all, looks.hash(look));
  for (const auto i : order) {
    add(all, pieces[i].hash);
    add(all, static_cast<std::uint32_t>(std::ranges::lower_bound(used, pieces[i].look) - used.begin()));
  }
  return hash_of(all);
}

}  // namespace

std::vector<ContentHash> keys_of_cells(const Cells& cells, std::span<const PieceStore::Entry> pieces,
                                       const Looks& looks, const std::string& options,
                                       const std::function<std::uint32_t(std::uint32_t)>& top_of) {
  std::vector<ContentHash> out;
  std::unordered_map<std::uint32_t, ContentHash> of_tops;
  for (std::uint32_t i = 0; i < cells.cells.size(); ++i) {
    const Cell& cell = cells.cells[i];
    const bool is_leaf = cell.children.empty();
    const auto top = is_leaf ? i : top_of(i);
    const auto [at, is_new] = of_tops.try_emplace(top);
    if (is_new) at->second = hash_of_range(cells, cells.cells[top], pieces, looks, options);
    const auto way = cell.name.substr(cells.cells[top].name.size());
    out.push_back(hash_of((is_leaf ? "leaf " : "coarse ") + at->second.hex() + way));
  }
  return out;
}

}  // namespace wrlkit::tiles
