#include "passes/lightmap/time_budget.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace wrlkit::bake {

namespace {

constexpr int least_rays = 2, most_rays = 2048;
constexpr double safe = 0.85;  // of the time: large bakes keep caches of the processor less well than small ones

/// Pages, largest first, and the rays from which on the next larger ones are better.
struct Rung {
  double scale;
  int rays;
};
constexpr Rung rungs[] = {{1, 32}, {1.0 / 2, 16}, {1.0 / 4, 8}, {1.0 / 8, 4}, {1.0 / 16, 4}, {1.0 / 32, 4}};
constexpr double smallest = std::end(rungs)[-1].scale;

struct Cost {
  double fixed = 0, texel = 0, ray = 0;

  double seconds(const BakeSize& size) const { return fixed + size.scale * size.scale * (texel + ray * size.rays); }
  /// That are affordable, even.
  int rays(double scale, double within) const {
    const double most = ray > 0 ? ((within - fixed) / (scale * scale) - texel) / ray : most_rays;
    return 2 * static_cast<int>(std::clamp(most, double{least_rays}, double{most_rays}) / 2);
  }
};

class Trials {
 public:
  Trials(double seconds, const std::function<double(BakeSize)>& trial) : left_(seconds), trial_(trial) {}

  double operator()(const BakeSize& size) {
    const double took = trial_(size);
    left_ -= took;
    return took;
  }
  double left() const { return left_; }

 private:
  double left_;
  const std::function<double(BakeSize)>& trial_;
};

/// From two small bakes, and a larger one where that is cheap.
Cost measure(Trials& trials) {
  constexpr double small = 1.0 / 32, share = 0.05;  // of the time that is left, for the larger one
  constexpr int few = 4, many = 16;
  const double area = small * small, of_few = trials({small, few}), of_many = trials({small, many});
  Cost cost;
  cost.ray = std::max(0.0, of_many - of_few) / ((many - few) * area);
  cost.texel = std::max(0.0, of_few / area - few * cost.ray);
  const auto fits = [&](const Rung& r) {
    return r.scale <= 1.0 / 4 && cost.seconds({r.scale, few}) <= share * trials.left();
  };
  for (const Rung& r : rungs) {
    if (r.scale <= small || !fits(r)) continue;
    const double more = (trials({r.scale, few}) - of_few) / (r.scale * r.scale - area);  // a unit of area
    cost.texel = std::max(0.0, more - few * cost.ray);
    cost.ray = std::min(cost.ray, std::max(0.0, more) / few);
    cost.fixed = std::max(0.0, of_few - area * (cost.texel + few * cost.ray));
    break;
  }
  return cost;
}

}  // namespace

BakeSize size_for_time(double seconds, bool any_scale, const std::function<double(BakeSize)>& trial) {
  Trials trials(seconds, trial);
  const Cost cost = measure(trials);
  const double within = safe * trials.left();
  if (!any_scale) return {1, cost.rays(1, within)};
  for (const Rung& r : rungs)
    if (cost.seconds({r.scale, r.rays}) <= within) return {r.scale, cost.rays(r.scale, within)};
  return {smallest, cost.rays(smallest, within)};
}

}  // namespace wrlkit::bake
