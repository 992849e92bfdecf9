// Which points are one: equal ones, and those within a tolerance.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh.h"
#include "passes/weld/cell_grid.h"
#include "passes/weld/value_table.h"

namespace wrlkit {

class PointJoiner {
 public:
  /// Replaces each index into `positions` (xyz, finite) by the number of its point, in the order of first appearance.
  /// `map` is working memory. Linear in the indices, whatever the number of positions that are not used.
  void join_equal(std::span<const double> positions, std::vector<std::uint32_t>& index, StampedMap& map);
  /// Then joins the points within a tolerance, and numbers again what is left.
  void join_near(double tolerance, std::vector<std::uint32_t>& index);
  /// Forgets the points that are not indexed any more, and numbers the others by their first appearance.
  void drop_unused(std::vector<std::uint32_t>& index);

  std::vector<double> points;           // xyz of each number
  std::vector<std::uint32_t> position;  // which of the positions a point comes from
  std::size_t n_joined = 0;             // positions in use that are points no more

 private:
  std::uint32_t first_within(double tolerance, const double* p) const;

  ValueTable<double, 3> equal_;
  CellGrid grid_;
  std::vector<std::uint32_t> number_;
};

/// The tolerance that the digits of the points suggest; see weld.h.
double tolerance_by_digits(std::span<const double> points);

}  // namespace wrlkit
