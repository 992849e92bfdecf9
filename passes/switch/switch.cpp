#include "passes/switch/switch.h"

#include <fnmatch.h>

#include <algorithm>
#include <span>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

bool is_off(const Scene& scene, NodeId n) {
  const auto which = scene.get(n, nodes::switch_::whichChoice);
  return which < 0 || static_cast<std::size_t>(which) >= hierarchy_children(scene, n).size();
}

bool fits(const Scene& scene, NodeId n, const std::string& pattern) {
  const std::string name(scene.name(n));
  return !name.empty() && fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

/// The child that a Switch is to show; -1: none.
int wanted(const Scene& scene, NodeId n, const SwitchOptions& options) {
  int which = scene.get(n, nodes::switch_::whichChoice);
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

/// Shows all children of a Switch.
void show_all(Scene& scene, NodeId n) {
  const auto children = hierarchy_children(scene, n);
  if (children.empty()) return;
  scene.set(n, nodes::switch_::whichChoice, 0);
  if (children.size() == 1) return;
  const NodeId all = scene.add(nodes::Group);
  scene.set(all, nodes::group::children, children);
  scene.set(n, nodes::switch_::children, std::vector<NodeId>{all});
}

}  // namespace

Outcome switch_on(Scene& scene, const SwitchOptions& options, PassContext& ctx) {
  std::size_t n_changed = 0;
  auto switches = all_nodes(scene);
  std::erase_if(switches, [&](NodeId n) { return !scene.is(n, nodes::Switch); });
  report_unused(scene, switches, options, ctx.diag);
  for (const NodeId n : switches) {
    const int before = scene.get(n, nodes::switch_::whichChoice);
    if (const int which = wanted(scene, n, options); which != before) scene.set(n, nodes::switch_::whichChoice, which);
    if (options.all && is_off(scene, n)) show_all(scene, n);
    n_changed += scene.get(n, nodes::switch_::whichChoice) != before;
  }
  ctx.stats["switch.changed"] += n_changed;
  return n_changed ? Outcome::changed : Outcome::unchanged;
}

}  // namespace wrlkit
