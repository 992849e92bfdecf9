#include "convert/nothing_shown.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/silent_task.h"
#include "convert/hidden_geometry.h"
#include "passes/expand_protos/expand_protos.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

constexpr std::size_t most_listed = 4;

bool is_instance(const Scene& scene, NodeId n) { return scene.type(n).kind == NodeKind::proto; }

/// What is drawn, the sky too, or may be for all that is known.
bool draws(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::X3DGeometryNode) || scene.is(n, nodes::X3DShapeNode) ||
         scene.is(n, nodes::X3DBackgroundNode) || scene.is(n, nodes::Vrml1ShapeNode) || scene.is(n, nodes::Inline) ||
         scene.is(n, nodes::vrml1::WWWInline) || scene.is(n, nodes::vrml1::File) ||
         scene.type(n).kind == NodeKind::unknown;
}

std::vector<NodeId> shown(const Scene& scene, NodeId n) {
  if (scene.is(n, nodes::Switch)) return shown_children(scene, n);
  std::vector<NodeId> out;
  for_each_child(scene, n, [&](NodeId c) { out.push_back(c); });
  if (!scene.is(n, nodes::vrml1::Switch)) return out;
  const auto which = scene.get(n, nodes::vrml1::switch_::whichChild);
  if (which < -1) return out;  // all of them, or as the Switch around it
  return which >= 0 && static_cast<std::size_t>(which) < out.size()
             ? std::vector<NodeId>{out[static_cast<std::size_t>(which)]}
             : std::vector<NodeId>();
}

enum class Answer : std::uint8_t { no, perhaps, yes };  // perhaps: there are instances of prototypes

/// Whether something below the roots is drawn; `all`: or would be, were every Switch on.
Answer is_drawn(const Scene& scene, std::span<const NodeId> roots, bool all) {
  Answer out = Answer::no;
  std::vector<char> seen(scene.node_count());
  std::vector<NodeId> stack(roots.rbegin(), roots.rend());
  while (!stack.empty()) {
    const NodeId n = stack.back();
    stack.pop_back();
    if (std::exchange(seen[n.value], 1)) continue;
    if (draws(scene, n)) return Answer::yes;
    if (scene.type(n).kind == NodeKind::script) continue;
    if (is_instance(scene, n) && !all) {
      out = Answer::perhaps;
      continue;
    }
    if (all)
      for_each_child(scene, n, [&](NodeId c) { stack.push_back(c); });
    else
      for (const NodeId c : shown(scene, n)) stack.push_back(c);
  }
  return out;
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), most_listed); ++i) out += (i ? ", " : "") + names[i];
  return out + (names.size() > most_listed ? ", ..." : "");
}

/// An instance whose field holds what its prototype does not draw.
struct Ignored {
  NodeId instance;
  std::string field;
};

std::optional<Ignored> ignored_field(const Scene& scene) {
  for (const NodeId n : reachable(scene, scene.main)) {
    if (!is_instance(scene, n)) continue;
    for (const Value& v : scene.fields(n)) {
      const auto nodes = scene.content(v).node_span();
      if (!nodes.empty() && is_drawn(scene, nodes, true) == Answer::yes)
        return Ignored{n, std::string(scene.field_name(n, v))};
    }
  }
  return std::nullopt;
}

std::vector<std::string> proto_names(const Scene& scene) {
  std::vector<std::string> out;
  for (const ProtoId p : scene.main.protos) out.emplace_back(scene.type(scene.proto(p).type).name);
  return out;
}

/// Those that there are most of, first.
std::vector<std::string> types_of(const Scene& scene) {
  std::map<std::string, int> counts;
  for (const NodeId n : reachable(scene, scene.main)) --counts[std::string(scene.type(n).name)];
  std::vector<std::pair<int, std::string>> order;
  for (const auto& [name, n] : counts) order.emplace_back(n, name);
  std::ranges::sort(order);
  std::vector<std::string> out;
  for (auto& [n, name] : order) out.push_back(std::move(name));
  return out;
}

void report_cause(const Scene& scene, Diagnostics& diag) {
  const auto& roots = scene.main.roots;
  const auto report = [&](Span where, const std::string& cause) { diag.report(Diag::nothing_shown, where, cause); };
  if (roots.empty() && scene.main.protos.empty()) return;  // an empty file, or one of which nothing could be read
  if (roots.empty())
    return report(Span{.begin = 0},
                  "its prototypes (" + listed(proto_names(scene)) + ") are declared, and none of them is used");
  if (const auto found = ignored_field(scene))
    return report(scene.where(found->instance), "prototype '" + std::string(scene.type(found->instance).name) +
                                                    "' does not draw what its field '" + found->field + "' holds");
  if (is_drawn(scene, roots, true) == Answer::yes) {
    if (diag.count(Diag::hidden_geometry) == 0)
      report(scene.where(roots[0]), "all of it is in Switches that are off; use --show-all or the pass switch");
    return;
  }
  report(scene.where(roots[0]), "it has no geometry, but only " + listed(types_of(scene)));
}

}  // namespace

void report_nothing_shown(const Scene& scene, Diagnostics& diag) {
  auto answer = is_drawn(scene, scene.main.roots, false);
  if (answer == Answer::perhaps) {
    Scene expanded = scene;
    Diagnostics unheard(diag.shared_sources());
    Statistics uncounted;
    PassContext silent(unheard, uncounted);
    expand_protos(expanded, {}, silent);
    answer = is_drawn(expanded, expanded.main.roots, false);
  }
  if (answer == Answer::no) report_cause(scene, diag);
}

void report_undrawn(const Scene& scene, Diagnostics& diag) {
  report_hidden_geometry(scene, diag);
  report_nothing_shown(scene, diag);
}

}  // namespace wrlkit
