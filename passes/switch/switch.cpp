#include "passes/switch/switch.h"

#include <fnmatch.h>

#include <algorithm>
#include <span>

#include "scenegraph/any_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/switches.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

namespace v1 = nodes::vrml1;

int choice_of(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::Switch) ? scene.get(n, nodes::switch_::whichChoice) : scene.get(n, v1::switch_::whichChild);
}

void choose(Scene& scene, NodeId n, int which) {
  if (scene.is(n, nodes::Switch))
    scene.set(n, nodes::switch_::whichChoice, which);
  else
    scene.set(n, v1::switch_::whichChild, which);
}

bool fits(const Scene& scene, NodeId n, const std::string& pattern) {
  const std::string name(scene.name(n));
  return !name.empty() && fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

/// The child that a Switch is to show; -1: none.
int wanted(const Scene& scene, NodeId n, const SwitchOptions& options) {
  int which = choice_of(scene, n);
  for (const auto& [pattern, choice] : options.choices)
    if (fits(scene, n, pattern)) which = choice;
  return which;
}

void report_unused(const Scene& scene, std::span<const NodeId> switches, const SwitchOptions& options,
                   Diagnostics& diag) {
  for (const auto& choice : options.choices)
    if (std::ranges::none_of(switches, [&](NodeId n) { return fits(scene, n, choice.first); }))
      diag.report(Diag::no_switch, {}, choice.first);
}

void report_no_child(const Scene& scene, NodeId n, int which, Diagnostics& diag) {
  const auto children = switch_children(scene, n).size();
  if (children > 0) return diag.report(Diag::no_switch_child, scene.where(n), scene.name(n), children - 1, which);
  const std::string field = scene.is(n, nodes::Switch) ? "whichChoice" : "whichChild";
  diag.report(Diag::unknown_word, scene.where(n), which, scene.name(n), field + ": this Switch has no children");
}

/// Shows all children of a Switch.
void show_all(Scene& scene, NodeId n) {
  if (scene.is(n, v1::Switch)) return choose(scene, n, -3);
  const auto children = hierarchy_children(scene, n);
  if (children.empty()) return;
  scene.set(n, nodes::switch_::whichChoice, 0);
  if (children.size() == 1) return;
  const NodeId all = scene.add(nodes::Group);
  scene.set(all, nodes::group::children, children);
  scene.set(n, nodes::switch_::children, std::vector<NodeId>{all});
}

}  // namespace

bool has_switch_named(const Scene& scene, const std::string& pattern) {
  return any_node(scene, [&](NodeId n) { return is_switch(scene, n) && fits(scene, n, pattern); });
}

Outcome switch_on(Scene& scene, const SwitchOptions& options, PassContext& ctx) {
  std::size_t n_changed = 0;
  auto switches = all_nodes(scene);
  std::erase_if(switches, [&](NodeId n) { return !is_switch(scene, n); });
  report_unused(scene, switches, options, ctx.diag);
  for (const NodeId n : switches) {
    const int before = choice_of(scene, n);
    const int which = wanted(scene, n, options);
    if (which != before) choose(scene, n, which);
    if (options.all && is_switched_off(scene, n)) show_all(scene, n);
    if (which != before && which >= 0 && is_switched_off(scene, n)) report_no_child(scene, n, which, ctx.diag);
    n_changed += choice_of(scene, n) != before;
  }
  ctx.stats["switch.changed"] += n_changed;
  return n_changed ? Outcome::changed : Outcome::unchanged;
}

}  // namespace wrlkit
