// Irradiance of the surfaces of the world, coarsely: what a final gather looks up where its rays end.
//
// A cell is a cube of space together with about one direction of faces, so thin plates have two, curved surfaces
// several, and any number of tiny triangles share one. There are cells only where rays have ended. A ray that ends far
// away looks up a large cell and one that ends near a small one, so that a cell spans about the same angle from
// wherever it is seen.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "light/flux.h"

namespace wrlkit::light {

class IrradianceCache {
 public:
  static constexpr int most_places = 8;
  using Key = std::uint64_t;

  struct Cell {
    Receiver places[most_places];  // a fair choice of where rays ended in it
    std::uint32_t n_met = 0;       // rays that ended in it
    V3 direct, gathered;           // mean irradiance from lamps and emitters, and from all else

    int n_places() const { return n_met < most_places ? static_cast<int>(n_met) : most_places; }
    V3 irradiance() const { return direct + gathered; }
  };

  /// Cells have sides of at most `largest`, world units; positions are relative to `centre`. Those of number 1 lie half
  /// a cell askew to those of number 0.
  IrradianceCache(const V3& centre, double largest, int number = 0);

  /// Where a ray ends.
  struct RayEnd {
    V3 position, face;
    std::uint32_t scope;
    double distance;  // how far the ray has come
  };

  static constexpr int levels = 7;  // each half as large as the one before

  /// The cell for a place; none when it is too near for any cell. `larger`: one whose sides are 2^larger times as long,
  /// or the largest.
  std::optional<Key> key(const RayEnd& place, int larger = 0) const;
  /// The cell of a place or, when no ray has ended there, the smallest of those that are up to `larger` times twice as
  /// large. Null when none of them is there.
  const Cell* find(const RayEnd& place, int larger = 0) const;
  /// Makes the cell when it is new. `rank` is a random number for this meeting.
  void meet(Key key, const Receiver& place, std::uint64_t rank);

  /// Forgets the cells for which `keep`, by number, is false.
  void keep_only(std::span<const char> keep);

  std::vector<Cell>& cells() { return cells_; }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  int level_for(double distance) const;
  Key key_at(const RayEnd& place, int level) const;
  std::size_t slot(Key key) const;
  void rebuild(std::size_t size);

  V3 centre_, offset_;       // of the grid: in world units, and in cells
  double finest_;            // ratio of a distance to it: which cells are small enough
  double per_unit_[levels];  // cells, by level
  std::vector<Cell> cells_;
  std::vector<Key> keys_;  // of the cells
  struct Entry {
    Key key = 0;
    std::uint32_t cell = 0;  // its number + 1; 0: free
  };
  std::vector<Entry> table_;  // by key
};

}  // namespace wrlkit::light
