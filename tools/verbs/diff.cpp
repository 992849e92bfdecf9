// wrlkit diff: how two worlds differ in what they show, and in their names and nodes. The keys of --json are stable.
// The worlds are read one after the other; of the first one only what is compared is kept.
#include "tools/verbs/diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "base/text/json.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "tools/world_meshes.h"

namespace wrlkit {

std::optional<WorldFacts> facts_of(Session& s, const std::string& path) {
  if (!s.read(path)) return std::nullopt;
  WorldFacts facts;
  const Scene& scene = s.world().scene;
  for (NodeId n : all_nodes(scene)) ++facts.nodes[std::string(scene.type(n).name)];
  WorldMeshes meshes(s);
  if (!meshes.good()) return std::nullopt;
  for (NodeId n : reachable(scene, scene.main)) {
    if (!scene.name(n).empty()) facts.names.emplace(scene.name(n));
    facts.materials += scene.is(n, nodes::Material);
  }
  auto& surface = facts.surface.emplace(scene, s.diag());
  auto gathered = [&](NodeId geometry) -> const Mesh& {
    const Mesh& mesh = meshes.triangles(geometry);
    surface.add(geometry, mesh);
    return mesh;
  };
  facts.geometry = count_geometry(scene, meshes.polygons, gathered);
  return facts;
}

namespace {

double apart(const Bounds& a, const Bounds& b) {
  if (a.empty() && b.empty()) return 0;
  if (a.empty() || b.empty()) return Bounds::inf;
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i)
    most = std::max({most, std::fabs(a.min[i] - b.min[i]), std::fabs(a.max[i] - b.max[i])});
  return most;
}

double diagonal(const Bounds& b) {
  return b.empty() ? 0 : std::hypot(b.max[0] - b.min[0], b.max[1] - b.min[1], b.max[2] - b.min[2]);
}

}  // namespace

WorldDifference difference(WorldFacts a, WorldFacts b) {
  WorldDifference d{.a = std::move(a), .b = std::move(b)};
  std::ranges::set_difference(d.a.names, d.b.names, std::back_inserter(d.missing));
  std::ranges::set_difference(d.b.names, d.a.names, std::back_inserter(d.added));
  d.bounds = apart(d.a.geometry.bounds, d.b.geometry.bounds);
  if (!d.a.surface->complete() || !d.b.surface->complete()) return d;
  d.surface = measure_deviation(d.a.surface->triangles(), d.b.surface->triangles());
  if (d.surface->rms > 0) d.of_diagonal = d.surface->rms / diagonal(d.a.geometry.bounds);
  return d;
}

namespace {

std::string difference_json(const WorldDifference& d) {
  std::string out;
  JsonOut json(out);
  json.begin_object();
  const std::uint64_t triangles[] = {d.a.geometry.triangles, d.b.geometry.triangles},
                      materials[] = {d.a.materials, d.b.materials};
  json.member("triangles", std::span(triangles));
  json.key("bounds");
  json.begin_object();
  json.member("max_delta", d.bounds);
  json.end_object();
  json.key("surface");
  json.begin_object();
  json.member("rms", d.surface ? d.surface->rms : Bounds::inf);
  json.member("max", d.surface ? d.surface->max : Bounds::inf);
  json.member("of_diagonal", d.surface ? d.of_diagonal : Bounds::inf);
  json.end_object();
  json.key("names");
  json.begin_object();
  json.member("missing", std::span<const std::string_view>(d.missing));
  json.member("added", std::span<const std::string_view>(d.added));
  json.end_object();
  json.member("materials", std::span(materials));
  json.end_object();
  return out;
}

/// "12" when both are, else "12 -> 7".
std::string change(std::uint64_t a, std::uint64_t b) {
  return a == b ? fmt::format("{}", a) : fmt::format("{} -> {}", a, b);
}

std::string node_changes(const WorldDifference& d) {
  std::set<std::string_view> types;
  for (auto* facts : {&d.a, &d.b})
    for (auto& [type, n] : facts->nodes) types.insert(type);
  std::string out;
  for (auto type : types) {
    auto count = [type](const WorldFacts& f) {
      auto n = f.nodes.find(type);
      return n == f.nodes.end() ? 0 : n->second;
    };
    if (count(d.a) != count(d.b))
      out += fmt::format("{} {} {}", out.empty() ? "" : ",", type, change(count(d.a), count(d.b)));
  }
  return out.empty() ? " the same number of each type" : out;
}

std::string name_list(std::string_view what, const std::vector<std::string_view>& names) {
  constexpr std::size_t most = 10;
  if (names.empty()) return {};
  std::string out = fmt::format("  names {}: {}:", what, names.size());
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) out += fmt::format(" {}", names[i]);
  return out + (names.size() > most ? " ...\n" : "\n");
}

std::string bounds_text(double apart) {
  return std::isinf(apart) ? "one of them has none"
         : apart > 0       ? fmt::format("up to {:.4g} m apart", apart)
                           : "the same";
}

std::string surface_text(const WorldDifference& d) {
  if (!d.surface) return "too large to be measured";
  const Deviation& s = *d.surface;
  if (std::isinf(s.max)) return "one of them has none";
  if (s.max == 0 && s.normal_max == 0) return "the same";
  auto degrees = [](double radians) { return radians * 180 / std::numbers::pi; };
  return fmt::format(
      "{:.4g} m rms ({:.2g} of the diagonal), {:.4g} m at most, at {:.6g} {:.6g} {:.6g}; normals {:.2g} degrees in the "
      "mean",
      s.rms, d.of_diagonal, s.max, s.where[0], s.where[1], s.where[2], degrees(s.normal_mean));
}

std::string difference_text(const WorldDifference& d, const Flags& flags) {
  const GeometryCensus &a = d.a.geometry, &b = d.b.geometry;
  std::string out = fmt::format("{} -> {}\n", flags.inputs[0], flags.inputs[1]);
  out += fmt::format("  shapes {}, polygons {}, triangles {}, lines {}, points {}\n", change(a.shapes, b.shapes),
                     change(a.polygons, b.polygons), change(a.triangles, b.triangles), change(a.lines, b.lines),
                     change(a.points, b.points));
  out += fmt::format("  materials {}, names {}\n", change(d.a.materials, d.b.materials),
                     change(d.a.names.size(), d.b.names.size()));
  out += name_list("missing", d.missing) + name_list("added", d.added);
  return out + fmt::format("  nodes:{}\n  bounds: {}\n  surface: {}\n", node_changes(d), bounds_text(d.bounds),
                           surface_text(d));
}

}  // namespace

int run_diff(const Flags& flags) {
  Session s(flags);
  if (!s.good()) return usage;
  auto a = facts_of(s, flags.inputs[0]);
  if (!a) return s.end(false);
  auto b = facts_of(s, flags.inputs[1]);
  if (!b) return s.end(false);
  s.progress().begin("comparing", 0, "");
  const WorldDifference d = difference(std::move(*a), std::move(*b));
  s.progress().clear();
  const std::string json = difference_json(d);
  fmt::print("{}{}", flags.json ? json : difference_text(d, flags), flags.json ? "\n" : "");
  s.fact("difference", json);
  return s.end(true);
}

}  // namespace wrlkit
