// Irradiance of the surfaces of the world, coarsely: what a final gather looks up where its rays end.
//
// A cell is a cube of space together with about one direction of faces, so thin plates have two, curved surfaces several,
// and any number of tiny triangles share one. There are cells only where rays have ended. A ray that ends far away looks up
// a large cell and one that ends near a small one, so that a cell spans about the same angle from wherever it is seen.
#pragma once
#include <optional>
#include <vector>

#include "passes/light/flux.h"

namespace wrlkit::light {

class IrradianceCache {
 public:
  static constexpr int most_places = 8;
  using Key = std::uint64_t;

  struct Cell {
    Receiver places[most_places];    // a fair choice of where rays ended in it
    std::uint32_t n_met = 0;         // rays that ended in it
    V3 direct, gathered;             // mean irradiance from lamps and emitters, and from all else
    bool trusted = false;            // it has been met often, and its places agree

    int n_places() const { return n_met < most_places ? static_cast<int>(n_met) : most_places; }
    V3 irradiance() const { return direct + gathered; }
  };

  /// Cells have sides of at most `largest`, world units; positions are relative to `centre`.
  IrradianceCache(const V3& centre, double largest) : centre_(centre), largest_(largest) {}

  /// The cell for a place that a ray meets after a distance; none when it is too near for any cell.
  std::optional<Key> key(const V3& position, const V3& face, std::uint32_t scope, double distance) const;
  /// Null when no ray has ended there.
  const Cell* find(Key key) const;
  /// Makes the cell when it is new. `rank` is a random number for this meeting.
  void meet(Key key, const Receiver& place, std::uint64_t rank);

  std::vector<Cell>& cells() { return cells_; }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  std::size_t slot(Key key) const;
  void grow();

  V3 centre_;
  double largest_;
  std::vector<Cell> cells_;
  std::vector<Key> keys_;            // of the cells
  std::vector<std::uint32_t> table_; // cell + 1 by hash of its key; 0: free
};

}  // namespace wrlkit::light
