#include "passes/startup/startup.h"

#include <algorithm>
#include <map>

#include "passes/expand/expand.h"
#include "passes/startup/limits.h"
#include "passes/startup/script_run.h"
#include "passes/startup/script_text.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// Scripts whose program is in ECMAScript, as far as that can be known without reading files.
std::vector<NodeId> scripts_of(const Scene& scene) {
  auto out = reachable(scene, scene.main);
  std::erase_if(out, [&](NodeId n) { return !has_initialize(scene, n) && !is_script_in_file(scene, n); });
  return out;
}

/// How deep nodes are nested below the roots, Scripts apart, which may hold nodes that they are in; more than `most`
/// when a node is below itself. O(nodes and fields), no recursion.
bool is_deeper_than(const Scene& scene, std::size_t most) {
  std::vector<std::uint32_t> depth(scene.node_count());
  std::vector<char> state(scene.node_count());  // 1: open, 2: known
  std::vector<NodeId> stack(scene.main.roots.rbegin(), scene.main.roots.rend());
  while (!stack.empty()) {
    const NodeId n = stack.back();
    if (state[n.value] == 2) {
      stack.pop_back();
      continue;
    }
    const bool closes = state[n.value]++ == 1;
    bool loops = false;
    if (!is_script(scene, n))
      for_each_child(scene, n, [&](NodeId c) {
        loops |= !closes && state[c.value] == 1;
        if (closes)
          depth[n.value] = std::max(depth[n.value], depth[c.value] + 1);
        else if (!state[c.value])
          stack.push_back(c);
      });
    if (loops || depth[n.value] > most) return true;
    if (closes) stack.pop_back();
  }
  return false;
}

/// Reports each node that has other values than before; how many there are.
std::size_t report_changes(const Scene& scene, const ScriptRun& run, Diagnostics& diag) {
  std::vector<NodeId> order;
  std::map<std::uint32_t, std::string> fields;
  for (const auto& change : run.changes()) {
    if (value_text(scene.value(change.node, change.slot)) == change.before) continue;
    auto& list = fields[change.node.value];
    if (list.empty()) order.push_back(change.node);
    list +=
        (list.empty() ? "" : ", ") + std::string(scene.type(change.node).fields[change.slot].name_in(scene.dialect()));
  }
  for (const NodeId n : order) {
    const std::string name(scene.name(n));
    diag.report(Diag::startup_set, scene.where(n), scene.type(n).name, name.empty() ? name : " '" + name + "'",
                fields[n.value]);
  }
  return order.size();
}

/// The Script that was running when the process ended.
std::string script_name(const Scene& scene, NodeId n) {
  const auto name = n ? scene.name(n) : std::string_view();
  return name.empty() ? "Script" : "Script '" + std::string(name) + "'";
}

bool run_all(ScriptRun& run, std::span<const NodeId> scripts, const std::string& host, PassContext& ctx) {
  if (!run.start(host)) return false;
  for (const NodeId n : scripts) {
    if (ctx.stop.stop_requested() || !run.initialize(n)) return false;
    ++ctx.stats["startup.scripts"];
  }
  return true;
}

}  // namespace

Outcome startup(Scene& scene, const StartupOptions&, PassContext& ctx) {
  const auto scripts = scripts_of(scene);
  if (scripts.empty()) return Outcome::unchanged;
  const auto host = script_host_path();
  if (host.empty()) {
    ctx.diag.report(Diag::no_script_engine, {});
    return Outcome::unchanged;
  }
  Scene trial = scene;
  ScriptRun run(trial, ctx);
  if (!run_all(run, scripts, host, ctx)) {
    const auto where = run.running() ? scene.where(run.running()) : Span{};
    if (!ctx.stop.stop_requested())
      ctx.diag.report(Diag::script_stopped, where, script_name(trial, run.running()), run.fault());
    return Outcome::unchanged;
  }
  if (is_deeper_than(trial, script_depth)) {
    ctx.diag.report(Diag::script_stopped, {}, "a Script", "nodes below themselves, or too deep");
    return Outcome::unchanged;
  }
  const auto n_changed = report_changes(trial, run, ctx.diag);
  ctx.stats["startup.events"] += run.n_events();
  ctx.stats["startup.nodes"] += n_changed;
  if (n_changed == 0 && !run.changed_graph()) return Outcome::unchanged;
  if (run.n_made() > 0) expand(trial, {}, ctx);  // Inlines that Scripts have made
  scene = std::move(trial);
  return Outcome::changed;
}

}  // namespace wrlkit
