#include "convert/optimize.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

#include "convert/kept_made.h"
#include "parsers/gltf/names.h"
#include "passes/analysis/text_list.h"
#include "passes/inline/inline.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// All DEF names of the world, and those of what no Switch shows: glTF shows one of its children, and has no place for
/// the others.
struct WorldNames {
  std::set<std::string> all, shown;
};

WorldNames names_of(const Scene& scene) {
  WorldNames out;
  std::vector<char> seen(scene.node_count());
  std::vector<NodeId> open = scene.main.roots;
  while (!open.empty()) {
    const NodeId n = open.back();
    open.pop_back();
    if (!n || std::exchange(seen[n.value], 1)) continue;
    if (!scene.name(n).empty()) out.shown.emplace(scene.name(n));
    const bool chooses = scene.is(n, nodes::Switch);
    const auto shown = chooses ? shown_children(scene, n) : std::vector<NodeId>();
    for_each_child(scene, n, [&](NodeId c) {
      if (!chooses || std::ranges::find(shown, c) != shown.end()) open.push_back(c);
    });
  }
  for (NodeId n : reachable(scene, scene.main))
    if (!scene.name(n).empty()) out.all.emplace(scene.name(n));
  return out;
}

/// Those of the files that Inlines name as well. What is missing there is reported, and not again by the passes.
WorldNames names_of(const Document& document) {
  const Scene& scene = document.scene();
  if (std::ranges::none_of(reachable(scene, scene.main), [&](NodeId n) { return scene.is(n, nodes::Inline); }))
    return names_of(scene);
  Document copy = document.copy();
  inline_worlds(copy.scene(), {}, copy.context());
  return names_of(copy.scene());
}

void find_lost(const WorldNames& names, const std::string& path, Optimized& out) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  Diagnostics unheard;
  const auto kept = names_in_gltf(bytes, path, unheard);
  for (const auto& name : names.all)
    if (!kept.contains(name)) (names.shown.contains(name) ? out.lost : out.not_shown).push_back(name);
}

void report_lost(const std::vector<std::string>& lost, Diagnostics& diag) {
  if (lost.empty()) return;
  TextList list;
  for (const auto& name : lost) list.add(name);
  diag.report(Diag::names_lost, {}, "optimize", list.count(), list.text());
}

}  // namespace

Optimized optimize(Document& document, Pipeline& pipeline, const Output& to, const SaveOptions& options,
                   const SaveHooks& hooks) {
  const WorldNames names = names_of(document);
  Optimized out;
  static_cast<Saved&>(out) = write_document(document, pipeline, to, options, hooks);
  out.n_names = names.all.size();
  if (!out || to.path == "-") return out;
  find_lost(names, to.path, out);
  report_lost(out.lost, document.diag());
  out.ending = document.ending(true);
  return out;
}

Optimized optimize(const Document& document, const std::string& path, const Profile& profile) {
  if (!document) return {};
  SaveOptions options{.pipeline = std::string(profile.pipeline)};
  apply_profile(options, profile);
  const auto to = output_of(path, options);
  std::string why;
  auto pipeline = to ? pipeline_for(*to, options, why) : std::nullopt;
  if (!pipeline || !to->format->meshes) {
    document.diag().report(Diag::cannot_write, {}, path,
                           pipeline || !to ? "its name should end in .glb or .gltf" : why);
    return {};
  }
  const KeptMade kept(document.resources());
  auto copy = document.copy();
  return optimize(copy, *pipeline, *to, options);
}

}  // namespace wrlkit
