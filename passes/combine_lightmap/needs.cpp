#include "passes/combine_lightmap/needs.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace wrlkit::combine {

double ChartNeed::area(std::uint32_t n, int padding) const {
  const double k = std::ldexp(scale, -static_cast<int>(n));
  const double width = std::max(1.0, std::ceil(size.x * k)), height = std::max(1.0, std::ceil(size.y * k));
  return copies * (width + padding) * (height + padding);
}

double ChartNeed::harm(std::uint32_t n) const {
  return n ? error[n - 1].mean * error[n - 1].mean * copies * size.x * size.y : 0;
}

double area_of(std::span<const ChartNeed> needs, int padding) {
  double sum = 0;
  for (const ChartNeed& n : needs) sum += n.area(padding);
  return sum;
}

double area_of(std::span<ChartNeed* const> needs, int padding) {
  double sum = 0;
  for (const ChartNeed* n : needs) sum += n->area(padding);
  return sum;
}

bool is_within(const Difference& d, double tolerance) {
  constexpr double rare = 4;
  return d.mean <= tolerance && d.most <= rare * tolerance;
}

void halve_even(std::span<ChartNeed> needs, double tolerance) {
  for (ChartNeed& need : needs)
    while (need.halvings < need.error.size() && is_within(need.error[need.halvings], tolerance)) ++need.halvings;
}

bool halve_to(std::span<ChartNeed* const> needs, double area, int padding) {
  struct Step {
    double price;  // harm for each texel that is saved
    std::size_t chart;
    bool operator<(const Step& o) const { return std::pair(price, chart) > std::pair(o.price, o.chart); }
  };
  std::priority_queue<Step> steps;
  double all = area_of(needs, padding);
  auto saved = [&](const ChartNeed& n) { return n.area(n.halvings, padding) - n.area(n.halvings + 1, padding); };
  auto offer = [&](std::size_t i) {
    const ChartNeed& n = *needs[i];
    if (n.halvings >= n.error.size() || !(saved(n) > 0)) return;
    steps.push({std::max(0.0, n.harm(n.halvings + 1) - n.harm(n.halvings)) / saved(n), i});
  };
  for (std::size_t i = 0; i < needs.size(); ++i) offer(i);
  while (all > area && !steps.empty()) {
    const std::size_t i = steps.top().chart;
    steps.pop();
    all -= saved(*needs[i]);
    ++needs[i]->halvings;
    offer(i);
  }
  return all <= area;
}

double error_of(std::span<ChartNeed* const> needs) {
  double harm = 0, area = 0;
  for (const ChartNeed* n : needs) {
    harm += n->harm(n->halvings);
    area += static_cast<double>(n->copies) * n->size.x * n->size.y;
  }
  return area > 0 ? std::sqrt(harm / area) : 0;
}

}  // namespace wrlkit::combine
