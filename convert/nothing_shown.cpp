#include "convert/nothing_shown.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "convert/drawn_search.h"
#include "convert/expanded_copy.h"
#include "convert/hidden_geometry.h"
#include "scenegraph/nodes.h"
#include "scenegraph/switches.h"
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

/// Instances of prototypes draw what nobody knows before they are expanded.
IsDrawn answer(const Scene& scene, NodeId n) {
  if (draws(scene, n)) return IsDrawn::yes;
  return is_instance(scene, n) ? IsDrawn::perhaps : IsDrawn::no;
}

void push_shown(const Scene& scene, NodeId n, std::vector<NodeId>& stack) {
  if (scene.type(n).kind == NodeKind::script || is_instance(scene, n)) return;
  if (!is_switch(scene, n)) return for_each_child(scene, n, [&](NodeId c) { stack.push_back(c); });
  for (const NodeId c : shown_of_switch(scene, n)) stack.push_back(c);
}

/// As if every Switch were on.
void push_all(const Scene& scene, NodeId n, std::vector<NodeId>& stack) {
  if (scene.type(n).kind == NodeKind::script) return;
  for_each_child(scene, n, [&](NodeId c) { stack.push_back(c); });
}

auto search(const Scene& scene, void (*push)(const Scene&, NodeId, std::vector<NodeId>&)) {
  return DrawnSearch(
      scene, [&scene](NodeId n) { return answer(scene, n); },
      [&scene, push](NodeId n, std::vector<NodeId>& stack) { push(scene, n, stack); });
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
  auto find_drawn = search(scene, push_all);
  for (const NodeId n : reachable(scene, scene.main)) {
    if (!is_instance(scene, n)) continue;
    for (const Value& v : scene.fields(n)) {
      if (find_drawn(scene.content(v).node_span()) == IsDrawn::yes)
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

/// `hidden`: something would be drawn, were every Switch on.
void report_cause(const Scene& scene, bool hidden, Diagnostics& diag) {
  const auto report = [&](Span where, const std::string& cause) { diag.report(Diag::nothing_shown, where, cause); };
  const Span first = scene.where(scene.main.roots[0]);
  if (hidden) return report(first, "all of it is in Switches that are off; use --show-all or the pass switch");
  if (const auto found = ignored_field(scene))
    return report(scene.where(found->instance), "prototype '" + std::string(scene.type(found->instance).name) +
                                                    "' does not draw what its field '" + found->field + "' holds");
  report(first, "it has no geometry, but only " + listed(types_of(scene)));
}

void report_without_roots(const Scene& scene, Diagnostics& diag) {
  if (scene.main.protos.empty() && diag.has_errors()) return;  // nothing could be read
  if (scene.main.protos.empty()) return diag.report(Diag::nothing_shown, scene.file, "it holds no node");
  diag.report(Diag::nothing_shown, scene.proto(scene.main.protos[0]).where,
              "its prototypes (" + listed(proto_names(scene)) + ") are declared, and none of them is used");
}

/// `hidden_told`: what its Switches hide has been reported.
void report_nothing_shown(const Scene& scene, bool hidden_told, Diagnostics& diag) {
  if (scene.main.roots.empty()) return report_without_roots(scene, diag);
  if (search(scene, push_shown)(scene.main.roots) == IsDrawn::yes) return;
  // Switches may be in prototypes, and prototypes in Switches.
  const Scene expanded = expanded_copy(scene, nullptr, diag);
  const auto& roots = expanded.main.roots;
  if (search(expanded, push_shown)(roots) != IsDrawn::no) return;
  const bool hidden = search(expanded, push_all)(roots) != IsDrawn::no;
  if (!hidden || !hidden_told) report_cause(scene, hidden, diag);
}

}  // namespace

void report_undrawn(const Scene& scene, Resources* files, Diagnostics& diag) {
  const auto before = diag.count(Diag::hidden_geometry);  // of other files
  report_hidden_geometry(scene, files, diag);
  report_nothing_shown(scene, diag.count(Diag::hidden_geometry) > before, diag);
}

}  // namespace wrlkit
