// How many texels a chart needs: as many as show its texture, fewer where it is even, and fewer still for a budget.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/unwrap/charts.h"
#include "passes/combine_lightmap/chart_image.h"

namespace wrlkit::combine {

struct ChartNeed {
  unwrap::Point2f size;           // texels of the light
  double scale = 1;               // texels for each of those, along each side, that show all there is
  std::uint32_t copies = 1;       // Shapes that have such a chart
  std::vector<Difference> error;  // of half as many along each side, a quarter ...
  std::uint32_t halvings = 0;     // that are chosen, at most as many as there are errors

  double factor() const { return scale / static_cast<double>(std::uint64_t{1} << halvings); }
  /// Texels of all copies, with that many between them and others.
  double area(int padding) const { return area(halvings, padding); }
  double area(std::uint32_t halvings, int padding) const;
  /// Square of the mean error, times texels of the light.
  double harm(std::uint32_t halvings) const;
};

/// Of all of them.
double area_of(std::span<const ChartNeed> needs, int padding);
double area_of(std::span<ChartNeed* const> needs, int padding);

/// In the mean, and four times that at most.
bool is_within(const Difference& d, double tolerance);

/// As many halvings as change nothing by more than the tolerance.
void halve_even(std::span<ChartNeed> needs, double tolerance);

/// More of them, those first that do the least harm for each texel, until the sum of areas is no more than that. False
/// when that cannot be. O(charts log charts).
bool halve_to(std::span<ChartNeed* const> needs, double area, int padding);

/// Root mean square of the error over all surfaces, in 255ths.
double error_of(std::span<ChartNeed* const> needs);

}  // namespace wrlkit::combine
