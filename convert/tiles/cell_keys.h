// What tells whether a tile was made before: a hash of all that it is made of.
#pragma once
#include <functional>
#include <string>

#include "convert/tiles/looks.h"
#include "convert/tiles/piece_store.h"
#include "geometry/space_cells.h"

namespace wrlkit::tiles {

/// A key for each cell: tiles with one key have the same bytes. Of a leaf, by its pieces, in order, and their looks. Of
/// a cell above, by those of all that is simplified with it: `top_of` gives the largest cell of those. `options` is
/// what else decides about bytes. O(pieces) for each level of cells that are their own tops.
std::vector<ContentHash> keys_of_cells(const Cells& cells, std::span<const PieceStore::Entry> pieces,
                                       const Looks& looks, const std::string& options,
                                       const std::function<std::uint32_t(std::uint32_t cell)>& top_of);

}  // namespace wrlkit::tiles
