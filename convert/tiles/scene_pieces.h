// The pieces of one scene.
#pragma once
#include <functional>
#include <map>
#include <string>

#include "convert/document.h"
#include "convert/tiles/looks.h"
#include "convert/tiles/piece.h"

namespace wrlkit::tiles {

struct SceneCounts {
  std::size_t n_pieces = 0, n_cut = 0;           // n_cut: of those, made by cutting what is too large for a tile
  std::map<std::string, std::size_t> lost = {};  // by the type of the node, and ROUTEs: what tiles have no place for
};

struct PiecesWanted {
  const std::string& source;     // what the file is called
  std::size_t most;              // triangles of a piece
  std::string_view passes = {};  // that the document goes through first, as -p has them
};

/// Expands the document, and hands out what each Shape shows in each place, in the order of the file. What has more
/// triangles than are wanted comes in several pieces, cut in space. False when the world could not be expanded or
/// `put` has had enough. Memory: one mesh next to the document.
bool pieces_of(Document& document, const PiecesWanted& wanted, Looks& looks,
               const std::function<bool(const Piece&)>& put, SceneCounts& counts);

}  // namespace wrlkit::tiles
