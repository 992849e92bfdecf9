// Irradiance of the surfaces of the world, coarsely: what a final gather looks up where its rays end.
//
// A cell is a cube of space together with about one direction of faces, so thin plates have two, curved surfaces
// several, and any number of tiny triangles share one. There are cells only where rays have ended. A ray that ends far
// away looks up a large cell and one that ends near a small one, so that a cell spans about the same angle from
// wherever it is seen. Where walls or things divide a cell, there are smaller ones instead.
#pragma once
#include <cstdint>
#include <vector>

#include "light/flux.h"

namespace wrlkit::light {

class IrradianceCache {
 public:
  using Key = std::uint64_t;

  struct Cell {
    V3 direct, gathered;  // mean irradiance from lamps and emitters, and from all else
    Receiver place;       // one of those where rays ended in it
    V3 low, high;         // of where they did, with as much around as a few rays leave out: beyond may be a wall

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

  /// Level 0 has the largest cells.
  Key key(const RayEnd& place, int level) const;
  /// The first level whose cells are small enough for that distance; `levels` when none is.
  int level_for(double distance) const;
  /// The cell of a place or, when there is none, the largest of those that are smaller. Null when none of them is
  /// there.
  const Cell* find(const RayEnd& place) const;
  /// The smallest of those that are up to `larger` times twice as large. A wall may stand between it and the place:
  /// nobody has looked.
  const Cell* find_larger(const RayEnd& place, int larger) const;
  /// A new cell, for a key that has none.
  void add(Key key, const Cell& cell);
  /// Of the cells of a level.
  double side(int level) const { return 1 / per_unit_[level]; }

  std::vector<Cell>& cells() { return cells_; }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  std::size_t slot(Key key) const;
  const Cell* at(const RayEnd& place, int level) const;
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
