#include "passes/lower_x3d/surface_interpolators.h"

#include <algorithm>

#include "passes/lower_x3d/nurbs_geometry.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scopes.h"

namespace wrlkit::x3d {
namespace {

/// The only one that leads to a node; null: there are others, or none.
const Route* only_route_to(const Scope& scope, NodeId n) {
  const auto leads_there = [n](const Route& r) { return r.to == n; };
  const auto at = std::ranges::find_if(scope.routes, leads_there);
  return std::ranges::count_if(scope.routes, leads_there) == 1 ? &*at : nullptr;
}

bool lower(Scene& scene, Scope& scope, NodeId n, double tolerance, Diagnostics& diag) {
  namespace p = nodes::position_interpolator2d;
  const Route* by = only_route_to(scope, n);
  const bool only_places = std::ranges::none_of(
      scope.routes, [n](const Route& r) { return r.from == n && r.event_out != "position_changed"; });
  if (!by || !only_places || !scene.is(by->from, nodes::PositionInterpolator2D)) return false;
  const NodeId driver = by->from;
  const auto key = scene.get(driver, p::key), places = scene.get(driver, p::keyValue);
  if (!lower_surface_interpolator(scene, n, key, places, tolerance, diag)) return false;
  std::vector<Route> routes;
  for (Route r : scope.routes) {
    if (r.to == n) continue;
    if (r.from == n) r.event_out = "value_changed";
    routes.push_back(r);
    if (r.to == driver) routes.push_back({r.from, n, r.event_out, r.event_in});
  }
  scope.routes = std::move(routes);
  return true;
}

}  // namespace

bool lower_surface_interpolators(Scene& scene, double tolerance, Diagnostics& diag) {
  const auto is_one = [&](NodeId n) { return scene.is(n, nodes::NurbsSurfaceInterpolator); };
  bool changed = false;
  for_each_scope(scene, [&](Scope& scope) {
    std::vector<NodeId> found;
    for (const Route& r : scope.routes)
      if (is_one(r.to)) found.push_back(r.to);
    for (const NodeId n : found)
      if (is_one(n)) changed |= lower(scene, scope, n, tolerance, diag);
  });
  return changed;
}

}  // namespace wrlkit::x3d
