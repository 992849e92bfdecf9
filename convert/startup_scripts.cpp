#include "convert/startup_scripts.h"

#include <algorithm>
#include <set>

#include "passes/startup/script_text.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scopes.h"

namespace wrlkit {
namespace {

constexpr std::size_t most_fields = 4;

/// Something that is drawn by it: not a Script, which may do anything with it, nor a sensor or an interpolator.
bool shows(const Scene& scene, NodeId n) {
  return n && !is_script(scene, n) &&
         !scene.is(n, nodes::X3DSensorNode | nodes::X3DInterpolatorNode | nodes::X3DBindableNode);
}

}  // namespace

bool StartupScripts::switches() const { return std::ranges::find(fields, "Switch.whichChoice") != fields.end(); }

StartupScripts startup_scripts(const Scene& scene) {
  std::set<NodeId> scripts;
  std::set<std::string> fields;
  for_each_route(scene, [&](const Route& r) {
    if (!shows(scene, r.to) || !has_initialize(scene, r.from)) return;
    const auto& type = scene.type(r.to);
    const auto slot = type.find(r.event_in, scene.dialect(), true);
    if (!slot) return;
    scripts.insert(r.from);
    fields.insert(std::string(type.name) + "." + std::string(type.fields[*slot].name_in(scene.dialect())));
  });
  return {scripts.size(), {fields.begin(), fields.end()}};
}

void report_startup_scripts(const Scene& scene, Diagnostics& diag) {
  const auto found = startup_scripts(scene);
  if (found.n_scripts == 0) return;
  std::string list;
  for (std::size_t i = 0; i < std::min(found.fields.size(), most_fields); ++i)
    list += (i ? ", " : "") + found.fields[i];
  if (found.fields.size() > most_fields) list += ", ...";
  diag.report(Diag::scripts_not_run, {}, found.n_scripts, list);
}

}  // namespace wrlkit
