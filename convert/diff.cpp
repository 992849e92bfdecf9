#include "convert/diff.h"

#include <algorithm>
#include <cmath>

#include "convert/world_meshes.h"
#include "scenegraph/legal_name.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {

std::optional<WorldFacts> facts_of(Document&& document, bool with_looks) {
  if (!document) return std::nullopt;
  WorldFacts facts;
  const Scene& scene = document.scene();
  for (NodeId n : all_nodes(scene)) ++facts.nodes[std::string(scene.type(n).name)];
  const WorldMeshes meshes(document);
  if (!meshes.good()) return std::nullopt;
  for (NodeId n : reachable(scene, scene.main)) {
    if (!scene.name(n).empty()) facts.names.emplace(scene.name(n));
    facts.materials += scene.is(n, nodes::Material);
  }
  auto& surface = facts.surface.emplace(scene, document.diag());
  LookCensus looks(scene, document.resources(), document.diag());
  auto gathered = [&](NodeId geometry) -> const Mesh& {
    const Mesh& mesh = meshes.triangles(geometry);
    surface.add(geometry, mesh);
    if (with_looks) looks.add(geometry, mesh);
    return mesh;
  };
  facts.geometry = count_geometry(scene, meshes.polygons, gathered);
  facts.looks = looks.areas();
  facts.behaviour = count_behaviour(scene);
  return facts;
}

namespace {

double apart(const Box& a, const Box& b) {
  if (a.empty() && b.empty()) return 0;
  if (a.empty() || b.empty()) return Box::inf;
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i)
    most = std::max({most, std::fabs(a.low[i] - b.low[i]), std::fabs(a.high[i] - b.high[i])});
  return most;
}

bool is_number(std::string_view s) { return !s.empty() && s.find_first_not_of("0123456789") == s.npos; }

/// Takes names that VRML does not allow out of one list, and out of the other what they have become (legal_name, with a
/// number behind it where that was taken). Both are sorted.
void remove_repaired(std::vector<std::string_view>& names, std::vector<std::string_view>& others) {
  std::vector<char> is_paired(others.size());
  std::erase_if(names, [&](std::string_view name) {
    const auto legal = legal_name(name);
    if (legal == name) return false;
    const auto is_made_of_it = [&](std::string_view other) {
      const auto behind = other.substr(legal.size());
      return behind.empty() || (behind[0] == '_' && is_number(behind.substr(1)));
    };
    for (auto at = std::ranges::lower_bound(others, legal); at != others.end() && at->starts_with(legal); ++at) {
      char& paired = is_paired[static_cast<std::size_t>(at - others.begin())];
      if (paired || !is_made_of_it(*at)) continue;
      paired = true;
      return true;
    }
    return false;
  });
  std::vector<std::string_view> left;
  for (std::size_t i = 0; i < others.size(); ++i)
    if (!is_paired[i]) left.push_back(others[i]);
  others = std::move(left);
}

}  // namespace

WorldDifference difference(WorldFacts a, WorldFacts b) {
  WorldDifference d{.a = std::move(a), .b = std::move(b)};
  std::ranges::set_difference(d.a.names, d.b.names, std::back_inserter(d.missing));
  std::ranges::set_difference(d.b.names, d.a.names, std::back_inserter(d.added));
  remove_repaired(d.missing, d.added);
  remove_repaired(d.added, d.missing);
  d.looks = difference(d.a.looks, d.b.looks);
  const auto &does = d.a.behaviour, &did = d.b.behaviour;
  d.routes = difference(does.routes, did.routes);
  d.animations = difference(does.animations, did.animations);
  d.viewpoints = difference(does.viewpoints, did.viewpoints);
  d.lights = difference(does.lights, did.lights);
  d.others = difference(does.others, did.others);
  d.bounds = apart(d.a.geometry.bounds, d.b.geometry.bounds);
  if (!d.a.surface->complete() || !d.b.surface->complete()) return d;
  d.surface = measure_deviation(d.a.surface->triangles(), d.b.surface->triangles());
  if (d.surface->rms > 0) d.of_diagonal = d.surface->rms / diagonal(d.a.geometry.bounds);
  return d;
}

std::optional<WorldDifference> diff(const Document& a, const Document& b) {
  if (!a || !b) return std::nullopt;
  auto facts_a = facts_of(a.copy());
  auto facts_b = facts_of(b.copy());
  if (!facts_a || !facts_b) return std::nullopt;
  return difference(std::move(*facts_a), std::move(*facts_b));
}

}  // namespace wrlkit
